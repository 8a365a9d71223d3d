// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sources/decoder/replies.hpp"
#include "palpable/sources/solid/mesh_parser.hpp"
#include "palpable/sources/solid/mesh_reply.hpp"

#include <string>

namespace palpable::sources::decoder {

bool run_mesh_job(isolated::Job job, std::span<const std::byte> file, ReplySink& reply) {
  using isolated::Job;
  if (job != Job::obj && job != Job::stl && job != Job::glb) return false;
  const auto mesh = parse_mesh(file, std::string(isolated::name_of(job)));
  return mesh ? reply.put(isolated::reply_of(*mesh)) : put_error(reply, mesh.error());
}

}  // namespace palpable::sources::decoder
