// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/haptics/tick/shown_work.hpp"

#include <algorithm>
#include <limits>
#include <random>

#include <gtest/gtest.h>

namespace palpable::haptics {
namespace {

ShownWork::Tick at(double z_m, double force_N, std::uint32_t flags = flag::kContact) {
  ShownWork::Tick tick;
  tick.position.v.z = z_m;
  tick.written_N.v.z = force_N;
  tick.flags = flags;
  tick.is_valid = (flags & flag::kNoReading) == 0;
  return tick;
}

device::Traits without_delay() {
  device::Traits traits;
  traits.position_resolution_m = 0.0;
  return traits;
}

/// A press of 1 mm against 1 N, which takes 1 mJ from the hand, and a way out against `out_N`.
ShownWork pressed(double out_N, double last_dt_s, std::uint32_t last_flags) {
  ShownWork work(without_delay(), {});
  work.take(at(0.001, 0.0, 0));
  work.take(at(0.0, 1.0));
  work.take(at(-0.001, out_N));
  ShownWork::Tick out = at(0.001, 0.0, last_flags);
  out.dt_s = last_dt_s;
  work.take(out);
  return work;
}

TEST(ShownWork, IsWhatTheHandReceivedBeyondWhatItGave) {
  EXPECT_NEAR(pressed(2.0, 0.001, 0).made_max_J(), 3e-3, 1e-12);
  EXPECT_EQ(pressed(0.5, 0.001, 0).made_max_J(), 0.0);
  EXPECT_NEAR(pressed(2.0, 0.001, 0).since_zero_max_J(), 3e-3, 1e-12);
}

TEST(ShownWork, GoesOnThroughATickInContactWhoseForceADamperCancelled) {
  // The hand gives 1 mJ, and gets back 0.9 mJ after a tick without force.
  const auto received_J = [](bool has_spring) {
    ShownWork work(without_delay(), {});
    const double forces_N[]{0.0, 1.0, 0.0, 0.9, 0.0};
    const double places_m[]{0.001, 0.0, -0.001, -0.001, 0.0};
    for (int n = 0; n < 5; ++n) {
      ShownWork::Tick tick = at(places_m[n], forces_N[n], n > 0 ? flag::kContact : 0U);
      tick.has_spring = has_spring;
      work.take(tick);
    }
    EXPECT_LE(work.made_max_J(), work.since_zero_max_J());
    return work.made_max_J();
  };
  EXPECT_EQ(received_J(true), 0.0);
  EXPECT_NEAR(received_J(false), 0.9e-3, 1e-12) << "a law that stores nothing made it";
}

TEST(ShownWork, CountsAJumpAfterWhichANewTouchBegins) {
  // 1 mm against 1 N, and a jump of 3 mm with it, of which two readings were not believed.
  ShownWork work(without_delay(), {});
  work.take(at(0.001, 0.0, 0));
  work.take(at(0.0, 1.0));
  work.take(at(-0.001, 1.0));
  work.take(at(0.002, 1.0, flag::kContact | flag::kImplausible));
  work.take(at(0.002, 0.0, flag::kContact | flag::kNewTouch));
  EXPECT_NEAR(work.made_max_J(), 2e-3, 1e-12);
  EXPECT_NEAR(work.since_zero_max_J(), 2e-3, 1e-12);
}

TEST(ShownWork, ItsSumCountsWhatAHandReceivesWhileASceneFadesIn) {
  ShownWork work(without_delay(), {});
  work.take(at(0.001, 0.0, 0));
  work.take(at(0.0, 1.0));
  work.take(at(0.002, 1.0, flag::kContact | flag::kFading));
  work.take(at(0.003, 1.0));
  EXPECT_NEAR(work.since_zero_max_J(), 3e-3, 1e-12);
  EXPECT_EQ(work.made_max_J(), 0.0) << "what a change brings is not the law's";
}

TEST(ShownWork, ItsSumGoesOnInAContactOfALawWithoutASpringThatGivesNoForceForATick) {
  ShownWork work(without_delay(), {});
  work.take(at(0.0, 0.0, 0));
  work.take(at(0.0, 1.0));
  work.take(at(0.002, 0.0));
  work.take(at(0.003, 1.0));
  work.take(at(0.004, 1.0));
  EXPECT_NEAR(work.since_zero_max_J(), 3e-3, 1e-12);
}

TEST(ShownWork, CountsAMovementInAStallUntilTheWatchdogEndsTheForce) {
  // 2 N over 5 of 50 ms of 2 mm are less than the hand gave.
  EXPECT_EQ(pressed(2.0, 0.05, flag::kStalled).made_max_J(), 0.0);
  EXPECT_NEAR(pressed(20.0, 0.05, flag::kStalled).made_max_J(), 3e-3, 1e-12);
  EXPECT_NEAR(pressed(2.0, 0.05, flag::kStalled).since_zero_max_J(), 3e-3, 1e-12) << "the plain sum";
}

TEST(ShownWork, IsNeverAboveTheSumSinceTheForceWasZero) {
  std::mt19937 random(5);
  const auto uniform = [&](double least, double most) {
    return std::uniform_real_distribution<double>(least, most)(random);
  };
  const std::uint32_t kinds[]{flag::kContact,
                              flag::kContact | flag::kPassivityActed,
                              flag::kContact | flag::kStalled,
                              flag::kContact | flag::kRamping,
                              0U,
                              flag::kNewTouch,
                              flag::kFading};
  double most_J = 0.0;
  for (int hand = 0; hand < 200; ++hand) {
    device::Traits device = without_delay();
    device.delay_samples = hand % 3;
    ShownWork work(device, {});
    double z_m = 0.0;
    for (int n = 0; n < 100; ++n) {
      const std::uint32_t flags = kinds[std::min<std::size_t>(random() % 20U, 6U)];
      ShownWork::Tick tick =
          at(z_m += uniform(-1e-3, 1e-3), random() % 3U == 0 ? 0.0 : uniform(-1.0, 2.0), flags);
      tick.has_spring = hand % 2 == 0;
      tick.dt_s = (flags & flag::kStalled) != 0 ? uniform(0.001, 0.05) : 0.001;
      work.take(tick);
      ASSERT_LE(work.made_max_J(), work.since_zero_max_J() * (1.0 + 1e-12))
          << "hand " << hand << ", tick " << n;
    }
    most_J = std::max(most_J, work.made_max_J());
  }
  EXPECT_GT(most_J, 1e-3);
}

TEST(ShownWork, KnowsNothingOfLawsThatAreNoContactAndOfReadingsThatAreNone) {
  ShownWork work(without_delay(), {});
  ShownWork::Tick tick = at(0.001, 1.0);
  tick.is_contact_law = false;
  for (int n = 0; n < 10; ++n) {
    tick.position.v.z += 0.001;
    work.take(tick);
  }
  EXPECT_FALSE(work.counts());
  EXPECT_EQ(work.made_max_J(), 0.0);
  ShownWork lost(without_delay(), {});
  lost.take(at(0.001, 0.0, 0));
  lost.take(at(0.0, 1.0));
  lost.take(at(std::numeric_limits<double>::quiet_NaN(), 1.0));
  lost.take(at(-0.001, 0.0));
  EXPECT_EQ(lost.made_max_J(), 0.0);
}

TEST(ShownWork, CountsTheJumpOfAHandUnderALawThatIsNoContact) {
  ShownWork work(without_delay(), {});
  ShownWork::Tick tick = at(0.001, 1.0);
  tick.is_contact_law = false;
  for (int n = 0; n < 10; ++n) work.take(tick);
  tick = at(0.021, 0.0, flag::kNewTouch);
  tick.is_contact_law = false;
  work.take(tick);
  EXPECT_NEAR(work.made_max_J(), 0.020, 1e-12);
}

TEST(ShownWork, ChargesAForceThatActsLateToTheMovementThatItMoves) {
  device::Traits late = without_delay();
  late.delay_samples = 1;
  ShownWork work(late, {});
  work.take(at(0.0, 0.0, 0));
  work.take(at(-0.001, 3.0));
  // The motors still hold nothing.
  work.take(at(0.002, 0.0));
  EXPECT_EQ(work.made_max_J(), 0.0);
  work.take(at(0.003, 0.0));
  EXPECT_NEAR(work.made_max_J(), 3e-3, 1e-12);
}

}  // namespace
}  // namespace palpable::haptics
