// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/formats/mesh/ply.hpp"

#include "palpable/core/byte_writer.hpp"

#include <bit>
#include <cstdint>

#include <fmt/format.h>

namespace palpable::formats {

Result<std::vector<std::byte>> encode_ply(const Mesh& mesh) {
  if (mesh.triangles.empty()) return Error{ErrorCode::failed, "there is no surface to write", {}};
  ByteWriter file;
  const std::string header = fmt::format(
      "ply\nformat binary_little_endian 1.0\ncomment metres\nelement vertex {}\nproperty float x\n"
      "property float y\nproperty float z\nelement face {}\nproperty list uchar int vertex_indices\n"
      "end_header\n",
      mesh.vertices_m.size(), mesh.triangles.size());
  for (const char c : header) file.u8(static_cast<std::uint8_t>(c));
  for (const Vec3 v : mesh.vertices_m)
    for (const double c : {v.x, v.y, v.z}) file.u32(std::bit_cast<std::uint32_t>(static_cast<float>(c)));
  for (const auto& t : mesh.triangles) {
    file.u8(3);
    for (const std::uint32_t index : t) file.u32(index);
  }
  return std::vector<std::byte>(file.bytes().begin(), file.bytes().end());
}

}  // namespace palpable::formats
