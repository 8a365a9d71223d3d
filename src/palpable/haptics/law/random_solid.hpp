// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

// Random solids of known distance, for tests of touch on fields.

#include "palpable/models/field/distance_surface.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <random>
#include <vector>

namespace palpable::haptics {

/// Balls, boxes and cones on a plate or on waves, 40 x 30 mm. In every second solid the creases between the
/// parts are rounded over half a cell, as a sampled field's are.
class RandomSolid {
 public:
  explicit RandomSolid(unsigned seed) {
    std::mt19937 random(seed);
    const auto uniform = [&](double least, double most) {
      return std::uniform_real_distribution<double>(least, most)(random);
    };
    wave_m_ = uniform(0.0, 1.0) < 0.5 ? 0.0 : uniform(0.0005, 0.0025);
    per_m_ = {2.0 * std::numbers::pi / uniform(0.004, 0.016), 2.0 * std::numbers::pi / uniform(0.004, 0.016)};
    // Their distance is estimated from the height above them, so it is up to sqrt(1 + slope^2) times too
    // large. A field's is at most a fourth too large.
    wave_m_ = std::min(wave_m_, kSteepestWave / std::max(per_m_.x, per_m_.y));
    cell_m_ = uniform(0.0, 1.0) < 0.5 ? 2e-4 : 4e-4;
    rounding_m_ = uniform(0.0, 1.0) < 0.5 ? 0.0 : 2.0 * cell_m_;
    const int count = std::uniform_int_distribution<int>(8, 28)(random);
    for (int n = 0; n < count; ++n) {
      Part part;
      part.kind = static_cast<Kind>(std::uniform_int_distribution<int>(0, 2)(random));
      part.middle_m = {uniform(-0.020, 0.020), uniform(-0.015, 0.015), uniform(-0.0012, 0.0028)};
      part.half_m = {uniform(0.001, 0.0045), uniform(0.001, 0.0045), uniform(0.001, 0.0045)};
      const double angle = uniform(0.0, 2.0 * std::numbers::pi);
      part.along = {std::cos(angle), std::sin(angle), 0.0};
      parts_.push_back(part);
    }
  }

  models::FieldSample sample(Point<SceneFrame> place) const noexcept {
    const Vec3 p = place.v;
    constexpr double kStep_m = 1e-8;
    const auto slope = [&](Vec3 step) {
      return (distance_m(p + step) - distance_m(p - step)) / (2.0 * kStep_m);
    };
    return {distance_m(p), {{slope({kStep_m, 0, 0}), slope({0, kStep_m, 0}), slope({0, 0, kStep_m})}}};
  }
  double cell_m() const noexcept { return cell_m_; }
  std::size_t memory_bytes() const noexcept { return sizeof(*this); }

 private:
  static constexpr double kSteepestWave = 0.7;
  enum class Kind { ball, box, cone };
  struct Part {
    Kind kind = Kind::ball;
    Vec3 middle_m;
    /// A ball's radius is x, a cone's radius x and its height twice z.
    Vec3 half_m;
    Vec3 along;
  };

  double ground_m(Vec3 p) const noexcept {
    const double height_m = wave_m_ * std::sin(per_m_.x * p.x) * std::sin(per_m_.y * p.y);
    const double slope_x = wave_m_ * per_m_.x * std::cos(per_m_.x * p.x) * std::sin(per_m_.y * p.y);
    const double slope_y = wave_m_ * per_m_.y * std::sin(per_m_.x * p.x) * std::cos(per_m_.y * p.y);
    return (p.z - height_m) / std::sqrt(1.0 + slope_x * slope_x + slope_y * slope_y);
  }

  static double cone_m(Vec3 p, double radius_m, double height_m) noexcept {
    const double r = std::hypot(p.x, p.y);
    const auto to_edge = [&](double r0, double z0, double r1, double z1) {
      const double dr = r1 - r0;
      const double dz = z1 - z0;
      const double share = std::clamp(((r - r0) * dr + (p.z - z0) * dz) / (dr * dr + dz * dz), 0.0, 1.0);
      return std::hypot(r - r0 - share * dr, p.z - z0 - share * dz);
    };
    const double to_surface =
        std::min(to_edge(0.0, 0.0, radius_m, 0.0), to_edge(radius_m, 0.0, 0.0, height_m));
    return p.z > 0.0 && r / radius_m + p.z / height_m < 1.0 ? -to_surface : to_surface;
  }

  static double part_m(const Part& part, Vec3 p) noexcept {
    const Vec3 d = p - part.middle_m;
    const Vec3 q{dot(d, part.along), d.y * part.along.x - d.x * part.along.y, d.z};
    if (part.kind == Kind::ball) return norm(q) - part.half_m.x;
    if (part.kind == Kind::cone) return cone_m(q, part.half_m.x, 2.0 * part.half_m.z);
    const Vec3 out{std::abs(q.x) - part.half_m.x, std::abs(q.y) - part.half_m.y,
                   std::abs(q.z) - part.half_m.z};
    return norm({std::max(out.x, 0.0), std::max(out.y, 0.0), std::max(out.z, 0.0)}) +
           std::min(0.0, std::max({out.x, out.y, out.z}));
  }

  double distance_m(Vec3 p) const noexcept {
    double least = ground_m(p);
    for (const Part& part : parts_) {
      const double next = part_m(part, p);
      const double near = std::max(rounding_m_ - std::abs(least - next), 0.0);
      least = std::min(least, next) - (rounding_m_ > 0.0 ? 0.25 * near * near / rounding_m_ : 0.0);
    }
    return least;
  }

  double wave_m_ = 0.0;
  Vec3 per_m_;
  double cell_m_ = 0.0;
  double rounding_m_ = 0.0;
  std::vector<Part> parts_;
};

}  // namespace palpable::haptics
