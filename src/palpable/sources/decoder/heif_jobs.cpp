// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sources/decoder/replies.hpp"
#include "palpable/sources/picture/photo_depth.hpp"

#include <cstdint>

namespace palpable::sources::decoder {
namespace {

bool put_depth(ReplySink& reply, const Result<std::optional<PhotoDepth>>& decoded) {
  return decoded ? reply.put(isolated::reply_of(*decoded)) : put_error(reply, decoded.error());
}

bool put_announcement(ReplySink& reply, bool announces) {
  isolated::FlatWriter flat;
  isolated::begin_value(flat);
  flat.put(static_cast<std::uint8_t>(announces));
  return reply.put(flat.take());
}

}  // namespace

bool run_heif_job(isolated::Job job, std::span<const std::byte> file, ReplySink& reply) {
  switch (job) {
    case isolated::Job::heif:
      return put_picture(reply, decode_heif(file));
    case isolated::Job::heif_depth:
      return put_depth(reply, depth_in_heif(file));
    case isolated::Job::heif_announces_depth:
      return put_announcement(reply, heif_announces_depth(file));
    default:
      return false;
  }
}

}  // namespace palpable::sources::decoder
