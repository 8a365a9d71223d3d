// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/haptics/proxy/proxy_force.hpp"

#include <algorithm>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

namespace palpable::haptics {
namespace {

/// friction_damping() by its formula alone, with all its roots.
double damping_by_roots(const Hand& hand, const Contact& contact, double slid_m, const Outward& out,
                        double pressing_out) {
  const Vec3 v = hand.velocity_m_per_s.v;
  const double speed = norm(v - (dot(v, out.v) / out.length2) * out.v);
  const double held = speed - slid_m / hand.dt_s;
  if (held <= 0.0) return 0.0;
  const double pressing_N = pressing_out / std::sqrt(out.length2);
  return std::min(contact.damping_Ns_per_m * held, contact.static_friction * pressing_N) / speed;
}

// Proxies at rest, behind the hand, ahead of it, and at the hand's speed but for rounding.
TEST(ProxyForce, FrictionDampingIsThatOfItsFormula) {
  std::mt19937 random(20261126);
  std::uniform_real_distribution<double> one(-1.0, 1.0);
  const auto any = [&](double scale) { return scale * Vec3{one(random), one(random), one(random)}; };
  const Contact contact{500.0, 1.5, 0.4, 0.33};
  int none = 0;
  int some = 0;
  for (int k = 0; k < 20000; ++k) {
    Hand hand;
    hand.velocity_m_per_s.v = any(k % 7 == 0 ? 0.0 : 0.5);
    hand.dt_s = 0.001 + 0.0005 * one(random);
    const Vec3 slope = any(2.0);
    const Vec3 out{-slope.x, -slope.y, 1.0};
    const Outward outward{out, squared_norm(out)};
    const Vec3 v = hand.velocity_m_per_s.v;
    const double speed_out = dot(v, out);
    const Vec3 along = v - (speed_out / outward.length2) * out;
    const double shares[] = {0.0, 0.5, 1.0, 1.0 + 1e-12, 1.0 - 1e-12, 2.0};
    const double slid_m = shares[k % 6] * hand.dt_s * norm(along);
    const double pressing_out = 1.0 + one(random);
    const double damping = friction_damping(hand, contact, slid_m * slid_m, outward, speed_out, pressing_out);
    const double wanted = damping_by_roots(hand, contact, slid_m, outward, pressing_out);
    ASSERT_NEAR(damping, wanted, 1e-9 * contact.damping_Ns_per_m) << k;
    ++(wanted > 1e-9 ? some : none);
  }
  EXPECT_GT(none, 5000);
  EXPECT_GT(some, 5000);
}

}  // namespace
}  // namespace palpable::haptics
