// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/recipes/solid/world_orientation.hpp"

namespace palpable::recipes {

std::array<double, 9> scene_rotation_for(
    std::span<const Transform<models::InputFrame, CameraFrame>> world_from_cameras) {
  Vec3 forward{}, up{};
  for (const auto& pose : world_from_cameras) {
    forward = forward + pose.rotate({0.0, 0.0, 1.0});
    up = up + pose.rotate({0.0, -1.0, 0.0});
  }
  constexpr std::array<Vec3, 6> kAxes{{{0, 0, 1}, {0, 1, 0}, {1, 0, 0}, {0, 0, -1}, {0, -1, 0}, {-1, 0, 0}}};
  std::array<double, 9> best{1, 0, 0, 0, 1, 0, 0, 0, 1};
  // Axes of the scene in the world frame. The world's own axes are kept unless others are clearly better.
  double most = dot(up, kAxes[1]) - dot(forward, kAxes[0]) + 1e-9;
  for (const Vec3& z : kAxes)
    for (const Vec3& y : kAxes) {
      if (dot(y, z) != 0.0) continue;
      const double score = dot(up, y) - dot(forward, z);
      if (score <= most) continue;
      most = score;
      const Vec3 x = cross(y, z);
      best = {x.x, x.y, x.z, y.x, y.y, y.z, z.x, z.y, z.z};
    }
  return best;
}

}  // namespace palpable::recipes
