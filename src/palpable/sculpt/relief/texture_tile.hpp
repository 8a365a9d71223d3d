// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/picture/image.hpp"
#include "palpable/core/result.hpp"

#include <vector>

namespace palpable::sculpt {

/// Whether nearly all of a picture's colours are unit vectors (2 c − 1) that point out of it, as in a normal
/// map.
bool is_normal_map(const Image& picture);

/// The tile of a touch texture (models/material/touch_texture.hpp) from a periodic picture: of its heights
/// (white is high) or, if it is a normal map (x right, y up, z out of the picture), of the heights whose
/// slopes are nearest to its own. Frequencies above models::kPictureForms per side are removed, and the mean
/// is 0. The amplitude is scaled so that no curvature exceeds that of the highest frequency with amplitude
/// 1. Errors: invalid_input for pictures under 8 x 8, with samples that are not finite, or of one tone.
Result<std::vector<float>> texture_tile(const Image& picture);

}  // namespace palpable::sculpt
