// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/session/touch/matched_source.hpp"
#include "palpable/sources/live/camera_stream.hpp"
#include "palpable/sources/stereo/stereo_file.hpp"

#include <memory>

namespace palpable::session {

/// The pairs of a stereo camera: `layout` says how each picture of `left` holds one, if `right` is null; else
/// the two cameras' pictures that arrived within 100 ms of one another (nothing synchronises them). Before
/// the first pair, pictures that cannot be read are left out for three seconds: cameras begin with such.
std::unique_ptr<PairSource> camera_pairs(std::unique_ptr<sources::CameraStream> left,
                                         std::unique_ptr<sources::CameraStream> right,
                                         sources::StereoLayout layout);

}  // namespace palpable::session
