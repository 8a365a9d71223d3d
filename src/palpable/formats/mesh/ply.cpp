// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/formats/mesh/ply.hpp"

#include "palpable/core/files/byte_writer.hpp"

#include <bit>
#include <cstdint>

#include <fmt/format.h>

namespace palpable::formats {
namespace {

constexpr const char* kHeader =
    "ply\nformat binary_little_endian 1.0\n{}element vertex {}\nproperty float x\n"
    "property float y\nproperty float z\n{}end_header\n";

void put_text(ByteWriter& file, const std::string& text) {
  for (const char c : text) file.u8(static_cast<std::uint8_t>(c));
}

void put_places(ByteWriter& file, const std::vector<Vec3>& places_m) {
  for (const Vec3 v : places_m)
    for (const double c : {v.x, v.y, v.z}) file.u32(std::bit_cast<std::uint32_t>(static_cast<float>(c)));
}

std::vector<std::byte> bytes_of(const ByteWriter& file) { return {file.bytes().begin(), file.bytes().end()}; }

}  // namespace

Result<std::vector<std::byte>> encode_ply(const Mesh& mesh) {
  if (mesh.triangles.empty()) return Error{ErrorCode::failed, "there is no surface to write", {}};
  ByteWriter file;
  put_text(file, fmt::format(fmt::runtime(kHeader), "comment metres\n", mesh.vertices_m.size(),
                             fmt::format("element face {}\nproperty list uchar int vertex_indices\n",
                                         mesh.triangles.size())));
  put_places(file, mesh.vertices_m);
  for (const auto& t : mesh.triangles) {
    file.u8(3);
    for (const std::uint32_t index : t) file.u32(index);
  }
  return bytes_of(file);
}

Result<std::vector<std::byte>> encode_ply(const PointCloud& cloud) {
  if (cloud.places_m.empty()) return Error{ErrorCode::failed, "there are no points to write", {}};
  ByteWriter file;
  put_text(file, fmt::format(fmt::runtime(kHeader), "", cloud.places_m.size(), ""));
  put_places(file, cloud.places_m);
  return bytes_of(file);
}

}  // namespace palpable::formats
