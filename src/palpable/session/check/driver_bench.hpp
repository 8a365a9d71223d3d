// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/system/hand_off.hpp"
#include "palpable/core/system/shared_library.hpp"
#include "palpable/device/drivers/open.hpp"
#include "palpable/device/evdev/evdev.hpp"
#include "palpable/device/falcon/falcon.hpp"
#include "palpable/device/falcon/falcon_kinematics.hpp"
#include "palpable/device/virtual/virtual_falcon.hpp"
#include "palpable/device/virtual/virtual_inverse3.hpp"
#include "palpable/device/virtual/virtual_joystick.hpp"
#include "palpable/device/virtual/virtual_two_diy.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <random>
#include <string>
#include <thread>
#include <utility>

#include <gtest/gtest.h>

// For tests: each driver on its own virtual device.
namespace palpable::session {

/// What can go wrong with a device, its line or its service.
enum class DriverFault : std::uint8_t {
  none,
  silent,
  garbage,
  short_packets,
  not_finite,
  far_away,
  nested,
  no_device,
  wrong_calibration,
  stuck,
  dropped,
  reordered,
  stalled,
  unplugged
};

/// Receives each force that reaches the virtual device, in our axes, N; by the device's thread.
using OnForce = std::function<void(Vec3)>;

/// A driver's virtual device. All vectors are in the device's frame.
struct DriverBench {
  /// Opens the driver on it; again after the one before was closed.
  std::function<Result<std::unique_ptr<device::Device>>()> open;
  /// Where the hand wants to be, from the middle of the workspace.
  std::function<void(Vec3)> pull_to;
  /// The time between two ticks passes. In simulated time unless is_real_time.
  std::function<void()> pass_tick;
  std::function<void(DriverFault)> inject;
  /// The force that the motors hold.
  std::function<Vec3()> motors_N;
  /// What came that was no command; null if the interface allows only commands.
  std::function<std::uint64_t()> strange;
  /// How many commands it has taken; null if it takes each one at once.
  std::function<std::uint64_t()> taken;
  bool is_real_time = false;
  /// Its motors can be reached after it was unplugged: by another connection to its service.
  bool is_reached_when_gone = false;
};

// The step of each wire, N.
/// Doubles, or their shortest text.
inline constexpr double kExact_N = 1e-12;
/// Floats of torque: 24 bits of 0.123 N·m; and the hand moves between the driver's angles and the board's.
inline constexpr double kTwoDiyStep_N = 0.002;
/// Of the torques themselves, N·m.
inline constexpr double kTwoDiyStep_Nm = 1e-8;
/// One step of three motor words, 0.1 mN·m each, at a lever of 60 mm at least; and one count of the angles
/// that the driver had, of 4 N.
inline constexpr double kFalconStep_N = 0.02;
/// 15 bits of the greatest force (2 N), and 16 bits of a turn.
inline constexpr double kEvdevStep_N = 2.0 / 32767.0 + 2.0 * 6.2832 / 65536.0;

/// What a 2DIY gets: the force on its handle, or the torques of its motors, N·m, as x and y.
enum class TwoDiyTells : std::uint8_t { force, torques };

inline DriverBench two_diy_bench_that(TwoDiyTells tells, const OnForce& on_force) {
  using Fault = device::VirtualTwoDiy::Fault;
  const auto& variant = device::kTwoDiyVariants[0];
  const auto board = std::make_shared<std::unique_ptr<device::VirtualTwoDiy>>();
  const auto ours = [&variant](device::InPlane force) {
    return Vec3{-force.x / variant.torque_gain, -force.y / variant.torque_gain, 0.0};
  };
  const auto plug_in = [=, &variant] {
    *board = std::make_unique<device::VirtualTwoDiy>(variant);
    if (!on_force) return;
    if (tells == TwoDiyTells::force)
      (*board)->on_force = [=](device::InPlane force) { on_force(ours(force)); };
    else
      (*board)->on_torques = [=](std::array<double, 2> by_motor) {
        on_force({by_motor[0], by_motor[1], 0.0});
      };
  };
  plug_in();
  DriverBench bench;
  bench.open = [board, &variant] {
    return device::open_device("2diy:" + (*board)->path() + "?variant=" + std::string(variant.name), {});
  };
  bench.pull_to = [board, &variant](Vec3 goal) {
    (*board)->pull_to({variant.centre.x - goal.x, variant.centre.y - goal.y});
  };
  bench.pass_tick = [] { std::this_thread::sleep_for(std::chrono::milliseconds(1)); };
  bench.is_real_time = true;
  bench.inject = [board, plug_in, gone = std::make_shared<bool>(false)](DriverFault fault) {
    if (std::exchange(*gone, fault == DriverFault::unplugged)) return plug_in();
    (*board)->inject(fault == DriverFault::silent              ? Fault::silent
                     : fault == DriverFault::garbage           ? Fault::garbage
                     : fault == DriverFault::short_packets     ? Fault::cut_answers
                     : fault == DriverFault::not_finite        ? Fault::not_finite
                     : fault == DriverFault::stuck             ? Fault::stuck
                     : fault == DriverFault::wrong_calibration ? Fault::wrong_calibration
                     : fault == DriverFault::dropped           ? Fault::dropped
                     : fault == DriverFault::reordered         ? Fault::reordered
                     : fault == DriverFault::stalled           ? Fault::stalled
                     : fault == DriverFault::unplugged         ? Fault::unplugged
                                                               : Fault::none);
  };
  bench.motors_N = [board, ours] { return ours((*board)->force_N()); };
  bench.strange = [board] { return (*board)->strange(); };
  return bench;
}

inline DriverBench two_diy_bench(const OnForce& on_force) {
  return two_diy_bench_that(TwoDiyTells::force, on_force);
}

/// The torques that this force makes where the handle is at `place`, as two_diy_bench_that() tells them.
inline Vec3 two_diy_torques(Vec3 force_N, Vec3 place_m) {
  const auto& variant = device::kTwoDiyVariants[0];
  const auto angles = variant.linkage.angles_at({variant.centre.x - place_m.x, variant.centre.y - place_m.y});
  const auto torques = angles ? variant.linkage.torques(*angles, {-force_N.x, -force_N.y}) : std::nullopt;
  if (!torques) return {};
  const double most = std::max(std::abs((*torques)[0]), std::abs((*torques)[1]));
  const double gain =
      variant.torque_gain * (most > device::kTwoDiyMaxTorque_Nm ? device::kTwoDiyMaxTorque_Nm / most : 1.0);
  return {gain * (*torques)[0], gain * (*torques)[1], 0.0};
}

inline DriverBench inverse3_bench(const OnForce& on_force) {
  using Fault = device::VirtualInverse3::Fault;
  const auto ours = [](Vec3 force) { return Vec3{force.x, force.z, -force.y}; };
  device::VirtualInverse3::Options options;
  if (on_force) options.on_force = [=](Vec3 force) { on_force(ours(force)); };
  const auto service = std::make_shared<device::VirtualInverse3>(options);
  DriverBench bench;
  bench.open = [service] {
    return device::open_device("inverse3:?port=" + std::to_string(service->port()), {});
  };
  bench.pull_to = [service](Vec3 goal) { service->pull_to({goal.x, -goal.z, goal.y}); };
  bench.pass_tick = [] { std::this_thread::sleep_for(std::chrono::milliseconds(1)); };
  bench.is_real_time = true;
  bench.is_reached_when_gone = true;
  bench.inject = [service, gone = std::make_shared<bool>(false)](DriverFault fault) {
    // Its middle is where the handle is when it is opened.
    if (std::exchange(*gone, fault == DriverFault::unplugged)) service->hold_at_rest();
    service->inject(fault == DriverFault::silent          ? Fault::silent
                    : fault == DriverFault::garbage       ? Fault::garbage
                    : fault == DriverFault::short_packets ? Fault::short_packets
                    : fault == DriverFault::not_finite    ? Fault::not_finite
                    : fault == DriverFault::nested        ? Fault::nested
                    : fault == DriverFault::far_away      ? Fault::far_away
                    : fault == DriverFault::no_device     ? Fault::no_device
                    : fault == DriverFault::stuck         ? Fault::stuck
                    : fault == DriverFault::dropped       ? Fault::dropped
                    : fault == DriverFault::reordered     ? Fault::reordered
                    : fault == DriverFault::stalled       ? Fault::stalled
                    : fault == DriverFault::unplugged     ? Fault::closed
                                                          : Fault::none);
  };
  bench.motors_N = [service, ours] { return ours(service->force_N()); };
  bench.taken = [service] { return service->messages(); };
  bench.strange = [service] { return service->strange(); };
  return bench;
}

inline DriverBench falcon_bench(const OnForce& on_force) {
  using Fault = device::VirtualFalcon::Fault;
  const auto grip = std::make_shared<device::VirtualFalcon>();
  if (on_force) grip->on_command = [on_force, it = grip.get()] { on_force(it->force_N()); };
  DriverBench bench;
  bench.open = [grip]() -> Result<std::unique_ptr<device::Device>> {
    device::FalconOptions options;
    // The simulated device's time passes with the servo's ticks.
    options.own_thread = false;
    auto opened = device::Falcon::open(grip->plug_in(), options);
    if (!opened) return std::move(opened).error();
    return std::unique_ptr<device::Device>(*std::move(opened));
  };
  bench.pull_to = [grip](Vec3 goal) { grip->pull_to(device::falcon::kCentre_m + goal); };
  bench.pass_tick = [] {};
  bench.inject = [grip](DriverFault fault) {
    grip->inject(fault == DriverFault::silent              ? Fault::silent
                 : fault == DriverFault::garbage           ? Fault::garbage
                 : fault == DriverFault::short_packets     ? Fault::short_packets
                 : fault == DriverFault::wrong_calibration ? Fault::wrong_calibration
                 : fault == DriverFault::stuck             ? Fault::stuck_encoder
                 : fault == DriverFault::dropped           ? Fault::dropped
                 : fault == DriverFault::reordered         ? Fault::reordered
                 : fault == DriverFault::stalled           ? Fault::stalled
                 : fault == DriverFault::unplugged         ? Fault::unplugged
                                                           : Fault::none);
  };
  bench.motors_N = [grip] { return grip->force_N(); };
  bench.strange = [grip] { return grip->strange_bytes(); };
  return bench;
}

inline device::LibraryFault library_fault(DriverFault fault) {
  using Fault = device::LibraryFault;
  return fault == DriverFault::silent              ? Fault::unreadable
         : fault == DriverFault::not_finite        ? Fault::not_finite
         : fault == DriverFault::far_away          ? Fault::far_away
         : fault == DriverFault::garbage           ? Fault::garbage
         : fault == DriverFault::wrong_calibration ? Fault::shifted
         : fault == DriverFault::stuck             ? Fault::stuck
         : fault == DriverFault::dropped           ? Fault::dropped
         : fault == DriverFault::reordered         ? Fault::reordered
         : fault == DriverFault::unplugged         ? Fault::unplugged
                                                   : Fault::none;
}

/// The functions of a vendor's virtual library with which a test plays its device.
struct LibraryControls {
  void (*reset)() = nullptr;
  void (*inject)(int) = nullptr;
  void (*pull_to)(double, double, double) = nullptr;
  void (*force)(double*, double*, double*) = nullptr;
  void (*report)(void (*)(void*, double, double, double), void*) = nullptr;
};

inline LibraryControls bind_controls(SharedLibrary& library, const std::string& prefix) {
  LibraryControls controls;
  EXPECT_TRUE(library.bind(controls.reset, (prefix + "reset").c_str()));
  EXPECT_TRUE(library.bind(controls.inject, (prefix + "inject").c_str()));
  EXPECT_TRUE(library.bind(controls.pull_to, (prefix + "pull_to").c_str()));
  EXPECT_TRUE(library.bind(controls.force, (prefix + "force").c_str()));
  EXPECT_TRUE(library.bind(controls.report, (prefix + "report").c_str()));
  controls.reset();
  return controls;
}

/// With its library in this process, where the test can reach it.
inline Result<std::unique_ptr<device::Device>> open_here(const std::string& url) {
  device::OpenOptions options;
  options.vendor_library = device::VendorLibrary::here;
  return device::open_device(url, options);
}

inline DriverBench force_dimension_bench(const OnForce& on_force) {
  auto library = SharedLibrary::open(PALPABLE_VIRTUAL_DHD, {});
  EXPECT_TRUE(library);
  const LibraryControls controls = bind_controls(*library, "virtual_dhd_");
  const auto told = std::make_shared<OnForce>(on_force);
  if (on_force)
    controls.report(
        [](void* to, double x, double y, double z) {
          (*static_cast<OnForce*>(to))({y, z, x});
        },
        told.get());
  DriverBench bench;
  bench.open = [] { return open_here("forcedimension:?library=" PALPABLE_VIRTUAL_DHD); };
  bench.pull_to = [controls](Vec3 goal) { controls.pull_to(goal.z, goal.x, goal.y); };
  bench.pass_tick = [] {};
  bench.inject = [controls](DriverFault fault) { controls.inject(static_cast<int>(library_fault(fault))); };
  bench.motors_N = [controls, told] {
    Vec3 theirs;
    controls.force(&theirs.x, &theirs.y, &theirs.z);
    return Vec3{theirs.y, theirs.z, theirs.x};
  };
  return bench;
}

/// Who calls the driver's callback: the test in each tick, or the virtual library's own thread.
enum class Callbacks : std::uint8_t { by_ticks, by_thread };

inline DriverBench open_haptics_bench(const OnForce& on_force, Callbacks callbacks = Callbacks::by_ticks) {
  auto library = SharedLibrary::open(PALPABLE_VIRTUAL_HD, {});
  EXPECT_TRUE(library);
  const LibraryControls controls = bind_controls(*library, "virtual_hd_");
  void (*call)() = nullptr;
  void (*run)() = nullptr;
  EXPECT_TRUE(library->bind(call, "virtual_hd_call") && library->bind(run, "virtual_hd_run"));
  if (callbacks == Callbacks::by_thread) run();
  const auto told = std::make_shared<OnForce>(on_force);
  if (on_force)
    controls.report(
        [](void* to, double x, double y, double z) {
          (*static_cast<OnForce*>(to))({x, y, z});
        },
        told.get());
  const auto stalled = std::make_shared<bool>(false);
  DriverBench bench;
  bench.open = [] { return open_here("touch:?library=" PALPABLE_VIRTUAL_HD); };
  bench.pull_to = [controls](Vec3 goal) { controls.pull_to(goal.x, goal.y, goal.z); };
  bench.pass_tick = [callbacks, call, stalled] {
    if (callbacks == Callbacks::by_ticks && !*stalled) call();
  };
  bench.inject = [controls, stalled](DriverFault fault) {
    *stalled = fault == DriverFault::stalled;
    controls.inject(static_cast<int>(library_fault(fault)));
  };
  bench.motors_N = [controls, told] {
    Vec3 held;
    controls.force(&held.x, &held.y, &held.z);
    return held;
  };
  return bench;
}

/// A stick is where the hand holds it; its whole way is 0.1 m.
class HeldStick {
 public:
  explicit HeldStick(OnForce on_force) : on_force_(std::move(on_force)) {}

  std::unique_ptr<device::Device> plug_in() {
    auto port = std::make_unique<device::VirtualJoystick>(true);
    stick_ = port.get();
    if (on_force_)
      stick_->on_upload = [this](const ff_effect& effect) {
        on_force_(2.0 * device::VirtualJoystick::push_of(effect));
      };
    stick_->on_read = [this] { happen(); };
    return std::make_unique<device::EvdevDevice>(std::move(port), device::EvdevOptions{});
  }
  /// Any thread.
  void pull_to(Vec3 goal_m) { goal_.put(goal_m); }
  void inject(DriverFault fault) {
    // The one before may be closed already.
    if (std::exchange(fault_, fault) == DriverFault::unplugged) return;
    stick_->refuse(fault == DriverFault::stalled);
    if (is_unplugged()) stick_->unplug();
  }
  void pass_tick() { stick_->pass_millisecond(); }
  bool is_unplugged() const { return fault_ == DriverFault::unplugged; }
  Vec3 push_N() const { return fault_ == DriverFault::unplugged ? Vec3{} : 2.0 * stick_->push(); }

 private:
  void happen() {
    if (fault_ == DriverFault::garbage)
      // Kinds, codes and values that no stick has.
      for (int k = 0; k < 8; ++k)
        stick_->happen(static_cast<int>(4 + random_() % 60000), static_cast<int>(random_() % 65536),
                       static_cast<int>(random_()));
    Vec3 goal_m;
    if (!goal_.take(goal_m) || fault_ == DriverFault::stuck) return;
    stick_->happen(EV_ABS, ABS_X, static_cast<int>(std::lround(goal_m.x * 10230.0)));
    if (fault_ != DriverFault::dropped)
      stick_->happen(EV_ABS, ABS_Y, static_cast<int>(std::lround(127.5 - goal_m.y * 2550.0)));
  }
  OnForce on_force_;
  device::VirtualJoystick* stick_ = nullptr;
  LatestValue<Vec3> goal_;
  DriverFault fault_ = DriverFault::none;
  std::mt19937 random_{7};
};

inline DriverBench evdev_bench(const OnForce& on_force) {
  const auto stick = std::make_shared<HeldStick>(on_force);
  DriverBench bench;
  bench.open = [stick]() -> Result<std::unique_ptr<device::Device>> {
    if (stick->is_unplugged()) return Error{ErrorCode::device, "is not there", "evdev:"};
    return stick->plug_in();
  };
  bench.pull_to = [stick](Vec3 goal) { stick->pull_to(goal); };
  bench.pass_tick = [stick] { stick->pass_tick(); };
  bench.inject = [stick](DriverFault fault) { stick->inject(fault); };
  bench.motors_N = [stick] { return stick->push_N(); };
  return bench;
}

}  // namespace palpable::session
