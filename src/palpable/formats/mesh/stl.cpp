// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/formats/mesh/stl.hpp"

#include "palpable/core/files/byte_writer.hpp"

#include <bit>
#include <cstdint>
#include <string_view>

namespace palpable::formats {

Result<std::vector<std::byte>> encode_stl(const Mesh& mesh) {
  constexpr std::size_t kMostTriangles = 50'000'000;
  if (mesh.triangles.empty()) return Error{ErrorCode::failed, "there is no surface to write", {}};
  if (mesh.triangles.size() > kMostTriangles)
    return Error{ErrorCode::failed, "the surface has more than 50 million triangles", {}};
  constexpr std::string_view kTitle = "Palpable, binary STL, millimetres";
  constexpr std::size_t kHeaderBytes = 80;
  ByteWriter file;
  for (std::size_t k = 0; k < kHeaderBytes; ++k)
    file.u8(k < kTitle.size() ? static_cast<std::uint8_t>(kTitle[k]) : ' ');
  file.u32(static_cast<std::uint32_t>(mesh.triangles.size()));
  const auto vector = [&file](Vec3 v) {
    for (const double c : {v.x, v.y, v.z}) file.u32(std::bit_cast<std::uint32_t>(static_cast<float>(c)));
  };
  for (const auto& t : mesh.triangles) {
    const Vec3 a = mesh.vertices_m[t[0]];
    const Vec3 b = mesh.vertices_m[t[1]];
    const Vec3 c = mesh.vertices_m[t[2]];
    vector(unit(cross(b - a, c - a)));
    for (const Vec3 corner : {a, b, c}) vector(1000.0 * corner);
    file.u16(0);
  }
  return std::vector<std::byte>(file.bytes().begin(), file.bytes().end());
}

}  // namespace palpable::formats
