// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/vision/motion/depth/video_depth.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

// For tests: depth maps of a gabled house on a table, with noise, in a world whose z axis is upwards.
namespace palpable::recipes {

inline constexpr double kHouseEaves = 0.16, kHouseRidge = 0.26, kHouseHalf = 0.15, kHouseLong = 0.2;

/// The distance of a point from the house's roof planes and walls: negative inside.
inline double outside_house(Vec3 p) {
  const double slope = (kHouseRidge - kHouseEaves) / kHouseHalf;
  const double roof = (p.z - kHouseRidge + slope * std::abs(p.x)) / std::sqrt(1 + slope * slope);
  return std::max({std::abs(p.x) - kHouseHalf, std::abs(p.y) - kHouseLong, roof, -p.z});
}

/// Looks at the origin from `from`.
inline vision::CameraPose looking_at_house(Vec3 from) {
  const Vec3 z = unit(-from), x = unit(cross(z, Vec3{0, 0, 1})), y = cross(z, x);
  vision::CameraPose out;
  out.rotation = {x.x, y.x, z.x, x.y, y.y, z.y, x.z, y.z, z.z};
  out.translation_m = from;
  return out;
}

/// `count` maps of 160 x 120 pixels along an arc, each depth with a relative error of `noise`.
inline std::vector<vision::FrameDepth> maps_of_house(int count, double noise) {
  std::vector<vision::FrameDepth> out;
  std::mt19937 random(3);
  std::normal_distribution<double> error(0, noise);
  for (int k = 0; k < count; ++k) {
    const double angle = 0.9 * (k - 0.5 * (count - 1)) / std::max(1, count - 1);
    vision::FrameDepth one;
    one.frame = 10 * k;
    one.map.pose = looking_at_house({0.9 * std::sin(angle), -0.9 * std::cos(angle), 0.8});
    const Pinhole camera{150, 150, 79.5, 59.5, 160, 120};
    one.map.depth.camera = camera;
    one.map.depth.depth_m = Raster<float>(camera.width, camera.height);
    for (int y = 0; y < camera.height; ++y)
      for (int x = 0; x < camera.width; ++x) {
        const Vec3 from = one.map.pose.translation_m;
        const Vec3 ray = one.map.pose.rotate({(x - camera.cx) / camera.fx, (y - camera.cy) / camera.fy, 1});
        // The depth along the optical axis, by sphere tracing: outside_house() is a lower bound.
        double z = 0.0;
        for (int step = 0; step < 300; ++step) {
          const Vec3 p = from + z * ray;
          const double free = std::min(outside_house(p), p.z);
          if (free < 1e-6) break;
          z += free / norm(ray);
        }
        one.map.depth.depth_m(x, y) = static_cast<float>(z * (1 + error(random)));
      }
    out.push_back(std::move(one));
  }
  return out;
}

}  // namespace palpable::recipes
