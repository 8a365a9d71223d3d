// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sources/video/video_reply.hpp"

#include <cstdint>
#include <cstdlib>
#include <span>

// Replies of a compromised video decoder give frames of one size with increasing numbers, or an error.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace palpable::sources;
  const auto video = isolated::video_in(std::as_bytes(std::span(data, size)));
  if (!video) {
    if (video.error().message.empty()) std::abort();
    return 0;
  }
  if (video->frames.empty()) std::abort();
  int last = -1;
  for (const palpable::VideoFrame& frame : video->frames) {
    const auto& first = video->frames.front().picture;
    if (frame.picture.width() != first.width() || frame.picture.height() != first.height()) std::abort();
    if (frame.number <= last) std::abort();
    last = frame.number;
  }
  return 0;
}
