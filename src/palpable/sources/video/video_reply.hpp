// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/result.hpp"
#include "palpable/sources/video/video.hpp"

#include <cstddef>
#include <span>
#include <vector>

// A video as the decoder process replies with it, and decode_video() run in that process.
namespace palpable::sources::isolated {

std::vector<std::byte> reply_of(const Video& video);

/// What a reply says, checked: sizes, counts, rising frame numbers. Errors: the reply's own; invalid_input
/// for one that is not what it should be.
Result<Video> video_in(std::span<const std::byte> reply);

/// Errors as video_decoder.hpp, and those of isolated::decode().
Result<Video> decode_video(std::span<const std::byte> file);

}  // namespace palpable::sources::isolated
