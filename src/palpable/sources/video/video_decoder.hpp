// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/result.hpp"
#include "palpable/sources/video/video.hpp"

#include <cstddef>
#include <span>

namespace palpable::sources {

/// Decodes a video with FFmpeg. It may crash or hang on a malicious file: only for the decoder process and
/// the fuzzers; all others call isolated::decode_video(). Errors, without a place: invalid_input.
Result<Video> decode_video(std::span<const std::byte> file);

}  // namespace palpable::sources
