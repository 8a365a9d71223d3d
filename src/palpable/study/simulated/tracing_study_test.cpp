// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/study/simulated/tracing_study.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace palpable::study {
namespace {

TracerParameters exact() {
  TracerParameters p;
  p.motor_noise = 0.0;
  p.visual_noise_m = 0.0;
  return p;
}

std::shared_ptr<const LineByLength> outline_of(const TracingFigure& figure) {
  return std::make_shared<const LineByLength>(figure.nominal, figure.ends);
}

/// The time of a hand that follows the target exactly.
double seconds_of(SimulatedTracer& tracer, Vec3 begin) {
  Vec3 hand = begin;
  double t = 0.0;
  for (; t < 120.0 && !tracer.finished(); t += 0.001) hand = tracer.step(hand, 0.001);
  return t;
}

TEST(SimulatedTracer, MovesAtItsSpeedAlongAStraightLine) {
  const auto line = outline_of(line_figure(0));
  SimulatedTracer tracer(line, exact(), 1);
  EXPECT_NEAR(seconds_of(tracer, line->point(0.0)), 6.0, 0.7) << "60 mm at 10 mm/s";
}

TEST(SimulatedTracer, HasAnErrorProportionalToItsSpeed) {
  // The trade-off of speed and accuracy is not modelled: it follows from the signal-dependent noise.
  const auto line = outline_of(line_figure(0));
  const auto error = [&](double speed) {
    double squares = 0.0;
    int n = 0;
    for (std::uint64_t seed = 0; seed < 8; ++seed) {
      TracerParameters p;
      p.speed_m_per_s = speed;
      p.visual_noise_m = 0.0;
      SimulatedTracer tracer(line, p, seed);
      Vec3 hand = line->point(0.0);
      for (int k = 0; k < 100000 && !tracer.finished(); ++k, ++n) {
        hand = tracer.step(hand, 0.001);
        squares += hand.y * hand.y;
      }
    }
    return std::sqrt(squares / n);
  };
  EXPECT_NEAR(error(0.02) / error(0.01), 2.0, 0.5);
}

TEST(SimulatedTracer, ReachesCornersInsteadOfCuttingThem) {
  const auto line = outline_of(rectangle_figure());
  SimulatedTracer tracer(line, exact(), 1);
  Vec3 hand = line->point(0.0);
  double nearest = 1.0;
  for (int k = 0; k < 60000 && !tracer.finished(); ++k) {
    hand = tracer.step(hand, 0.001);
    nearest = std::min(nearest, norm(hand - Vec3{0.04, 0.025, 0}));
  }
  EXPECT_TRUE(tracer.finished());
  EXPECT_LT(nearest, 0.001);
}

class OnTheScan : public ::testing::Test {
 protected:
  static const TracedFigure& scan() {
    static const auto figure = prepare_figure(ultrasound_figure(1), 6.0, Work{});
    EXPECT_TRUE(figure);
    return *figure;
  }
};

TEST_F(OnTheScan, TracesAreTheSameForTheSameSeed) {
  const auto a = trace_once(scan(), {}, Assistance::tracing, Direction::as_drawn, 3);
  const auto b = trace_once(scan(), {}, Assistance::tracing, Direction::as_drawn, 3);
  EXPECT_EQ(a.seconds, b.seconds);
  EXPECT_EQ(a.error, b.error);
  EXPECT_TRUE(a.finished);
}

TEST_F(OnTheScan, AssistanceKeepsItsEnergyTankAndSpeedCapAndComesToRest) {
  TracingStudyOptions options;
  options.tracers = 2;
  options.repeats = 1;
  const auto with = study_tracing(scan(), options, Assistance::tracing, Work{});
  ASSERT_TRUE(with);
  EXPECT_EQ(with->traces, 4);
  EXPECT_EQ(with->unfinished, 0);
  EXPECT_GE(with->tank_least_J, 0.0);
  EXPECT_LE(with->fastest_pushed_m_per_s, haptics::TracingLaw::kSpeedCap_m_per_s);
  EXPECT_EQ(with->restless, 0);
  EXPECT_LE(with->resting_N, 0.001);
  EXPECT_GT(with->fastest_pushed_m_per_s, 0.0) << "it did push";
}

TEST_F(OnTheScan, ALawWithoutForceAndDampingChangesNothing) {
  TracingStudyOptions options;
  options.law.force_N = 0.0;
  options.law.damping_Ns_per_m = 0.0;
  const auto without = trace_once(scan(), options, Assistance::none, Direction::backwards, 5);
  const auto with = trace_once(scan(), options, Assistance::tracing, Direction::backwards, 5);
  EXPECT_EQ(without.seconds, with.seconds);
  EXPECT_EQ(without.error, with.error);
}

}  // namespace
}  // namespace palpable::study
