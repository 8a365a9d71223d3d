// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/vision/motion/structure/bundle.hpp"

#include <cmath>
#include <numeric>
#include <random>
#include <vector>

// For tests: cameras whose poses are known, and where they see points that are known.
namespace palpable::vision {

inline constexpr Pinhole kExactCamera{500, 500, 319.5, 239.5, 640, 480};

/// A camera at distance 1 from the origin, which it faces: `angle` to the side, 0 = on the negative z axis.
inline CameraPose facing_origin(double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  CameraPose pose;
  pose.rotation = {c, 0, -s, 0, 1, 0, s, 0, c};
  pose.translation_m = {s, 0, -c};
  return pose;
}

/// The numbers of frames of which none is left out.
inline std::vector<int> consecutive_numbers(int frames) {
  std::vector<int> out(static_cast<std::size_t>(frames));
  std::iota(out.begin(), out.end(), 0);
  return out;
}

/// Where the camera sees a point in front of it.
inline ImagePoint seen_from(const CameraPose& pose, Vec3 point) {
  const Vec3 p = (pose.inverse() * Point<WorldFrame>{point}).v;
  return {kExactCamera.fx * p.x / p.z + kExactCamera.cx, kExactCamera.fy * p.y / p.z + kExactCamera.cy};
}

/// Points around the origin, within 0.25 along each axis.
inline std::vector<Vec3> points_around_origin(int count) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> place(-0.25, 0.25);
  std::vector<Vec3> out;
  for (int i = 0; i < count; ++i) {
    const double x = place(random), y = place(random);
    out.push_back({x, y, place(random)});
  }
  return out;
}

}  // namespace palpable::vision
