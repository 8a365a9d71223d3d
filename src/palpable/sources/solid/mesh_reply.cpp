// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sources/solid/mesh_reply.hpp"

#include "palpable/core/check.hpp"
#include "palpable/sources/isolated/flat.hpp"
#include "palpable/sources/isolated/isolated.hpp"

#include <algorithm>
#include <cstdint>

namespace palpable::sources::isolated {

std::vector<std::byte> reply_of(const Mesh& mesh) {
  FlatWriter reply;
  begin_value(reply);
  reply.put(static_cast<std::uint64_t>(mesh.vertices_m.size()));
  reply.put(static_cast<std::uint64_t>(mesh.triangles.size()));
  reply.put_array(std::span<const Vec3>(mesh.vertices_m));
  reply.put_array(std::span(mesh.triangles));
  return reply.take();
}

Result<Mesh> mesh_in(std::span<const std::byte> bytes) {
  FlatReader reply(bytes);
  if (auto opened = open_reply(reply); !opened) return std::move(opened).error();
  const auto vertices = reply.get<std::uint64_t>(), triangles = reply.get<std::uint64_t>();
  Mesh mesh;
  mesh.vertices_m = reply.get_array<Vec3>(vertices);
  mesh.triangles = reply.get_array<std::array<std::uint32_t, 3>>(triangles);
  if (!reply.done() || mesh.triangles.empty()) return invalid_reply();
  if (!std::all_of(mesh.vertices_m.begin(), mesh.vertices_m.end(),
                   [](const Vec3& v) { return is_finite(v); }))
    return invalid_input("has a vertex with a coordinate that is not a finite number");
  for (const auto& triangle : mesh.triangles)
    for (const std::uint32_t corner : triangle)
      if (corner >= mesh.vertices_m.size()) return invalid_reply();
  return mesh;
}

Result<Mesh> decode_mesh(FileView file, const std::string& ending) {
  const auto job = job_from(ending);
  PALPABLE_CHECK(job.has_value());
  const auto reply = decode(*job, file);
  if (!reply) return reply.error();
  return mesh_in(reply->bytes());
}

}  // namespace palpable::sources::isolated
