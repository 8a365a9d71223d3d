// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/result.hpp"
#include "palpable/core/work.hpp"
#include "palpable/sources/video/video.hpp"

#include <filesystem>
#include <span>

namespace palpable::sources {

/// Reads the frames of a video (one file), or pictures in the given order, which are numbered from 0. They
/// are reduced to kLongestVideoSide; of more than kMostVideoFrames only some are kept. What cannot be read is
/// counted (Video::lost). Long work. Errors: invalid_input, naming the file, if nothing can be read, and for
/// pictures of different sizes; interrupted.
Result<Video> read_video(std::span<const std::filesystem::path> files, const Work& work);

}  // namespace palpable::sources
