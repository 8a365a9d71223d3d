// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/vision/stereo/problem/stereo.hpp"

namespace palpable::vision {

/// The pictures of a pair that has an epipolar frame, on common rows in that frame; the result has none.
StereoPair in_epipolar_frame(const StereoPair& pair);

/// A match of in_epipolar_frame(pair), at the pixels of the left picture.
StereoMatch in_left_picture(StereoMatch match, const StereoPair& pair);

}  // namespace palpable::vision
