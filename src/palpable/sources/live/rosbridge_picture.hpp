// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/picture/camera.hpp"
#include "palpable/core/picture/image.hpp"
#include "palpable/core/result.hpp"
#include "palpable/sources/live/rosbridge_message.hpp"

#include <optional>

namespace palpable::sources {

/// Depth along the camera's axis, metres; NaN where it is unknown (0 of whole numbers, and what is not
/// finite). `metres_per_unit` > 0; without it whole numbers are millimetres and floats are metres (REP 118).
/// A cloud needs its camera, onto whose picture it is projected: the nearest point of a pixel counts.
/// Encodings: 16UC1, mono16 and 32FC1; CompressedImage: PNG of 16 bits, and compressedDepth of either.
/// Errors (invalid_input, without a place), each a clause about the server: another encoding, damaged data,
/// more than kMostFramePixels, and depths in metres of which most are beyond 100 m.
Result<DepthMap> depth_of(const RosBody& body, const std::optional<Pinhole>& camera,
                          std::optional<double> metres_per_unit);

/// The colours of a picture: rgb8, bgr8, rgba8, bgra8 or mono8, and JPEG or PNG. Errors: likewise.
Result<Image> colour_of(const RosBody& body);

}  // namespace palpable::sources
