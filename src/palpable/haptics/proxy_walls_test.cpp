// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/haptics/laws.hpp"
#include "palpable/models/relief_distance.hpp"
#include "palpable/models/relief_shaping.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <random>

#include <gtest/gtest.h>

namespace palpable::haptics {
namespace {

constexpr double kPixel_m = 0.00015625;
constexpr double kTick_s = 0.001;
constexpr double kStiffness_N_per_m = 500.0;

/// Walls of 1 mm, grooves and spikes, with and without their slopes limited.
models::Scene obstacles(double steepest_slope) {
  Raster<float> z(320, 240, 0.002F);
  for (int i = 20; i < 320; i += 60)
    for (int j = 0; j < 240; ++j)
      for (int k = 0; k < 6; ++k) {
        z(i + k, j) = 0.010F;
        z(i + 30 + k % 3, j) = 0.0F;
      }
  for (int j = 15; j < 240; j += 40)
    for (int i = 40; i < 320; i += 60) z(i, j) = z(i + 1, j) = z(i, j + 1) = z(i + 1, j + 1) = 0.009F;
  if (steepest_slope > 0.0) models::limit_slope(z, kPixel_m, steepest_slope);
  models::Scene scene;
  scene.model = std::make_shared<const models::Relief>(*models::Relief::from_samples(std::move(z), kPixel_m));
  return scene;
}

/// A hand that changes its mind: speeds up to 1 m/s, above, in and under the surface.
class RandomHand {
 public:
  explicit RandomHand(unsigned seed) : random_(seed) { choose(); }
  Vec3 move() {
    if (--left_ == 0) choose();
    place_ += kTick_s * velocity_;
    const auto turn = [](double& place, double& speed, double low, double high) {
      if (place < low || place > high) speed = -speed;
      place = std::clamp(place, low, high);
    };
    turn(place_.x, velocity_.x, -0.024, 0.024);
    turn(place_.y, velocity_.y, -0.018, 0.018);
    turn(place_.z, velocity_.z, -0.001, 0.013);
    return place_;
  }

 private:
  void choose() {
    std::normal_distribution<double> direction;
    const double speed = std::pow(10.0, std::uniform_real_distribution<double>(-2.0, 0.0)(random_));
    velocity_ = speed * unit(Vec3{direction(random_), direction(random_), 0.4 * direction(random_)});
    left_ = std::uniform_int_distribution<int>(5, 80)(random_);
  }

  std::mt19937 random_;
  Vec3 place_{0, 0, 0.012};
  Vec3 velocity_;
  int left_ = 1;
};

struct Findings {
  int under = 0;
  int missed = 0;
  int not_finite = 0;
  int sunk = 0;
  int pulled = 0;
  int kicked = 0;
};

Findings explore(const models::Scene& scene, double friction, unsigned seed, int ticks) {
  const auto& relief = *std::get<std::shared_ptr<const models::Relief>>(scene.model);
  LawParameters p;
  p.stiffness_N_per_m = kStiffness_N_per_m;
  p.damping_Ns_per_m = 0.0;
  p.static_friction = friction;
  const auto law = *make_touchable(scene, p);
  TouchState state;
  RandomHand hand(seed);
  Findings found;
  Feel last;
  Vec3 last_place{};
  for (int k = 0; k < ticks; ++k) {
    Hand now;
    now.position = {hand.move()};
    const Feel feel = law->feel(now, state);
    const Vec3 place = now.position.v;
    const bool under = place.z < relief.sample(place.x, place.y).z_m;
    found.under += under ? 1 : 0;
    found.missed += under && !feel.contact ? 1 : 0;
    found.not_finite += is_finite(feel.force_N) && is_finite(feel.proxy) ? 0 : 1;
    const double above = feel.proxy.v.z - relief.sample(feel.proxy.v.x, feel.proxy.v.y).z_m;
    found.sunk += above < -1e-9 ? 1 : 0;
    found.pulled += dot(feel.proxy.v - place, feel.force_N.v) < -1e-9 ? 1 : 0;
    if (k > 0) {
      const double moved = norm(place - last_place);
      const double proxy_moved = norm(feel.proxy.v - last.proxy.v);
      const double step_N = norm(feel.force_N - last.force_N);
      if (proxy_moved <= 2 * moved && step_N > kStiffness_N_per_m * (moved + proxy_moved) * 1.05 + 1e-6)
        ++found.kicked;
    }
    last = feel;
    last_place = place;
  }
  return found;
}

TEST(ProxyLaw, IsNeverPassedThroughByARandomHandAtUpToOneMetreASecond) {
  for (const double slope : {3.0, 0.0})
    for (const double friction : {0.0, 0.5}) {
      const Findings found = explore(obstacles(slope), friction, 1, 150000);
      EXPECT_GT(found.under, 30000);
      EXPECT_EQ(found.missed, 0);
      EXPECT_EQ(found.not_finite, 0);
      EXPECT_EQ(found.sunk, 0);
      EXPECT_EQ(found.pulled, 0);
      EXPECT_EQ(found.kicked, 0);
    }
}

TEST(ProxyLaw, ClimbsOverAWallInsteadOfJumpingThroughIt) {
  const models::Scene scene = obstacles(3.0);
  const auto& relief = *std::get<std::shared_ptr<const models::Relief>>(scene.model);
  LawParameters p;
  p.static_friction = 0.0;
  const auto law = *make_touchable(scene, p);
  for (const double speed : {0.1, 0.3, 1.0}) {
    TouchState state;
    Hand hand;
    double highest = 0.0;
    double x = -0.020;
    Vec3 proxy{};
    for (int k = 0; k < 200; ++k) {
      hand.position = {{x, 0.0, 0.012 - 0.00005 * k}};
      proxy = law->feel(hand, state).proxy.v;
    }
    while (x < 0.003) {
      x += speed * kTick_s;
      hand.position = {{x, 0.0, 0.002}};
      const Vec3 next = law->feel(hand, state).proxy.v;
      for (double f = 0.0; f < 1.0; f += 0.1) {
        const double u = proxy.x + f * (next.x - proxy.x);
        highest = std::max(highest, relief.sample(u, proxy.y).z_m - (proxy.z + f * (next.z - proxy.z)));
      }
      proxy = next;
    }
    EXPECT_GT(proxy.x, -0.012) << "it gets across the first wall, which stands at -12.4 mm";
    EXPECT_LT(highest, 0.0009)
        << "and the straight way between two ticks, three steps of a pixel up a slope of "
           "3 and down again, cuts no corner by more than 1.5 of them";
  }
}

}  // namespace
}  // namespace palpable::haptics
