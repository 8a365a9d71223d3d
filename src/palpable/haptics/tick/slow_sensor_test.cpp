// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// Sensors that give new readings more slowly than the loop asks for them.
#include "palpable/haptics/law/test_period.hpp"
#include "palpable/haptics/law/test_scenes.hpp"
#include "palpable/haptics/tick/energy_touch.hpp"
#include "palpable/haptics/tick/reading_rate.hpp"

#include <algorithm>
#include <cmath>
#include <deque>
#include <memory>
#include <utility>

#include <gtest/gtest.h>

namespace palpable::haptics {
namespace {

/// A hand whose sensor is read in each n-th tick only.
class SlowSensor final : public device::Device {
 public:
  SlowSensor(const device::HandOptions& options, int ticks) : hand_(options), ticks_(ticks) {}
  const device::Traits& traits() const noexcept override { return hand_.traits(); }
  device::Reading read() noexcept override {
    if (n_++ % ticks_ == 0) reading_ = hand_.read();
    return reading_;
  }
  void write(Vector<DeviceFrame> force_N) noexcept override { hand_.write(force_N); }
  void stop() noexcept override { hand_.stop(); }
  CountedHand& hand() { return hand_; }

 private:
  CountedHand hand_;
  int ticks_;
  int n_ = 0;
  device::Reading reading_;
};

/// By the numbers of a recording alone: the force that acted times the movement that was read, summed while a
/// force acts.
class RecordedSum {
 public:
  explicit RecordedSum(int delay) : sent_N_(static_cast<std::size_t>(delay) + 1) {}
  void take(Vec3 place_m, Vec3 written_N) {
    const Vec3 held_N = sent_N_.front();
    sent_N_.pop_front();
    sent_N_.push_back(written_N);
    sum_J_ = held_N == Vec3{} || !knows_ ? 0.0 : sum_J_ + dot(held_N, place_m - place_m_);
    place_m_ = place_m;
    knows_ = true;
    most_J_ = std::max(most_J_, sum_J_);
  }
  double most_J() const { return most_J_; }

 private:
  std::deque<Vec3> sent_N_;
  Vec3 place_m_;
  bool knows_ = false;
  double sum_J_ = 0.0;
  double most_J_ = 0.0;
};

struct Made {
  double recorded_J = 0.0;
  double said_J = 0.0;
  /// What the sensor's steps leave unknown.
  double unsure_J = 0.0;
  double written_Ns = 0.0;
  double law_Ns = 0.0;
};

Made touched(const device::HandOptions& options, int sensor_ticks,
             std::shared_ptr<const Touchable> touchable) {
  SlowSensor device(options, sensor_ticks);
  HapticScene scene;
  scene.touchable = std::move(touchable);
  TickOptions observed;
  observed.passivity = Passivity::observe;
  Ring<TouchEvent> events(1024);
  TickPipeline tick(device, scene, observed, events);
  RecordedSum recorded(options.delay_samples);
  Made made;
  for (int n = 0; n < 1500; ++n) {
    const TouchSample& sample = tick.step(kT_s * n, kT_s);
    recorded.take(sample.device_position.v, sample.written_force_N.v);
    made.written_Ns += kT_s * norm(sample.written_force_N);
    made.law_Ns += kT_s * norm(sample.raw_force_N);
    while (events.take()) {
    }
  }
  made.recorded_J = recorded.most_J();
  made.said_J = tick.counts().made_max_without_controller_J;
  made.unsure_J = options.resolution_m * tick.counts().max_force_N;
  return made;
}

models::Scene hills() {
  Raster<float> z(200, 160);
  for (int y = 0; y < z.height(); ++y)
    for (int x = 0; x < z.width(); ++x)
      z(x, y) = static_cast<float>(0.002 * (1.0 + std::sin(0.09 * x) * std::cos(0.07 * y)));
  return scene_of(std::move(z), 0.0002);
}

class SlowSensors : public testing::TestWithParam<int> {};

/// Hands to 1 m/s with sensors of 1 to 50 um, in the mean of which the limits leave so much of the force.
constexpr double kLeastKept[]{0.97, 0.8, 0.7, 0.0, 0.5};

TEST_P(SlowSensors, KeepTheForceAndAreReportedInFull) {
  Hands hands(91);
  double written_Ns = 0.0, law_Ns = 0.0;
  for (unsigned seed = 0; seed < 14; ++seed) {
    device::HandOptions options = loose_hand(hands, seed, 1.0);
    options.resolution_m = hands.uniform(1e-6, 5e-5);
    const CountedHand hand(options);
    const SafeContact safe = safe_contact(hand.traits(), options.rate_hz, 1.0, 1e5, 0.5);
    LawParameters law;
    law.stiffness_N_per_m = safe.stiffness_N_per_m;
    law.damping_Ns_per_m = safe.damping_Ns_per_m;
    law.static_friction = seed % 2 == 0 ? 0.0 : 0.3;
    const Made touch = touched(options, GetParam(), made(hills(), law));
    EXPECT_LE(touch.recorded_J, touch.said_J + touch.unsure_J + 1e-6) << "hand " << seed;
    written_Ns += touch.written_Ns;
    law_Ns += touch.law_Ns;
  }
  EXPECT_GE(written_Ns, kLeastKept[GetParam() - 1] * law_Ns) << written_Ns / law_Ns;
}

INSTANTIATE_TEST_SUITE_P(Ticks, SlowSensors, testing::Values(1, 2, 3, 5));

TEST(SimulatedHand, GivesANewPositionInEachPeriodOfItsSensor) {
  for (const double period_s : {0.0, 0.001, 0.0025, 0.004}) {
    device::HandOptions options;
    options.resolution_m = 0.0;
    options.sensor_period_s = period_s;
    device::SimulatedHand hand(options);
    hand.place({});
    Vec3 before;
    int fresh = 0;
    for (int n = 0; n < 400; ++n) {
      hand.write({{1.0, 0.0, 0.0}});
      const device::Reading reading = hand.read();
      EXPECT_EQ(reading.is_repeated, reading.position.v == before) << n;
      if (period_s <= kT_s) {
        EXPECT_EQ(reading.position.v, hand.true_position_m());
      }
      fresh += reading.is_repeated ? 0 : 1;
      before = reading.position.v;
    }
    EXPECT_EQ(fresh, static_cast<int>(std::lround(400 * kT_s / std::max(period_s, kT_s)))) << period_s;
  }
}

/// How many ticks apart the readings of a hand are taken to be that moves by so much in each n-th tick.
int found_ticks(double resolution_m, int n, double moves_m, int ticks = 40) {
  device::Traits device;
  device.position_resolution_m = resolution_m;
  ReadingRate rate(device);
  Point<DeviceFrame> place;
  for (int k = 0; k < ticks; ++k) {
    if (k % n == 0) place.v.x += moves_m;
    rate.repeats(place);
  }
  return rate.ticks();
}

TEST(ReadingRate, IsThatOfAFastHandAndNotOfASlowHandsSteps) {
  EXPECT_EQ(found_ticks(1e-5, 5, 1e-3), 5);
  EXPECT_EQ(found_ticks(1e-5, 2, 1e-3), 2);
  EXPECT_EQ(found_ticks(1e-5, 1, 1e-3), 1);
  EXPECT_EQ(found_ticks(1e-5, 5, 1e-5), 1) << "one step at a time";
  EXPECT_EQ(found_ticks(1e-5, 20, 1e-3, 200), 1) << "a hand that moves now and then";
  EXPECT_EQ(found_ticks(1e-5, 5, 1e-3, 15), 1) << "not yet";
}

}  // namespace
}  // namespace palpable::haptics
