// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/picture/raster.hpp"
#include "palpable/vision/streets/lines/carriageways.hpp"
#include "palpable/vision/streets/lines/centre_lines.hpp"

#include <cstdint>

#include <opencv2/core.hpp>

namespace palpable::vision {

/// The middles of two carriageways that run beside each other. `places`: where the middle of a carriageway of
/// this radius can be, strips that are wider than one line. The strips' sides are middles where they follow
/// the mask's border. Where they turn about a corner of the border (at a fork, between two ends, beside a
/// street that joins), no carriageway is shown: a side that goes on straight behind the corner is continued,
/// others end. Strips with hardly any sides, as where two streets cross, show none. Any thread.
ThinningGuide carriageway_sides(const Raster<std::uint8_t>& mask, const cv::Mat& places, double radius_px,
                                const CarriagewayOptions& options);

}  // namespace palpable::vision
