// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/study/world/viewer.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace palpable::study {
namespace {

/// Of a camera with a projector beside it.
constexpr double kBaseline_m = 0.075, kDisparityStep_px = 0.125;

/// Depth at which the ray (x, y, 1) enters an ellipsoid; infinite if it misses.
double enter(const Ellipsoid& e, double x, double y) {
  const double c = std::cos(e.turn_rad), s = std::sin(e.turn_rad);
  const auto scaled = [&](Vec3 p) {
    return Vec3{(c * p.x - s * p.z) / e.half_m.x, p.y / e.half_m.y, (s * p.x + c * p.z) / e.half_m.z};
  };
  const Vec3 d = scaled({x, y, 1.0}), o = scaled(-e.middle_m);
  const double a = dot(d, d), b = dot(d, o), under = b * b - a * (dot(o, o) - 1.0);
  const double z = under >= 0.0 ? (-b - std::sqrt(under)) / a : -1.0;
  return z > 0.0 ? z : std::numeric_limits<double>::infinity();
}

void draw(const Ellipsoid& e, const Pinhole& camera, Raster<float>& depth_m, Raster<std::uint8_t>& dark) {
  const double reach = std::max({e.half_m.x, e.half_m.y, e.half_m.z});
  const double nearest = std::max(0.05, e.middle_m.z - reach);
  const auto bound = [](double at, int size) { return static_cast<int>(std::clamp(at, 0.0, size - 1.0)); };
  const double left = std::min((e.middle_m.x - reach) / nearest, (e.middle_m.x - reach) / e.middle_m.z);
  const double right = std::max((e.middle_m.x + reach) / nearest, (e.middle_m.x + reach) / e.middle_m.z);
  const double top = std::min((e.middle_m.y - reach) / nearest, (e.middle_m.y - reach) / e.middle_m.z);
  const double bottom = std::max((e.middle_m.y + reach) / nearest, (e.middle_m.y + reach) / e.middle_m.z);
  for (int v = bound(camera.cy + camera.fy * top, camera.height);
       v <= bound(camera.cy + camera.fy * bottom, camera.height); ++v)
    for (int u = bound(camera.cx + camera.fx * left, camera.width);
         u <= bound(camera.cx + camera.fx * right, camera.width); ++u) {
      const double z = enter(e, (u - camera.cx) / camera.fx, (v - camera.cy) / camera.fy);
      if (!(z < static_cast<double>(depth_m(u, v)))) continue;
      depth_m(u, v) = static_cast<float>(z);
      dark(u, v) = e.is_dark ? 1 : 0;
    }
}

/// Smoothly from 0 to 1 and back between these times.
double hump(double time_s, double begin_s, double end_s) {
  if (time_s <= begin_s || time_s >= end_s) return 0.0;
  const double part = (time_s - begin_s) / (end_s - begin_s);
  return std::pow(std::sin(std::numbers::pi * part), 2);
}

}  // namespace

Viewer::Viewer(const ViewerOptions& options) : options_(options), random_(options.seed) {
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  size_ = 0.9 + 0.18 * uniform(random_);
  hair_m_ = 0.025 * uniform(random_);
  seat_ = {-0.1 + 0.2 * uniform(random_), 0.02 + 0.1 * uniform(random_), 0.6 + 0.5 * uniform(random_)};
  has_head_rest_ = uniform(random_) < 0.3;
  std::vector<Board> boards{{{0.0, 0.45, seat_.z + 0.22}, 0.24, 0.33},
                            {{-0.7, -0.25, 1.9}, 0.3, 0.4},
                            {{0.55, 0.6, 1.5}, 0.012, 0.6},
                            {{0.2, 0.75, 0.5}, 0.6, 0.02}};
  boards.front().middle_m.x = seat_.x;
  if (has_head_rest_) boards.push_back({{seat_.x, 0.02 + seat_.y, seat_.z + 0.18}, 0.13, 0.09});
  const Pinhole& camera = options_.camera;
  room_m_ = Raster<float>(camera.width, camera.height);
  for (int v = 0; v < camera.height; ++v)
    for (int u = 0; u < camera.width; ++u) {
      const Vec3 level = vision::DownwardCamera{camera, options_.down_rad}.ray(u, v);
      // Back wall, side wall, floor.
      double z = level.z > 0.0 ? 2.6 / level.z : 1e9;
      if (level.x < 0.0) z = std::min(z, -1.3 / level.x);
      if (level.y > 0.0) z = std::min(z, 1.15 / level.y);
      for (const Board& board : boards) {
        const double at = board.middle_m.z / level.z;
        if (at > 0.0 && at < z && std::abs(at * level.x - board.middle_m.x) < board.half_width_m &&
            std::abs(at * level.y - board.middle_m.y) < board.half_height_m)
          z = at;
      }
      room_m_(u, v) = static_cast<float>(z);
    }
  Raster<std::uint8_t> dark(camera.width, camera.height);
  draw({in_camera({0.55, -0.1, 1.5}), {0.1, 0.1, 0.1}}, camera, room_m_, dark);
}

Vec3 Viewer::in_camera(Vec3 p) const {
  const double c = std::cos(options_.down_rad), s = std::sin(options_.down_rad);
  return {p.x, c * p.y - s * p.z, s * p.y + c * p.z};
}

ViewerPose Viewer::pose_at(double time_s) const {
  ViewerPose pose;
  pose.head_m = seat_;
  if (time_s > kStill_s && time_s < kHidden_s) {
    const double t = 2.0 * std::numbers::pi * (time_s - kStill_s);
    pose.head_m += Vec3{0.06 * std::sin(0.25 * t), 0.02 * std::sin(0.4 * t), 0.04 * std::sin(0.2 * t)};
    pose.turn_rad = 0.2 * std::sin(0.3 * t);
  }
  pose.left_hand = hump(time_s, 8.0, 11.0);
  pose.right_hand = hump(time_s, 9.5, 13.0);
  if (time_s >= kHidden_s) {
    pose.hides_face = true;
    pose.hand_before_face_m = 0.4 * std::cos(std::numbers::pi * (time_s - kHidden_s));
  }
  return pose;
}

std::vector<Ellipsoid> Viewer::body(const ViewerPose& pose) const {
  std::vector<Ellipsoid> all;
  const double c = std::cos(pose.turn_rad), s = std::sin(pose.turn_rad);
  const auto add = [&](Vec3 from_head, Vec3 half, double turn_rad = 0.0, bool is_dark = false) {
    all.push_back({in_camera(pose.head_m + from_head), half, turn_rad, is_dark});
  };
  const auto of_head = [&](Vec3 p) { return size_ * Vec3{c * p.x + s * p.z, p.y, c * p.z - s * p.x}; };
  add({}, size_ * Vec3{0.077, 0.115, 0.098}, pose.turn_rad);
  add(of_head({0.0, -0.022, 0.022}), size_ * Vec3{0.078, 0.1, 0.09} + hair_m_ * Vec3{1.0, 1.0, 1.0},
      pose.turn_rad, true);
  add(of_head({0.0, 0.025, -0.098}), size_ * Vec3{0.016, 0.025, 0.02});
  add({0.0, 0.15, 0.02}, {0.058, 0.09, 0.058});
  add({0.0, 0.3, 0.03}, {0.21, 0.1, 0.11});
  add({0.0, 0.55, 0.03}, {0.17, 0.3, 0.12});
  for (const double side : {-1.0, 1.0}) {
    const double raised = side < 0.0 ? pose.left_hand : pose.right_hand;
    add({0.22 * side, 0.42, 0.02}, {0.05, 0.16, 0.05});
    add({0.22 * side, 0.6 - 0.42 * raised, -0.12}, {0.04, 0.14, 0.04});
    add({(0.22 - 0.06 * raised) * side, 0.62 - 0.64 * raised, -0.14}, {0.045, 0.095, 0.03});
  }
  if (pose.hides_face) {
    add({pose.hand_before_face_m, 0.02, -0.25}, {0.045, 0.095, 0.03});
    add({pose.hand_before_face_m + 0.08, 0.2, -0.2}, {0.045, 0.14, 0.045});
  }
  return all;
}

Point<vision::LevelFrame> Viewer::eyes(const ViewerPose& pose) const {
  const double c = std::cos(pose.turn_rad), s = std::sin(pose.turn_rad);
  const Vec3 before{0.0, -0.004, -0.083};
  return {pose.head_m + size_ * Vec3{s * before.z, before.y, c * before.z}};
}

Raster<float> Viewer::depth(const ViewerPose& pose) {
  Raster<float> depth_m = room_m_;
  Raster<std::uint8_t> dark(depth_m.width(), depth_m.height());
  for (const Ellipsoid& part : body(pose)) draw(part, options_.camera, depth_m, dark);
  return options_.is_exact ? depth_m : measured(std::move(depth_m), dark);
}

Raster<float> Viewer::empty_depth() {
  return options_.is_exact ? room_m_
                           : measured(room_m_, Raster<std::uint8_t>(room_m_.width(), room_m_.height()));
}

Raster<float> Viewer::measured(Raster<float> exact_m, const Raster<std::uint8_t>& dark) {
  constexpr double kFloor_m = 0.0005, kPer_m2 = 0.0014, kEdge_m = 0.05, kLost = 0.01, kDarkLost = 0.35;
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  const Pinhole& camera = options_.camera;
  Raster<float> depth_m(exact_m.width(), exact_m.height(), kUnknownDepth);
  for (int v = 0; v < camera.height; ++v) {
    // What the projector, to the right of the camera, has lit last in this row.
    double lit = -std::numeric_limits<double>::infinity();
    for (int u = 0; u < camera.width; ++u) {
      double z = exact_m(u, v);
      const double towards = u - camera.fx * kBaseline_m / z;
      const bool is_shadowed = towards < lit - 0.5;
      lit = std::max(lit, towards);
      const double beside = exact_m(std::min(u + 1, camera.width - 1), v);
      const double below = exact_m(u, std::min(v + 1, camera.height - 1));
      const double step = std::max(std::abs(beside - z), std::abs(below - z));
      if (is_shadowed || uniform(random_) < (dark(u, v) != 0 ? kDarkLost : kLost)) continue;
      if (step > kEdge_m) {
        if (uniform(random_) < 0.4) continue;
        z += uniform(random_) * 0.5 * (beside - z);
      }
      z += (kFloor_m + kPer_m2 * z * z) * normal(random_);
      const double disparity = camera.fx * kBaseline_m / z;
      const double seen = kDisparityStep_px * std::round(disparity / kDisparityStep_px);
      if (seen > 0.0 && z > 0.3) depth_m(u, v) = static_cast<float>(camera.fx * kBaseline_m / seen);
    }
  }
  return depth_m;
}

}  // namespace palpable::study
