// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sources/decoder/jobs.hpp"
#include "palpable/sources/isolated/flat.hpp"
#include "palpable/sources/video/video_decoder.hpp"
#include "palpable/sources/video/video_reply.hpp"

#include <exception>

// The jobs of palpable-video-decoder. Loading FFmpeg's libraries takes longer than reading most other files,
// so they are in a separate program.
namespace palpable::sources::decoder {

void prepare(isolated::Job) {}

bool run(isolated::Job job, std::span<const std::byte> file, ReplySink& reply) {
  if (job != isolated::Job::video) return false;
  try {
    const auto video = decode_video(file);
    return reply.put(video ? isolated::reply_of(*video) : isolated::error_reply(video.error()));
  } catch (const std::exception&) {
    return reply.restart() && reply.put(isolated::error_reply(invalid_input(
                                  "is damaged or too large: it needs more memory than its size explains")));
  }
}

}  // namespace palpable::sources::decoder
