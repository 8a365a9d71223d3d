// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// What an account of energy takes from a force is a step of the force that neither surface nor hand caused.
#include "palpable/haptics/law/test_period.hpp"
#include "palpable/haptics/servo/test_touch.hpp"
#include "palpable/haptics/tick/tick.hpp"

#include <algorithm>
#include <memory>

#include <gtest/gtest.h>

namespace palpable::haptics {
namespace {

/// Pushes along x wherever x < 0: weakly on the way in and strongly on the way out, so it generates energy.
class Generator final : public Touchable {
 public:
  static constexpr double kWeak_N = 0.2;
  static constexpr double kStrong_N = 1.16;

  LawOutput evaluate(const Hand& hand, TouchState& /*state*/) const noexcept override {
    LawOutput output;
    output.contact = hand.position.v.x < 0.0;
    if (!output.contact) return output;
    output.force_N.v = {hand.velocity_m_per_s.v.x < 0.0 ? kWeak_N : kStrong_N, 0.0, 0.0};
    return output;
  }
  std::uint64_t state_family() const noexcept override { return 1; }
  double damping_Ns_per_m() const noexcept override { return 0.0; }
  void touch_pages() const noexcept override {}
};

TEST(PassivityController, TakesAForceAwayNoFasterThanItMayGrow) {
  ScriptedDevice device;
  const HapticScene scene{std::make_shared<const Generator>(), {}, 0};
  TickOptions options;
  options.passivity = Passivity::control;
  Ring<TouchEvent> events(1024);
  TickPipeline tick(device, scene, options, events);
  const double most_step_N = options.max_force_rate_N_per_s * kT_s;
  double x_m = 0.001;
  double before_N = 0.0;
  double largest_fall_N = 0.0;
  double most_N = 0.0;
  double least_on_the_way_out_N = 1.0;
  for (int n = 0; n < 200; ++n) {
    x_m += n < 100 ? -5e-5 : 4e-5;
    device.reading.position.v.x = x_m;
    const TouchSample& sample = tick.step(kT_s * n, kT_s);
    while (events.take()) {
    }
    const double written_N = norm(sample.written_force_N);
    if (sample.has(flag::kContact)) largest_fall_N = std::max(largest_fall_N, before_N - written_N);
    most_N = std::max(most_N, written_N);
    if (n > 110 && sample.has(flag::kContact))
      least_on_the_way_out_N = std::min(least_on_the_way_out_N, written_N);
    before_N = written_N;
  }
  EXPECT_GT(tick.counts().passivity_ticks, 3U);
  EXPECT_GT(most_N, 1.0);
  EXPECT_LE(largest_fall_N, most_step_N * (1.0 + 1e-9));
  EXPECT_LT(least_on_the_way_out_N, 0.01) << "the controller acts";
}

}  // namespace
}  // namespace palpable::haptics
