// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/cli/commands/bench_field.hpp"

#include "palpable/sculpt/field/field_from_source.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace palpable::cli {
namespace {

class TwoBalls final : public sculpt::DistanceSource {
 public:
  models::DistanceSample at(Vec3 p, Hint& /*hint*/) const override {
    const Vec3 a = p - Vec3{-kApart_m, 0.0, 0.0}, b = p - Vec3{kApart_m, 0.0, 0.0};
    const Vec3 nearer = squared_norm(a) < squared_norm(b) ? a : b;
    const double length = norm(nearer);
    // Inside, the circle of the crease is nearer than the far side of the other ball.
    const double across = std::hypot(p.y, p.z),
                 crease = std::sqrt(kRadius_m * kRadius_m - kApart_m * kApart_m);
    const double way_x = p.x, way_r = across - crease;
    const double to_crease = std::hypot(way_x, way_r);
    if (length < kRadius_m && kRadius_m - length < to_crease && std::abs(p.x) * crease < kApart_m * across)
      return {length - kRadius_m, unit(nearer)};
    if (length < kRadius_m && std::abs(p.x) * crease < kApart_m * across && across > 0.0)
      return {-to_crease,
              (-1.0 / std::max(to_crease, 1e-12)) * Vec3{way_x, way_r * p.y / across, way_r * p.z / across}};
    return {length - kRadius_m, length > 0.0 ? unit(nearer) : Vec3{0.0, 0.0, 1.0}};
  }
  sculpt::Box bounds() const override {
    return {{-kApart_m - kRadius_m, -kRadius_m, -kRadius_m}, {kApart_m + kRadius_m, kRadius_m, kRadius_m}};
  }

 private:
  static constexpr double kApart_m = 0.02;
  static constexpr double kRadius_m = 0.03;
};

/// Evaluates only the model.
class Asking final : public haptics::Touchable {
 public:
  explicit Asking(const models::DistanceField& field) : field_(field) {}
  haptics::LawOutput evaluate(const haptics::Hand& hand,
                              haptics::TouchState& /*state*/) const noexcept override {
    const models::FieldSample s = field_.sample(hand.position);
    haptics::LawOutput output;
    output.force_N = s.gradient;
    output.stored_J = s.distance_m;
    output.contact = s.distance_m < 0.0;
    return output;
  }
  std::uint64_t state_family() const noexcept override { return 0; }
  double damping_Ns_per_m() const noexcept override { return 0.0; }
  void touch_pages() const noexcept override {}

 private:
  const models::DistanceField& field_;
};

}  // namespace

Result<models::Scene> own_field_scene(const Work& work) {
  const TwoBalls balls;
  auto distance = sculpt::field_from_source(balls, {}, work);
  if (!distance) return distance.error();
  const sculpt::Box box = balls.bounds();
  auto field = models::field_of(std::move(*distance), box.least_m, box.most_m);
  if (!field) return field.error();
  models::Scene scene;
  scene.model = std::make_shared<const models::Field>(std::move(*field));
  return scene;
}

std::vector<haptics::PathSample> own_field_path(const models::DistanceField& field) {
  constexpr int kTicks = 60000;
  constexpr double kTick_s = 0.001, kUnder_m = 0.0005, kFastest_m_per_s = 1.0;
  std::vector<haptics::PathSample> path;
  path.reserve(kTicks);
  // The hand follows a point that moves through both balls, along their surface.
  Vec3 hand{0.0, 0.0, 0.03};
  for (int i = 0; i < kTicks; ++i) {
    const double t = i * kTick_s, turn = 2.0 * std::numbers::pi;
    const Vec3 way = Vec3{0.055 * std::sin(turn * 0.31 * t), 0.03 * std::sin(turn * 0.47 * t),
                          0.03 * std::cos(turn * 0.23 * t)} -
                     hand;
    hand += std::min(1.0, kFastest_m_per_s * kTick_s / std::max(norm(way), 1e-9)) * way;
    constexpr int kSteps = 12;
    for (int step = 0; step < kSteps; ++step) {
      const models::FieldSample s = field.sample({hand});
      hand -= (s.distance_m + kUnder_m) * unit(s.gradient.v);
    }
    path.push_back({t, {hand}});
  }
  return path;
}

haptics::TickTimes time_samples(const models::DistanceField& field,
                                std::span<const haptics::PathSample> path) {
  return haptics::time_path(Asking(field), path);
}

}  // namespace palpable::cli
