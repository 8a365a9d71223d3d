// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// For the tests of straight strokes that cut a relief or a solid within a tick.
#pragma once

#include "palpable/haptics/law/stroke_scenes.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <random>
#include <string>

#include <gtest/gtest.h>

namespace palpable::haptics {

/// A cut that is nowhere deeper may be missed.
inline constexpr double kMissable_m = 5e-6;

/// PALPABLE_TOUCHES strokes shared by so many scenes, for a measurement; else `usually` for each.
inline int strokes_of_each(int scenes, int usually) {
  const char* wanted = std::getenv("PALPABLE_TOUCHES");
  return wanted != nullptr ? std::max(1, std::atoi(wanted) / scenes) : usually;
}

/// Random numbers of a seed.
class Draw {
 public:
  explicit Draw(unsigned seed) : random_(seed) {}
  double between(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }
  /// Evenly distributed on a logarithmic scale.
  double scaled(double low, double high) { return low * std::pow(high / low, between(0.0, 1.0)); }
  Vec3 direction() {
    std::normal_distribution<double> normal;
    const double x = normal(random_), y = normal(random_), z = normal(random_);
    return unit(Vec3{x, y, z});
  }
  Vec3 place(Vec3 least, Vec3 most) {
    const double x = between(least.x, most.x), y = between(least.y, most.y), z = between(least.z, most.z);
    return {x, y, z};
  }

 private:
  std::mt19937_64 random_;
};

/// A stroke of `ticks` steps before and after its middle, which is near the surface.
struct Stroke {
  Vec3 middle_m;
  Vec3 step_m;
  int ticks = 0;
  Vec3 at(int tick) const { return middle_m + static_cast<double>(tick - ticks) * step_m; }
};

struct CrossingFindings {
  int cuts = 0;
  int missed = 0;
  double deepest_missed_m = 0.0;
  int inside = 0;
  int let_through = 0;
  int sunk = 0;
  int pulled_away = 0;
  int clear = 0;
  int pushed_in_air = 0;
  int held_in_sight = 0;
  /// Cuts in which the proxy came to the hand within the tick, and those in which something was between.
  int crossed = 0;
  int popped_through = 0;
};

/// Follows a stroke over a scene `touched`, whose law has kStrokeStiffness_N_per_m. It states the truth: the
/// height or distance of a place over the surface (over_m), the depth of a path's deepest cut after it was
/// outside (deepest_cut_on), how far below the surface a proxy may be (sunk_m), whether a proxy in contact
/// sees the hand (sees), and whether one without friction, of tiny steps, comes to it (is_reached).
template <class Touched>
void follow(const Touched& touched, const Stroke& stroke, CrossingFindings& findings) {
  TouchState state;
  Hand hand;
  Vec3 last = stroke.at(0);
  if (touched.over_m(last) < 1e-6) return;
  LawOutput before = output_at(*touched.law, state, last);
  for (int n = 1; n <= 2 * stroke.ticks; ++n) {
    const Vec3 p = stroke.at(n);
    hand.position = {p};
    const LawOutput output = touched.law->evaluate(hand, state);
    const double force_N = norm(output.force_N);
    const bool is_felt = output.contact && force_N > 0.0;
    const double deepest_m = touched.deepest_cut_on(last, p);
    const bool began_in_air = touched.over_m(last) > 0.0;
    if (deepest_m > kMissable_m) {
      ++findings.cuts;
      findings.missed += is_felt ? 0 : 1;
      if (!is_felt) findings.deepest_missed_m = std::max(findings.deepest_missed_m, deepest_m);
    }
    findings.inside += touched.over_m(p) < -1e-6 ? 1 : 0;
    findings.let_through += touched.over_m(p) < -1e-6 && !is_felt ? 1 : 0;
    findings.sunk += touched.over_m(output.proxy.v) < -touched.sunk_m() ? 1 : 0;
    findings.pulled_away += dot(output.proxy.v - p, output.force_N.v) < -1e-9 ? 1 : 0;
    if (began_in_air && deepest_m <= 0.0) {
      ++findings.clear;
      findings.pushed_in_air += force_N > 0.0 && !before.contact ? 1 : 0;
      findings.held_in_sight += force_N > 0.0 && before.contact && touched.sees(before.proxy.v, p) ? 1 : 0;
    }
    // The proxy is at the hand if the force is less than that of their distance.
    const bool is_free =
        output.contact && force_N < 0.99 * kStrokeStiffness_N_per_m * norm(output.proxy.v - p);
    if (is_free && began_in_air && !before.contact) {
      ++findings.crossed;
      findings.popped_through += touched.is_reached(last, p) ? 0 : 1;
    }
    before = output;
    last = p;
  }
}

/// Every first contact in its tick, a force wherever the hand is inside, and none in free air.
inline void expect_contact_in_its_tick(const CrossingFindings& findings, const std::string& where) {
  EXPECT_EQ(findings.missed, 0) << "of " << findings.cuts << ", up to " << findings.deepest_missed_m
                                << " m deep: " << where;
  EXPECT_EQ(findings.let_through, 0) << "of " << findings.inside << ": " << where;
  EXPECT_EQ(findings.pulled_away, 0) << where;
  EXPECT_EQ(findings.pushed_in_air, 0) << "of " << findings.clear << ": " << where;
  EXPECT_EQ(findings.held_in_sight, 0) << "of " << findings.clear << ": " << where;
}

/// And the proxy on the surface, on the side from which the hand came.
inline void expect_nothing_missed(const CrossingFindings& findings, const std::string& where) {
  expect_contact_in_its_tick(findings, where);
  EXPECT_EQ(findings.sunk, 0) << where;
  EXPECT_EQ(findings.popped_through, 0) << "of " << findings.crossed << ": " << where;
}

}  // namespace palpable::haptics
