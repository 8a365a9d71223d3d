// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/result.hpp"
#include "palpable/recipes/video/video_scale.hpp"

#include <string>

namespace palpable::cli {

/// Parses a length in a frame of a video: "120 mm between 210,240 and 330,250 of frame 40", with mm, cm or m,
/// and pixels of the video's frames. Errors: usage, with an example.
Result<recipes::KnownLength> known_length_from(const std::string& text);

}  // namespace palpable::cli
