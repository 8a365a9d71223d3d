// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

// Scenes for tests of fast strokes: rough reliefs of any resolution, and solids of known distance.

#include "palpable/haptics/law/field_proxy.hpp"
#include "palpable/haptics/law/test_scenes.hpp"

#include <algorithm>
#include <cmath>
#include <random>
#include <utility>

namespace palpable::haptics {

inline constexpr double kStrokeStiffness_N_per_m = 500.0;

/// Plateaus, walls and hills over 60 x 40 mm.
inline models::Scene rough_scene(double pixel_m, std::mt19937& random) {
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  Raster<float> z(static_cast<int>(0.06 / pixel_m), static_cast<int>(0.04 / pixel_m));
  for (int k = 0; k < 30; ++k) {
    const double x = unit(random) * z.width();
    const double y = unit(random) * z.height();
    const double half = (0.0005 + 0.006 * unit(random)) / pixel_m;
    const float height = static_cast<float>(0.008 * unit(random));
    const bool is_hill = k % 2 == 0;
    for (int j = 0; j < z.height(); ++j)
      for (int i = 0; i < z.width(); ++i) {
        const double d = std::hypot(i - x, j - y) / half;
        if (is_hill) z(i, j) += height * static_cast<float>(std::exp(-d * d));
        if (!is_hill && d < 1.0) z(i, j) = std::max(z(i, j), height);
      }
  }
  return scene_of(std::move(z), pixel_m);
}

/// The union of a plate and balls of 3 mm on it.
class Pebbles {
 public:
  models::FieldSample sample(Point<SceneFrame> place) const noexcept {
    const Vec3 p = place.v;
    const Vec3 middle{0.008 * std::round(p.x / 0.008), 0.008 * std::round(p.y / 0.008), 0.002};
    const Vec3 away = p - middle;
    const double ball = norm(away) - 0.003;
    return ball < p.z ? models::FieldSample{ball, {unit(away)}} : models::FieldSample{p.z, {{0.0, 0.0, 1.0}}};
  }
  /// Whether the straight segment between two surface points passes through the middle of a ball. (A proxy
  /// that moves to a hand in free air may have passed around it.)
  static bool divides(Vec3 a, Vec3 b) {
    constexpr double kNear_m = 1e-4;
    if (Pebbles().sample({b}).distance_m > kNear_m) return false;
    const Vec3 half = 0.5 * (a + b);
    const Vec3 middle{0.008 * std::round(half.x / 0.008), 0.008 * std::round(half.y / 0.008), 0.002};
    const Vec3 way = b - a;
    const double share = std::clamp(dot(middle - a, way) / std::max(squared_norm(way), 1e-18), 0.0, 1.0);
    return norm(a + share * way - middle) < 0.001;
  }
  double cell_m() const noexcept { return 2e-4; }
  std::size_t memory_bytes() const noexcept { return sizeof(*this); }
};

/// Walls 1 mm thick and 9 mm high on a plate, 8 mm apart.
class Walls {
 public:
  models::FieldSample sample(Point<SceneFrame> place) const noexcept {
    const Vec3 p = place.v;
    const double from_middle = p.x - 0.008 * std::round(p.x / 0.008);
    const double side = from_middle < 0.0 ? -1.0 : 1.0;
    const double out_x = std::abs(from_middle) - 0.0005;
    const double out_z = p.z - 0.009;
    models::FieldSample wall{std::max(out_x, out_z), {}};
    wall.gradient.v = out_x > out_z ? Vec3{side, 0.0, 0.0} : Vec3{0.0, 0.0, 1.0};
    if (out_x > 0.0 && out_z > 0.0) {
      wall.distance_m = std::hypot(out_x, out_z);
      wall.gradient.v = (1.0 / wall.distance_m) * Vec3{side * out_x, 0.0, out_z};
    }
    return wall.distance_m < p.z ? wall : models::FieldSample{p.z, {{0.0, 0.0, 1.0}}};
  }
  /// Whether there is a wall between two points that rises 2 mm above both.
  static bool divides(Vec3 a, Vec3 b) {
    const double wall = 0.008 * std::round(0.5 * (a.x + b.x) / 0.008);
    return (a.x < wall) != (b.x < wall) && std::max(a.z, b.z) < 0.007;
  }
  double cell_m() const noexcept { return 2e-4; }
  std::size_t memory_bytes() const noexcept { return sizeof(*this); }
};

template <class Solid>
class SolidTouchable final : public Touchable {
 public:
  explicit SolidTouchable(double friction, double radius_m = 0.0)
      : SolidTouchable(MaterialMap({kStrokeStiffness_N_per_m, 0.0, friction, friction}), radius_m) {}
  SolidTouchable(MaterialMap materials, double radius_m, Textures textures = Textures({}))
      : law_(std::make_shared<const Solid>(), std::move(materials), radius_m, std::move(textures)) {}
  LawOutput evaluate(const Hand& hand, TouchState& state) const noexcept override {
    return law_.evaluate(hand, state_as<typename FieldProxyLaw<Solid>::State>(state));
  }
  HandOver hand_over(const TouchState& state) const noexcept override {
    return law_.hand_over(state_as<typename FieldProxyLaw<Solid>::State>(state));
  }
  void take_over(const HandOver& from, TouchState& state) const noexcept override {
    law_.take_over(from, state_as<typename FieldProxyLaw<Solid>::State>(state));
  }
  std::uint64_t state_family() const noexcept override { return 1; }
  EnergyModel energy_model() const noexcept override { return law_.energy_model(); }
  double damping_Ns_per_m() const noexcept override { return law_.damping_Ns_per_m(); }
  void touch_pages() const noexcept override {}

 private:
  FieldProxyLaw<Solid> law_;
};

}  // namespace palpable::haptics
