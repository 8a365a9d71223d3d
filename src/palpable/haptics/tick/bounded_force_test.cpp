// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// What is written is bounded whatever a clock, a recording, a sensor and a law give: values that are not
// finite, negative, subnormal or huge, at random, mixed with good ones.
#include "palpable/haptics/servo/test_touch.hpp"
#include "palpable/haptics/tick/tick.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <string>

#include <gtest/gtest.h>

namespace palpable::haptics {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();
constexpr double kNoNumber = std::numeric_limits<double>::quiet_NaN();
constexpr double kSubnormal = std::numeric_limits<double>::denorm_min();

/// Values that break sums, comparisons, squares and quotients.
class WildNumbers {
 public:
  explicit WildNumbers(unsigned seed) : random_(seed) {}

  bool one_of(unsigned n) { return random_() % n == 0; }
  double within(double size) { return std::uniform_real_distribution<double>(-size, size)(random_); }
  double wild() {
    constexpr std::array kValues{kNoNumber, kInfinite, 0.0,   -0.0,   kSubnormal, 1e-300, 1e-12,
                                 1e-4,      1.0,       1e3,   1e6,    1e12,       1e150,  1e200,
                                 1e300,     1.7e308,   0.001, 0.0999, 0.006,      3600.0};
    const double value = kValues[random_() % kValues.size()];
    return one_of(2) ? -value : value;
  }
  /// Mostly `good`.
  double mixed(double good) { return one_of(4) ? wild() : good; }
  Vec3 mixed(Vec3 good) { return {mixed(good.x), mixed(good.y), mixed(good.z)}; }

 private:
  std::mt19937 random_;
};

/// A spring and damper that returns wild values now and then.
class WildLaw final : public Touchable {
 public:
  WildLaw(WildNumbers& numbers, EnergyModel model) : numbers_(numbers), model_(model) {}
  LawOutput evaluate(const Hand& hand, TouchState&) const noexcept override {
    const double depth_m = -hand.position.v.z;
    LawOutput output;
    output.stored_J = 0.0;
    if (depth_m > 0.0) {
      output.contact = true;
      output.spring_N.v.z = 500.0 * depth_m;
      output.stored_J = 250.0 * depth_m * depth_m;
      output.force_N.v.z = output.spring_N.v.z - hand.velocity_m_per_s.v.z;
      output.torque_Nm.v.x = 0.1 * output.force_N.v.z;
    }
    if (!numbers_.one_of(3)) return output;
    output.force_N.v = numbers_.mixed(output.force_N.v);
    output.spring_N.v = numbers_.mixed(output.spring_N.v);
    output.torque_Nm.v = numbers_.mixed(output.torque_Nm.v);
    output.spring_torque_Nm.v = numbers_.mixed(Vec3{});
    output.guide_N.v = numbers_.mixed(Vec3{});
    output.proxy.v = numbers_.mixed(output.proxy.v);
    output.stored_J = numbers_.mixed(output.stored_J);
    return output;
  }
  std::uint64_t state_family() const noexcept override { return 3; }
  double damping_Ns_per_m() const noexcept override { return numbers_.mixed(1.0); }
  EnergyModel energy_model() const noexcept override { return model_; }
  void touch_pages() const noexcept override {}

 private:
  WildNumbers& numbers_;
  EnergyModel model_;
};

/// Wild readings, also with times of their own as a recording's.
class WildDevice final : public device::Device {
 public:
  WildDevice(WildNumbers& numbers, bool has_torque) : numbers_(numbers) {
    traits_.max_force_N = 3.3;
    traits_.has_torque = has_torque;
    traits_.max_torque_Nm = 0.05;
    traits_.position_resolution_m = 1e-5;
    traits_.mass_kg = 0.1;
    traits_.delay_samples = 1;
  }
  const device::Traits& traits() const noexcept override { return traits_; }
  device::Reading read() noexcept override {
    device::Reading reading;
    z_m_ = std::clamp(z_m_ + numbers_.within(0.0015), -0.02, 0.01);
    reading.position.v = {0.0, 0.0, z_m_};
    if (numbers_.one_of(20)) reading.position.v = numbers_.mixed(reading.position.v);
    if (numbers_.one_of(50)) reading.rotation[4] = numbers_.wild();
    if (numbers_.one_of(50)) reading.status = device::Status::stale;
    if (is_replay)
      reading.recorded = device::RecordedTime{
          numbers_.mixed(0.5), numbers_.mixed(0.001),
          numbers_.one_of(30) ? flag::kStalled : (numbers_.one_of(40) ? flag::kPaused : 0U)};
    return reading;
  }
  void write_torque(Vector<DeviceFrame> torque_Nm) noexcept override { torque_Nm_ = torque_Nm; }
  void write(Vector<DeviceFrame> force_N) noexcept override { force_N_ = force_N; }
  void stop() noexcept override {}

  bool is_replay = false;
  Vector<DeviceFrame> force_N() const { return force_N_; }
  Vector<DeviceFrame> torque_Nm() const { return torque_Nm_; }

 private:
  WildNumbers& numbers_;
  device::Traits traits_;
  double z_m_ = 0.005;
  Vector<DeviceFrame> force_N_;
  Vector<DeviceFrame> torque_Nm_;
};

struct WildCase {
  const char* name;
  EnergyModel model;
  bool is_replay;
  bool has_torque;
};

class BoundedForce : public testing::TestWithParam<WildCase> {};

TEST_P(BoundedForce, IsFiniteWithinTheCapAndRisesWithinTheLimitWhateverComesIn) {
  constexpr int kTicks = 40'000;
  WildNumbers numbers(11);
  WildDevice device(numbers, GetParam().has_torque);
  device.is_replay = GetParam().is_replay;
  HapticScene scenes[2];
  for (HapticScene& scene : scenes) scene.touchable = std::make_shared<WildLaw>(numbers, GetParam().model);
  scenes[1].transient = transient_of(TransientKind::wood);
  const TickOptions options;
  Ring<TouchEvent> events(64);
  TickPipeline tick(device, scenes[0], options, events);
  const double rise_N = options.max_force_rate_N_per_s * options.max_rise_time_s;
  const double rise_Nm = options.max_torque_rate_Nm_per_s * options.max_rise_time_s;
  double most_N = 0.0;
  int pushed = 0;
  for (int n = 0; n < kTicks; ++n) {
    if (numbers.one_of(200) && !tick.fading()) tick.change(scenes[n % 2]);
    if (numbers.one_of(300)) tick.note_cut_force();
    const Vector<DeviceFrame> before_N = device.force_N(), before_Nm = device.torque_Nm();
    const TouchSample& sample = tick.step(numbers.mixed(0.001 * n), numbers.mixed(0.001));
    const Vector<DeviceFrame> written_N = device.force_N(), written_Nm = device.torque_Nm();
    ASSERT_TRUE(is_finite(written_N) && is_finite(written_Nm)) << n;
    ASSERT_LE(norm(written_N), 3.3 * (1.0 + 1e-6)) << n;
    ASSERT_LE(norm(written_Nm), 0.05 * (1.0 + 1e-6)) << n;
    ASSERT_FALSE(cap_rise(written_N, before_N, rise_N * (1.0 + 1e-6)).limited) << n;
    ASSERT_FALSE(cap_rise(written_Nm, before_Nm, rise_Nm * (1.0 + 1e-6)).limited) << n;
    ASSERT_TRUE(std::isfinite(sample.t_s) && std::isfinite(sample.dt_s) && sample.dt_s > 0.0) << n;
    ASSERT_FALSE(std::isnan(sample.energy_J)) << n;
    most_N = std::max(most_N, norm(written_N));
    pushed += norm(written_N) > 0.1 ? 1 : 0;
    while (events.take()) {
    }
    tick.take_retired();
  }
  EXPECT_GT(pushed, kTicks / 100) << "the touch goes on between the wild values";
  EXPECT_GT(most_N, 0.5);
}

INSTANTIATE_TEST_SUITE_P(Cases, BoundedForce,
                         testing::Values(WildCase{"spring", EnergyModel::spring, false, false},
                                         WildCase{"weight", EnergyModel::weight, false, false},
                                         WildCase{"none", EnergyModel::none, false, false},
                                         WildCase{"guided", EnergyModel::self_limited, false, false},
                                         WildCase{"replayed_spring", EnergyModel::spring, true, false},
                                         WildCase{"replayed_none", EnergyModel::none, true, false},
                                         WildCase{"torque", EnergyModel::spring, false, true},
                                         WildCase{"replayed_torque", EnergyModel::spring, true, true}),
                         [](const auto& one) { return std::string(one.param.name); });

/// A hand 20 mm inside a wall of 500 N/m, on a device of 3 N.
double most_N_at(double dt_s) {
  ScriptedDevice device;
  HapticScene scene;
  scene.touchable = std::make_shared<SpringSurface>(flat, 500.0, 0.5);
  Ring<TouchEvent> events(64);
  TickPipeline tick(device, scene, {}, events);
  device.reading.position.v = {0.0, 0.0, -0.02};
  for (int n = 0; n < 1100; ++n) tick.step(0.001 * n, 0.001);
  device.written.clear();
  for (int n = 0; n < 100; ++n) tick.step(1.1, dt_s);
  double most_N = 0.0;
  for (const Vec3& force : device.written) most_N = std::max(most_N, norm(force));
  return most_N;
}

TEST(BoundedForce, AStepThatIsNoTimeBeginsFromNoForce) {
  for (const double dt_s : {kNoNumber, kInfinite, -kInfinite, -0.1, -1e300, 1e300, 0.0, kSubnormal, 1e-9})
    EXPECT_LE(most_N_at(dt_s), 0.31) << dt_s;
  EXPECT_NEAR(most_N_at(0.001), 3.0, 1e-6);
}

TEST(BoundedForce, IsNoneForABoundThatIsNone) {
  using Force = Vector<DeviceFrame>;
  const Force force{{3.0, 0.0, 4.0}};
  EXPECT_NEAR(norm(bounded(force, 2.0)), 2.0, 1e-12);
  EXPECT_EQ(bounded(force, 6.0), force);
  for (const double most_N : {0.0, -1.0, kNoNumber}) EXPECT_EQ(bounded(force, most_N), Force{}) << most_N;
  for (const double wild : {kNoNumber, kInfinite, -kInfinite})
    EXPECT_EQ(bounded(Force{{0.1, wild, 0.0}}, 2.0), Force{}) << wild;
  EXPECT_LE(norm(bounded(Force{{1e300, -1e300, 1e300}}, 2.0)), 2.0);
}

}  // namespace
}  // namespace palpable::haptics
