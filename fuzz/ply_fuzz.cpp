// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sources/solid/ply_file.hpp"

#include <cstdint>
#include <cstdlib>
#include <span>

// The triangles of a mesh that can be read refer to existing vertices only, and all vertices are finite.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto file = std::as_bytes(std::span(data, size));
  if (const auto mesh = palpable::sources::decode_ply_mesh(file)) {
    for (const auto& triangle : mesh->triangles)
      for (const std::uint32_t corner : triangle)
        if (corner >= mesh->vertices_m.size()) std::abort();
    for (const palpable::Vec3& v : mesh->vertices_m)
      if (!is_finite(v)) std::abort();
  }
  if (const auto points = palpable::sources::decode_ply_points(file))
    if (!points->normals.empty() && points->normals.size() != points->places_m.size()) std::abort();
  return 0;
}
