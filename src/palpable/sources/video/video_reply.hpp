// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/files/file_bytes.hpp"
#include "palpable/core/result.hpp"
#include "palpable/sources/video/video.hpp"

#include <cstddef>
#include <span>
#include <vector>

// A video in the reply of the decoder process, and decode_video(), which runs in that process.
namespace palpable::sources::isolated {

std::vector<std::byte> reply_of(const Video& video);

/// Decodes and checks a reply: sizes, counts, increasing frame numbers. Errors: those in the reply;
/// invalid_input for an invalid reply.
Result<Video> video_in(std::span<const std::byte> reply);

/// Decodes a video in a separate process. Errors as video_decoder.hpp, and those of isolated::decode().
Result<Video> decode_video(FileView file);

}  // namespace palpable::sources::isolated
