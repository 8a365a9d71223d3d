// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sources/decoder/replies.hpp"
#include "palpable/sources/video/video_decoder.hpp"
#include "palpable/sources/video/video_reply.hpp"

namespace palpable::sources::decoder {

bool run_video_job(isolated::Job job, std::span<const std::byte> file, ReplySink& reply) {
  if (job != isolated::Job::video) return false;
  const auto video = decode_video(file);
  return video ? reply.put(isolated::reply_of(*video)) : put_error(reply, video.error());
}

}  // namespace palpable::sources::decoder
