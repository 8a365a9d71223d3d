// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/image.hpp"
#include "palpable/core/result.hpp"

#include <vector>

namespace palpable::sculpt {

/// Whether a picture's colours are unit vectors (2 c − 1) that point out of it, as normal maps hold them,
/// nearly everywhere.
bool is_normal_map(const Image& picture);

/// A touch texture's tile (models/material/touch_texture.hpp) of a picture that repeats itself: of its
/// heights (white is high), or, of a normal map (x right, y up, z out of the picture), of the heights whose
/// slopes are nearest to its own. Forms finer than models::kPictureForms to the side are left out, the mean
/// is 0, and the values are as large as keeps every form's curvature below that of a wave of the finest form
/// of height 1. Errors: invalid_input for pictures under 8 x 8, with samples that are not finite, or of one
/// tone.
Result<std::vector<float>> texture_tile(const Image& picture);

}  // namespace palpable::sculpt
