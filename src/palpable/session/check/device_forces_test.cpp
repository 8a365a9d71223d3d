// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/device/drivers/open.hpp"
#include "palpable/device/evdev/evdev.hpp"
#include "palpable/device/falcon/falcon.hpp"
#include "palpable/device/falcon/falcon_kinematics.hpp"
#include "palpable/device/transport/shared_library.hpp"
#include "palpable/device/virtual/virtual_falcon.hpp"
#include "palpable/device/virtual/virtual_inverse3.hpp"
#include "palpable/device/virtual/virtual_joystick.hpp"
#include "palpable/device/virtual/virtual_two_diy.hpp"
#include "palpable/formats/scene/scene_file.hpp"
#include "palpable/haptics/servo/servo_loop.hpp"
#include "palpable/haptics/servo/start_touch.hpp"
#include "palpable/session/check/offline_ticks.hpp"
#include "palpable/session/check/wire_forces.hpp"
#include "palpable/session/touch/haptic_scene.hpp"
#include "palpable/session/touch/test_session.hpp"

#include <chrono>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <iostream>
#include <memory>
#include <string>
#include <thread>

#include <gtest/gtest.h>

namespace palpable::session {
namespace {

/// A driver on its virtual device. All vectors are in the device's frame.
struct Bench {
  std::unique_ptr<device::Device> device;
  std::function<void(Vec3)> pull_to;
  /// Keeps the virtual device.
  std::shared_ptr<void> keeps;
};

// The step of each wire, N.
/// Doubles, or their shortest text.
constexpr double kExact_N = 1e-12;
/// Floats of torque: 24 bits of 0.123 N·m; and the hand moves between the driver's angles and the board's.
constexpr double kTwoDiyStep_N = 0.002;
/// One step of three motor words, 0.1 mN·m each, at a lever of 60 mm at least; and one count of the angles
/// that the driver had, of 4 N.
constexpr double kFalconStep_N = 0.02;
/// 15 bits of the greatest force (2 N), and 16 bits of a turn.
constexpr double kEvdevStep_N = 2.0 / 32767.0 + 2.0 * 6.2832 / 65536.0;

Bench two_diy(WireForces& forces) {
  const auto& variant = device::kTwoDiyVariants[0];
  auto board = std::make_shared<device::VirtualTwoDiy>(variant);
  board->on_force = [&forces, &variant](device::InPlane force) {
    forces.receive({-force.x / variant.torque_gain, -force.y / variant.torque_gain, 0.0});
  };
  auto opened = device::open_device("2diy:" + board->path() + "?variant=" + std::string(variant.name), {});
  EXPECT_TRUE(opened) << opened.error().sentence();
  return {*std::move(opened),
          [board, &variant](Vec3 goal) {
            board->pull_to({variant.centre.x - goal.x, variant.centre.y - goal.y});
          },
          board};
}

Bench inverse3(WireForces& forces) {
  device::VirtualInverse3::Options options;
  options.on_force = [&forces](Vec3 force) { forces.receive({force.x, force.z, -force.y}); };
  auto service = std::make_shared<device::VirtualInverse3>(options);
  auto opened = device::open_device("inverse3:?port=" + std::to_string(service->port()), {});
  EXPECT_TRUE(opened) << opened.error().sentence();
  return {*std::move(opened), [service](Vec3 goal) { service->pull_to({goal.x, -goal.z, goal.y}); }, service};
}

Bench falcon(WireForces& forces) {
  auto grip = std::make_shared<device::VirtualFalcon>();
  grip->on_command = [&forces, it = grip.get()] { forces.receive(it->force_N()); };
  device::FalconOptions options;
  // The simulated device's time passes with the servo's ticks.
  options.own_thread = false;
  auto opened = device::Falcon::open(grip->plug_in(), options);
  EXPECT_TRUE(opened) << opened.error().sentence();
  return {*std::move(opened), [grip](Vec3 goal) { grip->pull_to(device::falcon::kCentre_m + goal); }, grip};
}

using Report = void (*)(void (*)(void*, double, double, double), void*);
using Pull = void (*)(double, double, double);

Bench force_dimension(WireForces& forces) {
  const auto library = device::SharedLibrary::open(PALPABLE_VIRTUAL_DHD, {});
  EXPECT_TRUE(library);
  Report report = nullptr;
  Pull pull = nullptr;
  EXPECT_TRUE(library->bind(report, "virtual_dhd_report") && library->bind(pull, "virtual_dhd_pull_to"));
  auto opened = device::open_device("forcedimension:?library=" PALPABLE_VIRTUAL_DHD, {});
  EXPECT_TRUE(opened) << opened.error().sentence();
  report(
      [](void* data, double x, double y, double z) {
        static_cast<WireForces*>(data)->receive({y, z, x});
      },
      &forces);
  return {*std::move(opened), [pull](Vec3 goal) { pull(goal.z, goal.x, goal.y); }, {}};
}

Bench open_haptics(WireForces& forces) {
  const auto library = device::SharedLibrary::open(PALPABLE_VIRTUAL_HD, {});
  EXPECT_TRUE(library);
  Report report = nullptr;
  Pull pull = nullptr;
  void (*run)() = nullptr;
  EXPECT_TRUE(library->bind(report, "virtual_hd_report") && library->bind(pull, "virtual_hd_pull_to") &&
              library->bind(run, "virtual_hd_run"));
  run();
  report(
      [](void* data, double x, double y, double z) {
        static_cast<WireForces*>(data)->receive({x, y, z});
      },
      &forces);
  auto opened = device::open_device("touch:?library=" PALPABLE_VIRTUAL_HD, {});
  EXPECT_TRUE(opened) << opened.error().sentence();
  return {*std::move(opened), [pull](Vec3 goal) { pull(goal.x, goal.y, goal.z); }, {}};
}

Bench evdev(WireForces& forces) {
  auto stick = std::make_unique<device::VirtualJoystick>(true);
  auto goal_m = std::make_shared<LatestValue<Vec3>>();
  stick->on_upload = [&forces](const ff_effect& effect) {
    forces.receive(2.0 * device::VirtualJoystick::push_of(effect));
  };
  // A stick is where the hand holds it. Its whole way is 0.1 m.
  stick->on_read = [it = stick.get(), goal_m] {
    if (Vec3 goal; goal_m->take(goal)) {
      it->happen(EV_ABS, ABS_X, static_cast<int>(std::lround(goal.x * 10230.0)));
      it->happen(EV_ABS, ABS_Y, static_cast<int>(std::lround(127.5 - goal.y * 2550.0)));
    }
  };
  auto device = std::make_unique<device::EvdevDevice>(std::move(stick), device::EvdevOptions{});
  return {std::move(device), [goal_m](Vec3 goal) { goal_m->put(goal); }, goal_m};
}

struct DriverCase {
  const char* name;
  Bench (*open)(WireForces&);
  double step_N;
  /// How deep the hand wants to be below the surface: its spring presses with 120 N/m.
  double press_m;
};

double seconds_of_a_touch() {
  const char* wanted = std::getenv("PALPABLE_DEVICE_SECONDS");
  return wanted != nullptr ? std::atof(wanted) : 2.0;
}

/// The scene in the file that PALPABLE_DEVICE_SCENE names; else hills.
models::Scene scene_to_touch() {
  const char* file = std::getenv("PALPABLE_DEVICE_SCENE");
  if (file == nullptr) return hilly_scene(0.004);
  auto scene = formats::read_scene(file);
  EXPECT_TRUE(scene) << scene.error().sentence();
  return std::move(scene->scene);
}

class EachDriver : public testing::TestWithParam<DriverCase> {};

TEST_P(EachDriver, GetsTheForcesThatAreComputedOfflineFromTheRecordedPath) {
  WireForces forces(GetParam().step_N);
  Bench bench = GetParam().open(forces);
  ASSERT_TRUE(bench.device);
  const device::Traits traits = bench.device->traits();
  const models::Scene scene = scene_to_touch();
  const auto place = haptics::fit_workspace(scene, traits);
  KeptSurfaces kept;
  auto prepared = prepare_scene(scene, TouchSettings{}, traits, 1000.0, place, kept);
  ASSERT_TRUE(prepared) << prepared.error().sentence();
  const haptics::HapticScene touched = prepared->scene;
  haptics::ServoOptions options = unprivileged(1.0).session.servo;
  // A long run asks for the priority of a touch.
  if (std::getenv("PALPABLE_DEVICE_SECONDS") != nullptr)
    options.realtime_priority = haptics::ServoOptions{}.realtime_priority;
  options.watch_s = 0.0;
  options.recording = haptics::Recording::on;
  OfflineTicks offline(traits, touched, haptics::tick_options(options));
  auto loop = haptics::ServoLoop::start(std::move(bench.device), touched, options);
  ASSERT_TRUE(loop) << loop.error().sentence();

  const auto device_from_scene = place.inverse();
  std::uint64_t contact = 0, faults = 0;
  const auto take = [&] {
    while (const auto sample = (*loop)->take_recorded()) {
      offline.step(*sample);
      forces.wrote(rotate_force(device_from_scene, sample->written_force_N).v);
      contact += sample->has(haptics::flag::kContact) ? 1U : 0U;
      faults += sample->status != device::Status::ok ? 1U : 0U;
    }
  };
  // A hand that strokes over the whole surface, and lifts off now and then.
  const double top_m = (device_from_scene * Point<SceneFrame>{{0.0, 0.0, 0.004}}).v.z;
  using Clock = std::chrono::steady_clock;
  const auto begun = Clock::now();
  for (double t_s = 0.0; t_s < seconds_of_a_touch();) {
    const double lift_m = 0.6 * t_s - std::floor(0.6 * t_s) > 0.8 ? 0.01 : -GetParam().press_m;
    bench.pull_to({0.35 * traits.workspace_m.x * std::sin(1.7 * t_s),
                   0.35 * traits.workspace_m.y * std::sin(1.1 * t_s + 0.4), top_m + lift_m});
    take();
    forces.compare(false);
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
    t_s = std::chrono::duration<double>(Clock::now() - begun).count();
  }
  (*loop)->stop();
  take();
  forces.wrote({});
  const haptics::ServoStatistics statistics = (*loop)->statistics();
  const std::uint64_t lost = (*loop)->recording_lost();
  loop->reset();
  forces.compare(true);

  EXPECT_EQ(offline.ticks() + lost, statistics.touch.ticks);
  EXPECT_EQ(offline.differing(), 0U);
  // On a busy machine, where the virtual device or this thread is seconds behind, forces on the wire cannot
  // be assigned to those written; then only what was computed is compared.
  const bool was_busy = lost > 0 || faults > 50 || statistics.touch.stalls > 0;
  EXPECT_TRUE(forces.different() == 0 || was_busy) << forces.different();
  EXPECT_GT(forces.with_force(), 50U);
  EXPECT_GT(contact, 100U);
  std::cout << GetParam().name << ": " << statistics.touch.ticks << " ticks at " << statistics.rate_hz
            << " Hz, missed " << statistics.missed << ", stalls " << statistics.touch.stalls << ", contact "
            << contact << ", without a good reading " << faults << "; recomputed " << offline.ticks()
            << ", differing " << offline.differing() << "; received " << forces.matched() << " ("
            << forces.with_force() << " with force), withheld " << forces.withheld() << ", different "
            << forces.different() << ", greatest difference " << forces.max_difference_N()
            << " N; a tick takes " << statistics.compute_us.p50 << " us (p50), " << statistics.compute_us.p99
            << " us (p99)\n";
}

INSTANTIATE_TEST_SUITE_P(Drivers, EachDriver,
                         testing::Values(DriverCase{"two_diy", two_diy, kTwoDiyStep_N, 0.0},
                                         DriverCase{"inverse3", inverse3, kExact_N, 0.012},
                                         DriverCase{"falcon", falcon, kFalconStep_N, 0.012},
                                         DriverCase{"force_dimension", force_dimension, kExact_N, 0.012},
                                         DriverCase{"open_haptics", open_haptics, kExact_N, 0.012},
                                         DriverCase{"evdev", evdev, kEvdevStep_N, 0.0}),
                         [](const testing::TestParamInfo<DriverCase>& tested) {
                           return std::string(tested.param.name);
                         });

}  // namespace
}  // namespace palpable::session
