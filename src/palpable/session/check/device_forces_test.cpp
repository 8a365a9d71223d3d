// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/formats/scene/scene_file.hpp"
#include "palpable/haptics/servo/servo_loop.hpp"
#include "palpable/haptics/servo/start_touch.hpp"
#include "palpable/session/check/driver_bench.hpp"
#include "palpable/session/check/hosted_bench.hpp"
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

struct DriverCase {
  const char* name;
  DriverBench (*bench)(const OnForce&);
  double step_N;
  /// What the wire carries of a written force, in the place that was read: the force, or torques in N·m.
  Vec3 (*on_wire)(Vec3 force_N, Vec3 place_m);
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
  const DriverBench bench = GetParam().bench([&forces](Vec3 force_N) { forces.receive(force_N); });
  auto device = bench.open();
  ASSERT_TRUE(device) << device.error().sentence();
  const device::Traits traits = (*device)->traits();
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
  auto loop = haptics::ServoLoop::start(*std::move(device), touched, options);
  ASSERT_TRUE(loop) << loop.error().sentence();

  const auto device_from_scene = place.inverse();
  std::uint64_t contact = 0, faults = 0;
  const auto take = [&] {
    forces.mark();
    while (const auto sample = (*loop)->take_recorded()) {
      offline.step(*sample);
      forces.wrote(GetParam().on_wire(rotate_force(device_from_scene, sample->written_force_N).v,
                                      sample->device_position.v));
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

Vec3 the_force(Vec3 force_N, Vec3 /*place_m*/) { return force_N; }

DriverBench told_two_diy_bench(const OnForce& on_force) {
  return two_diy_bench_that(TwoDiyTells::torques, on_force);
}

INSTANTIATE_TEST_SUITE_P(
    Drivers, EachDriver,
    testing::Values(DriverCase{"two_diy", told_two_diy_bench, kTwoDiyStep_Nm, two_diy_torques, 0.0},
                    DriverCase{"inverse3", inverse3_bench, kExact_N, the_force, 0.012},
                    DriverCase{"falcon", falcon_bench, kFalconStep_N, the_force, 0.012},
                    DriverCase{"force_dimension", hosted_force_dimension_bench, kExact_N, the_force, 0.012},
                    DriverCase{"open_haptics", hosted_open_haptics_bench, kExact_N, the_force, 0.012},
                    DriverCase{"evdev", evdev_bench, kEvdevStep_N, the_force, 0.0}),
    [](const testing::TestParamInfo<DriverCase>& tested) { return std::string(tested.param.name); });

}  // namespace
}  // namespace palpable::session
