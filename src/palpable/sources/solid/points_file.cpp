// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sources/solid/points_file.hpp"

#include "palpable/core/files/read_file.hpp"
#include "palpable/sources/solid/ply_file.hpp"

namespace palpable::sources {

Result<PointCloud> decode_points(std::span<const std::byte> file) {
  auto cloud = decode_ply_points(file);
  if (cloud && cloud->places_m.empty()) return invalid_input("holds no points");
  return cloud;
}

Result<PointCloud> read_points(const std::filesystem::path& path) {
  const auto file = read_file(path);
  if (!file) return file.error();
  auto cloud = decode_points(*file);
  if (!cloud) cloud.error().place = path.string();
  return cloud;
}

}  // namespace palpable::sources
