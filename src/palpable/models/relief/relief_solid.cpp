// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/models/relief/relief_solid.hpp"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace palpable::models {
namespace {

/// Vertex coordinates along one axis: the samples, and the two outer edges half a pixel beyond.
std::vector<double> places(int samples, double pixel_m) {
  std::vector<double> at;
  at.push_back(-0.5 * samples * pixel_m);
  for (int k = 0; k < samples; ++k) at.push_back((k - 0.5 * (samples - 1)) * pixel_m);
  at.push_back(0.5 * samples * pixel_m);
  return at;
}

/// The indices of the top's border, counter-clockwise seen from above, beginning top-left.
std::vector<std::uint32_t> border_of(std::uint32_t columns, std::uint32_t rows) {
  std::vector<std::uint32_t> ring;
  for (std::uint32_t j = 0; j + 1 < rows; ++j) ring.push_back(j * columns);
  for (std::uint32_t i = 0; i + 1 < columns; ++i) ring.push_back((rows - 1) * columns + i);
  for (std::uint32_t j = rows - 1; j > 0; --j) ring.push_back(j * columns + columns - 1);
  for (std::uint32_t i = columns - 1; i > 0; --i) ring.push_back(i);
  return ring;
}

}  // namespace

Mesh solid_of(const Relief& relief, const SolidOptions& options) {
  Mesh mesh;
  const auto xs = places(relief.samples_m().width(), relief.pixel_m());
  const auto ys = places(relief.samples_m().height(), relief.pixel_m());
  const auto columns = static_cast<std::uint32_t>(xs.size());
  const auto rows = static_cast<std::uint32_t>(ys.size());
  const auto add = [&](double x, double y, double z) {
    mesh.vertices_m.push_back({x, y, z});
    mesh.picture_places.push_back(
        {static_cast<float>(x / relief.size_x_m() + 0.5), static_cast<float>(0.5 - y / relief.size_y_m())});
    return static_cast<std::uint32_t>(mesh.vertices_m.size() - 1);
  };
  // Rows run from the top of the picture downwards, that is, from +y to -y.
  for (auto y = ys.rbegin(); y != ys.rend(); ++y)
    for (const double x : xs) add(x, *y, relief.sample(x, *y).z_m);
  for (std::uint32_t j = 0; j + 1 < rows; ++j)
    for (std::uint32_t i = 0; i + 1 < columns; ++i) {
      const std::uint32_t a = j * columns + i;
      mesh.triangles.push_back({a, a + columns, a + 1});
      mesh.triangles.push_back({a + 1, a + columns, a + columns + 1});
    }
  const auto top = border_of(columns, rows);
  std::vector<std::uint32_t> bottom;
  bottom.reserve(top.size());
  for (const std::uint32_t k : top)
    bottom.push_back(add(mesh.vertices_m[k].x, mesh.vertices_m[k].y, -options.base_plate_m));
  const std::uint32_t centre = add(0.0, 0.0, -options.base_plate_m);
  for (std::size_t k = 0; k < top.size(); ++k) {
    const std::size_t next = (k + 1) % top.size();
    mesh.triangles.push_back({top[k], bottom[k], top[next]});
    mesh.triangles.push_back({top[next], bottom[k], bottom[next]});
    mesh.triangles.push_back({centre, bottom[next], bottom[k]});
  }
  return mesh;
}

}  // namespace palpable::models
