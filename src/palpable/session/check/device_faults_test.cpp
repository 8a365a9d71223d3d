// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// Faults at random instants of a touch, each kind of each driver separately, with the driver's own virtual
// device below it and the tick above it.
#include "palpable/haptics/servo/servo_options.hpp"
#include "palpable/haptics/servo/start_touch.hpp"
#include "palpable/haptics/tick/tick.hpp"
#include "palpable/session/check/driver_bench.hpp"
#include "palpable/session/touch/haptic_scene.hpp"
#include "palpable/session/touch/test_session.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cstdlib>
#include <iostream>
#include <memory>
#include <optional>
#include <random>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace palpable::session {
namespace {

using SteadyClock = std::chrono::steady_clock;

/// What holds while a fault lasts.
enum class During : std::uint8_t {
  /// The motors are free within 10 ms.
  free,
  /// Nothing reaches the motors; what comes first afterwards frees them.
  cut_off,
  /// The device is gone; it is opened again.
  gone,
  /// The driver cannot know of it, or copes with it: the force stays within its limits.
  limited
};

struct FaultCase {
  const char* driver;
  DriverBench (*bench)(const OnForce&);
  double step_N;
  double press_m;
  /// So many instants in an everyday run.
  int instants;
  DriverFault fault;
  const char* name;
  During during;
};

constexpr double kTick_s = 0.001;
constexpr int kFreeWithin = 10;
/// Longer than the ramp down.
constexpr int kStays = 20;
constexpr int kOnTheWay = 5;

/// What has reached the virtual device. By its thread and that of the test.
class Wire {
 public:
  void set_cap(double cap_N) { cap_N_ = cap_N; }
  void receive(Vec3 force_N) {
    if (const bool pushes = force_N != Vec3{}; pushes_.exchange(pushes) && !pushes)
      freed_at_ = SteadyClock::now();
    if (!is_finite(force_N)) ++not_finite_;
    if (norm(force_N) > cap_N_) ++above_cap_;
  }
  /// When a force was last followed by none.
  SteadyClock::time_point freed_at() const { return freed_at_; }
  int not_finite() const { return not_finite_; }
  int above_cap() const { return above_cap_; }

 private:
  std::atomic<bool> pushes_{false};
  std::atomic<SteadyClock::time_point> freed_at_{};
  std::atomic<double> cap_N_{0.0};
  std::atomic<int> not_finite_{0};
  std::atomic<int> above_cap_{0};
};

/// One touch of hills by a driver.
class FaultyTouch {
 public:
  FaultyTouch(const DriverBench& bench, std::unique_ptr<device::Device> device, double press_m)
      : bench_(bench), device_(std::move(device)) {
    const device::Traits& traits = device_->traits();
    const models::Scene scene = hilly_scene(0.004);
    const auto place = haptics::fit_workspace(scene, traits);
    KeptSurfaces kept;
    auto prepared = prepare_scene(scene, TouchSettings{}, traits, 1.0 / kTick_s, place, kept);
    EXPECT_TRUE(prepared);
    scene_ = std::move(prepared->scene);
    tick_.emplace(*device_, scene_, haptics::tick_options(haptics::ServoOptions{}), events_);
    const double top_m = (place.inverse() * Point<SceneFrame>{{0.0, 0.0, 0.004}}).v.z;
    constexpr double kAbove_m = 0.006;
    deep_ = press_m > 0.0;
    above_m_ = deep_ ? top_m + kAbove_m : 0.0;
    below_m_ = deep_ ? top_m - press_m : 0.0;
  }
  device::Status ticks(int count) {
    for (int k = 0; k < count; ++k) {
      t_s_ += kTick_s;
      const haptics::TouchSample& sample = tick_->step(t_s_, kTick_s);
      status_ = sample.status;
      z_m_ = sample.device_position.v.z;
      const bool is_good = status_ == device::Status::ok;
      was_in_air_ = was_in_air_ || (is_good && !sample.has(haptics::flag::kContact));
      has_ramped_ = has_ramped_ || (is_good && sample.has(haptics::flag::kRamping));
      bench_.pass_tick();
      while (const auto event = events_.take()) {
        told_faults_ += event->kind == haptics::TouchEvent::Kind::fault ? 1 : 0;
        told_recoveries_ += event->kind == haptics::TouchEvent::Kind::recovered ? 1 : 0;
      }
    }
    return status_;
  }
  /// Lifts the hand, which may have sunk in without a force, and presses until the device pushes; false if it
  /// does not.
  bool presses() {
    // On a busy machine a virtual device of real time may be silent for so long that the touch begins anew,
    // below the surface.
    constexpr int kTimes = 10;
    for (int k = 0; k < kTimes; ++k) {
      lift();
      bench_.pull_to({0.0, 0.0, below_m_});
      if (pushes()) return true;
    }
    return false;
  }
  bool pushes() {
    constexpr int kLongest = 1000;
    constexpr double kPushes_N = 0.02;
    for (int k = 0; k < kLongest && norm(bench_.motors_N()) < kPushes_N; ++k) ticks(1);
    return norm(bench_.motors_N()) >= kPushes_N;
  }
  device::Device& device() { return *device_; }
  /// The force rose by the ramp since the last call of begin_ramp(), or the hand was in free air, where the
  /// ramp ends at once.
  bool has_ramped() const { return has_ramped_ || was_in_air_; }
  void begin_ramp() { was_in_air_ = has_ramped_ = false; }
  double cap_N() const { return device_->traits().max_force_N; }
  int told_faults() const { return told_faults_; }
  int told_recoveries() const { return told_recoveries_; }

 private:
  void lift() {
    constexpr int kLift = 80;
    constexpr int kLongestLift = 5000;
    constexpr double kNearly_m = 0.002;
    bench_.pull_to({0.0, 0.0, above_m_});
    for (int k = 0; deep_ && (k < kLift || z_m_ < above_m_ - kNearly_m) && k < kLongestLift; ++k) ticks(1);
  }

  const DriverBench& bench_;
  std::unique_ptr<device::Device> device_;
  haptics::HapticScene scene_;
  Ring<haptics::TouchEvent> events_{1024};
  std::optional<haptics::TickPipeline> tick_;
  double z_m_ = 0.0;
  bool deep_ = true;
  double above_m_ = 0.0;
  double below_m_ = 0.0;
  double t_s_ = 0.0;
  bool was_in_air_ = false;
  bool has_ramped_ = false;
  device::Status status_ = device::Status::not_ready;
  int told_faults_ = 0;
  int told_recoveries_ = 0;
};

class DriverWithAFault : public testing::TestWithParam<FaultCase> {
 protected:
  void open() {
    auto opened = bench_.open();
    ASSERT_TRUE(opened) << opened.error().sentence();
    touch_.emplace(bench_, *std::move(opened), GetParam().press_m);
    wire_.set_cap(touch_->cap_N() + GetParam().step_N);
  }
  static int instants() {
    const char* wanted = std::getenv("PALPABLE_FAULTS");
    return wanted != nullptr ? std::atoi(wanted) : GetParam().instants;
  }
  /// Waits for what is on the way to a device with a thread of its own.
  bool becomes_free() {
    for (const auto until = SteadyClock::now() + std::chrono::seconds(5); SteadyClock::now() < until;
         std::this_thread::sleep_for(std::chrono::microseconds(50)))
      if (bench_.motors_N() == Vec3{}) return true;
    return false;
  }
  /// `sent_s`: when the driver had sent zero; `waited_s`: of it, what ticks took longer than they should.
  void note_free(double after_s, double sent_s, double waited_s) {
    slowest_s_ = std::max(slowest_s_, after_s);
    late_ += after_s > kFreeWithin * kTick_s ? 1 : 0;
    sent_late_ += sent_s > kFreeWithin * kTick_s ? 1 : 0;
    late_itself_ += sent_s - waited_s > kFreeWithin * kTick_s ? 1 : 0;
  }
  void is_free_within_ten_ticks() {
    const auto begun = SteadyClock::now();
    const auto since_begun_s = [begun] {
      return std::chrono::duration<double>(SteadyClock::now() - begun).count();
    };
    int took = 0;
    double sent_s = 0.0, waited_s = 0.0;
    bool has_sent = false;
    for (int k = 1; k <= kFreeWithin || (bench_.is_real_time && !has_sent && k <= 10 * kFreeWithin); ++k) {
      const bool is_good = touch_->ticks(1) == device::Status::ok;
      if (bench_.motors_N() != Vec3{}) took = k;
      if (has_sent) continue;
      const double now_s = since_begun_s();
      waited_s += std::max(0.0, now_s - sent_s - kTick_s);
      sent_s = now_s;
      has_sent = !is_good;
    }
    ASSERT_TRUE(becomes_free()) << norm(bench_.motors_N());
    const double real_s = std::chrono::duration<double>(wire_.freed_at() - begun).count();
    note_free(bench_.is_real_time ? real_s : kTick_s * took, sent_s, waited_s);
    // And stay so. In real time a good answer may come late, and the force with it, before the servo knows.
    constexpr int kLongest = 1000;
    for (int k = 0; bench_.is_real_time && k < kLongest && touch_->ticks(1) == device::Status::ok; ++k) {
    }
    ASSERT_TRUE(becomes_free());
    for (int k = 0; k < kStays; ++k) {
      // A good answer may still have been on its way.
      const device::Status status = touch_->ticks(1);
      ASSERT_TRUE(k < kOnTheWay || status != device::Status::ok) << k;
      ASSERT_EQ(bench_.motors_N(), Vec3{}) << k;
    }
    ASSERT_FALSE(touch_->device().fault().empty());
  }
  void is_cut_off() {
    ASSERT_NE(touch_->ticks(40), device::Status::ok);
    ASSERT_FALSE(touch_->device().fault().empty());
    touch_->begin_ramp();
    bench_.inject(DriverFault::none);
    // What was on the way when the line was cut comes first, once the virtual device gets the processor.
    constexpr std::uint64_t kSoon = 50;
    constexpr int kLongest = 2000;
    const std::uint64_t before = bench_.taken ? bench_.taken() : 0;
    const auto taken = [&] {
      return bench_.taken ? bench_.taken() - before : static_cast<std::uint64_t>(waited_);
    };
    for (waited_ = 0; waited_ < kLongest && taken() < kSoon && bench_.motors_N() != Vec3{}; ++waited_)
      touch_->ticks(1);
    ASSERT_EQ(bench_.motors_N(), Vec3{}) << taken() << " commands taken in " << waited_ << " ticks";
  }
  void is_opened_again() {
    // A hung-up line is noticed as soon as the system passes it on.
    constexpr int kLongest = 1000;
    for (int k = 0; k < kLongest && touch_->ticks(1) != device::Status::fault; ++k) {
    }
    ASSERT_EQ(touch_->ticks(1), device::Status::fault);
    ASSERT_FALSE(touch_->device().fault().empty());
    touch_.reset();
    ASSERT_TRUE(!bench_.is_reached_when_gone || becomes_free());
    bench_.inject(DriverFault::none);
    open();
  }
  /// The spring's force rises by the ramp, and all of it from zero by at most the rise limit.
  void resumes_with_a_ramp() {
    // A driver rests before (FreshReading::kRest_s).
    constexpr int kTicks = 60;
    // A tick may be late by half a period; an effect of a joystick lasts four.
    constexpr int kSooner = 4;
    const haptics::TickOptions limits;
    const double most_rise_N = limits.max_force_rate_N_per_s * limits.max_rise_time_s;
    device::Status status{};
    for (int k = 0; k < kTicks; ++k) {
      status = touch_->ticks(1);
      ASSERT_LE(norm(bench_.motors_N()), most_rise_N * (waited_ + k + kSooner) + GetParam().step_N) << k;
    }
    ASSERT_TRUE(bench_.is_real_time || status == device::Status::ok);
    ASSERT_TRUE(status != device::Status::ok || touch_->has_ramped());
  }

  Wire wire_;
  DriverBench bench_ = GetParam().bench([this](Vec3 force_N) { wire_.receive(force_N); });
  std::optional<FaultyTouch> touch_;
  /// Ticks between the end of a fault and a free motor.
  int waited_ = 0;
  double slowest_s_ = 0.0;
  int late_ = 0;
  int sent_late_ = 0;
  int late_itself_ = 0;
};

TEST_P(DriverWithAFault, IsFreeInTimeAndResumesWithARamp) {
  const auto& [driver, bench, step_N, press_m, everyday, fault, name, during] = GetParam();
  // On a busy machine a touch in real time may lose its contact for too long.
  if (bench_.is_real_time && std::getenv("PALPABLE_FAULTS") == nullptr) GTEST_SKIP();
  std::mt19937 random(static_cast<unsigned>(fault) + 1);
  open();
  int faults = 0;
  const int times = instants();
  for (int time = 0; time < times; ++time) {
    SCOPED_TRACE(time);
    ASSERT_TRUE(touch_->presses());
    touch_->ticks(static_cast<int>(random() % 60));
    // It may just bounce.
    ASSERT_TRUE(touch_->pushes());
    const int told = touch_->told_faults();
    bench_.inject(fault);
    switch (during) {
      case During::free:
        is_free_within_ten_ticks();
        break;
      case During::cut_off:
        is_cut_off();
        break;
      case During::gone:
        is_opened_again();
        break;
      case During::limited:
        touch_->ticks(60);
        break;
    }
    if (HasFatalFailure()) return;
    faults += during == During::gone || touch_->told_faults() > told ? 1 : 0;
    if (during == During::free) touch_->begin_ramp();
    bench_.inject(DriverFault::none);
    if (during != During::limited) resumes_with_a_ramp();
    if (HasFatalFailure()) return;
  }
  // In real time a late answer may have been told just before.
  EXPECT_TRUE(during == During::limited || bench_.is_real_time || faults == times) << faults;
  EXPECT_EQ(wire_.not_finite(), 0);
  EXPECT_EQ(wire_.above_cap(), 0);
  EXPECT_EQ(bench_.strange ? bench_.strange() : 0U, 0U);
  // The time of a virtual device with a thread is that of the machine.
  EXPECT_TRUE(bench_.is_real_time || late_ == 0) << late_;
  std::cout << driver << ", " << name << ": " << times << " instants, told " << faults << ", free within "
            << 1000.0 * slowest_s_ << " ms, later than 10 ms " << late_ << "; zero was sent later in "
            << sent_late_ << ", and would have been without late ticks in " << late_itself_ << "\n";
}

/// A driver's faults, by what the hand may feel during them.
struct Faults {
  std::vector<DriverFault> free, limited, cut_off, gone;
};

std::vector<FaultCase> cases_of(const char* driver, DriverBench (*bench)(const OnForce&), double step_N,
                                double press_m, int instants, const Faults& faults) {
  constexpr std::array kNames{"none",     "silent",    "garbage",   "short_packets",     "not_finite",
                              "far_away", "nested",    "no_device", "wrong_calibration", "stuck",
                              "dropped",  "reordered", "stalled",   "unplugged"};
  std::vector<FaultCase> cases;
  for (const auto& [during, some] :
       {std::pair(During::free, &faults.free), std::pair(During::limited, &faults.limited),
        std::pair(During::cut_off, &faults.cut_off), std::pair(During::gone, &faults.gone)})
    for (const DriverFault fault : *some)
      cases.push_back({driver, bench, step_N, press_m, instants, fault,
                       kNames.at(static_cast<std::size_t>(fault)), during});
  return cases;
}

std::vector<FaultCase> all_cases() {
  using enum DriverFault;
  const std::vector<DriverFault> places{stuck, dropped, reordered};
  const auto calibrated_places = [&] {
    std::vector<DriverFault> all{wrong_calibration};
    all.insert(all.end(), places.begin(), places.end());
    return all;
  }();
  const auto open_haptics = [](const OnForce& on_force) { return open_haptics_bench(on_force); };
  std::vector<FaultCase> all;
  for (const auto& cases :
       {cases_of("falcon", falcon_bench, kFalconStep_N, 0.012, 20,
                 {{silent, garbage, short_packets, wrong_calibration}, places, {stalled}, {unplugged}}),
        cases_of("two_diy", two_diy_bench, kTwoDiyStep_N, 0.0, 2,
                 {{silent, garbage, short_packets, not_finite, wrong_calibration},
                  places,
                  {stalled},
                  {unplugged}}),
        cases_of("inverse3", inverse3_bench, kExact_N, 0.012, 2,
                 {{silent, garbage, short_packets, not_finite, nested, far_away, no_device},
                  places,
                  {stalled},
                  {unplugged}}),
        cases_of("force_dimension", force_dimension_bench, kExact_N, 0.012, 60,
                 {{silent, garbage, not_finite, far_away, unplugged}, calibrated_places, {}, {}}),
        cases_of("open_haptics", open_haptics, kExact_N, 0.012, 60,
                 {{silent, garbage, not_finite, far_away, unplugged}, calibrated_places, {stalled}, {}}),
        cases_of("evdev", evdev_bench, kEvdevStep_N, 0.0, 60,
                 {{}, {garbage, stuck, dropped}, {stalled}, {unplugged}})})
    all.insert(all.end(), cases.begin(), cases.end());
  return all;
}

INSTANTIATE_TEST_SUITE_P(Faults, DriverWithAFault, testing::ValuesIn(all_cases()), [](const auto& tested) {
  return std::string(tested.param.driver) + "_" + tested.param.name;
});

}  // namespace
}  // namespace palpable::session
