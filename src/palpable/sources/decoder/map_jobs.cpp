// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sources/decoder/replies.hpp"
#include "palpable/sources/map/extract_parser.hpp"
#include "palpable/sources/map/extract_reply.hpp"

namespace palpable::sources::decoder {

bool run_map_job(isolated::Job job, std::span<const std::byte> file, ReplySink& reply) {
  if (job != isolated::Job::map_extract) return false;
  const auto extract = parse_map_extract(file);
  return extract ? reply.put(isolated::reply_of(*extract)) : put_error(reply, extract.error());
}

}  // namespace palpable::sources::decoder
