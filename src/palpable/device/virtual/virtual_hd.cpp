// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// A double of libHD for tests, with one device. The scheduler's calls are made by the test, with
// virtual_hd_call(), or by a thread of its own at 1 kHz (virtual_hd_run()). The virtual_hd_ functions are for
// the test.
#include "palpable/device/virtual/library_board.hpp"
#include "palpable/device/virtual/moved_handle.hpp"

#include <array>
#include <atomic>
#include <chrono>
#include <cstring>
#include <mutex>
#include <thread>

namespace {

using palpable::Vec3;
using palpable::device::LibraryFault;
using palpable::device::VendorCall;

// The library's numbers, stated here once more: a wrong one in the driver must not be right here too.
namespace hd {
constexpr unsigned kButtons = 0x2000;
constexpr unsigned kPosition = 0x2050;
constexpr unsigned kModel = 0x2501;
constexpr unsigned kUsableWorkspace = 0x2551;
constexpr unsigned kCalibrationStyles = 0x2555;
constexpr unsigned kNominalMaxForce = 0x2603;
constexpr unsigned kNominalMaxContinuousForce = 0x2604;
constexpr unsigned kCurrentForce = 0x2700;
constexpr unsigned kForceOutput = 0x4000;
constexpr unsigned kCalibrationOk = 0x5000;
constexpr unsigned kCalibrationNeedsUpdate = 0x5001;
constexpr unsigned kResetEncoders = 1;
constexpr unsigned kInkwell = 4;
constexpr unsigned kCallbackDone = 0;
constexpr unsigned kNoHandle = 0xFFFFFFFF;
}  // namespace hd

struct HdError {
  unsigned code;
  int internal_code;
  unsigned handle;
};

constexpr unsigned kHandle = 7;
constexpr unsigned kDeviceFault = 0x0300;
constexpr unsigned kInvalidValue = 0x0101;
constexpr unsigned kExceededForce = 0x0201;
/// The middle of the usable workspace is not the origin, as of the real device.
constexpr Vec3 kMiddle_mm{0.0, 20.0, -10.0};

struct VirtualHd {
  std::recursive_mutex mutex;
  palpable::device::MovedHandle handle;
  palpable::device::LibrarySensor sensor;
  Vec3 force_N;
  unsigned error = 0;
  unsigned (*task)(void*) = nullptr;
  void* data = nullptr;
  bool enabled = false;
  bool opened = false;
  bool running = false;
  bool in_frame = false;
  LibraryFault fault = LibraryFault::none;
  int buttons = 0;
  unsigned updated_by = 0;
  void (*on_force)(void*, double, double, double) = nullptr;
  void* reported_to = nullptr;
  /// Runs the scheduler in a thread.
  bool threaded = false;
  std::atomic<bool> ends{false};
  std::thread thread;

  /// The process may be ended by exit(), with the thread.
  ~VirtualHd() {
    if (thread.joinable()) thread.detach();
  }
};

VirtualHd& the_device() {
  static VirtualHd device;
  return device;
}

void fail(unsigned code) {
  if (the_device().error == 0) the_device().error = code;
}

bool is_gone() { return the_device().fault == LibraryFault::unplugged; }

void call() {
  const std::scoped_lock lock(the_device().mutex);
  VirtualHd& device = the_device();
  if (!device.running || device.task == nullptr) return;
  if (device.task(device.data) == hd::kCallbackDone) device.task = nullptr;
  device.handle.move(device.enabled && !is_gone() ? device.force_N : Vec3{}, 0.001);
}

}  // namespace

extern "C" {

unsigned hdInitDevice(const char* name) {
  palpable::device::pass(VendorCall::opening);
  const std::scoped_lock lock(the_device().mutex);
  if (is_gone() || the_device().fault == LibraryFault::absent ||
      (name != nullptr && std::strcmp(name, "Left") != 0)) {
    fail(kDeviceFault);
    return hd::kNoHandle;
  }
  the_device().opened = true;
  return kHandle;
}

void hdDisableDevice(unsigned /*handle*/) {
  palpable::device::pass(VendorCall::closing);
  const std::scoped_lock lock(the_device().mutex);
  the_device().opened = false;
  the_device().force_N = {};
}

void hdMakeCurrentDevice(unsigned handle) {
  if (handle != kHandle) fail(kInvalidValue);
}
void hdBeginFrame(unsigned /*handle*/) {
  the_device().in_frame = true;
  if (is_gone()) fail(kDeviceFault);
}
void hdEndFrame(unsigned /*handle*/) { the_device().in_frame = false; }
void hdEnable(unsigned what) {
  if (what == hd::kForceOutput) the_device().enabled = true;
}
void hdDisable(unsigned what) {
  if (what == hd::kForceOutput) the_device().enabled = false;
}

void hdGetDoublev(unsigned what, double* values) {
  const std::scoped_lock lock(the_device().mutex);
  VirtualHd& device = the_device();
  if (what == hd::kUsableWorkspace) {
    constexpr std::array kCorners{-80.0, -40.0, -45.0, 80.0, 80.0, 25.0};
    std::memcpy(values, kCorners.data(), sizeof kCorners);
  } else if (what == hd::kNominalMaxForce) {
    *values = 3.3;
  } else if (what == hd::kNominalMaxContinuousForce) {
    *values = 0.88;
  } else if (what == hd::kPosition) {
    palpable::device::pass(VendorCall::reading);
    if (auto* board = palpable::device::library_board(); board != nullptr)
      board->goal_m.take(device.handle.goal_m);
    const auto measured_m = device.sensor.measure(device.handle, device.fault);
    if (!measured_m) return fail(kDeviceFault);
    const Vec3 place = 1000.0 * *measured_m + kMiddle_mm;
    values[0] = place.x;
    values[1] = place.y;
    values[2] = place.z;
  } else {
    fail(kInvalidValue);
  }
}

void hdGetIntegerv(unsigned what, int* value) {
  if (what == hd::kButtons) *value = the_device().buttons;
  if (what == hd::kCalibrationStyles) *value = static_cast<int>(hd::kInkwell | hd::kResetEncoders);
}

void hdSetDoublev(unsigned what, const double* values) {
  // The real library takes forces only within a frame.
  if (what != hd::kCurrentForce || !the_device().in_frame) return fail(kInvalidValue);
  palpable::device::pass(VendorCall::forcing);
  VirtualHd& device = the_device();
  device.force_N = {values[0], values[1], values[2]};
  if (auto* board = palpable::device::library_board(); board != nullptr) board->set(device.force_N);
  if (device.on_force != nullptr) device.on_force(device.reported_to, values[0], values[1], values[2]);
}

const char* hdGetString(unsigned what) { return what == hd::kModel ? "Virtual Touch" : ""; }
HdError hdGetError() {
  const HdError error{the_device().error, 0, kHandle};
  the_device().error = 0;
  return error;
}
const char* hdGetErrorString(unsigned code) {
  if (code == kExceededForce) return "Exceeded max force";
  return code == kDeviceFault ? "Device fault" : "Invalid value";
}

void hdStartScheduler() {
  VirtualHd& device = the_device();
  device.running = true;
  if (!device.threaded && palpable::device::library_board() == nullptr) return;
  device.ends = false;
  device.thread = std::thread([&device] {
    while (!device.ends) {
      call();
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
  });
}

void hdStopScheduler() {
  VirtualHd& device = the_device();
  device.ends = true;
  if (device.thread.joinable()) device.thread.join();
  device.running = false;
  if (auto* board = palpable::device::library_board(); board != nullptr) board->hold({});
}

unsigned long hdScheduleAsynchronous(unsigned (*task)(void*), void* data, unsigned short /*priority*/) {
  const std::scoped_lock lock(the_device().mutex);
  the_device().task = task;
  the_device().data = data;
  return 1;
}

void hdUnschedule(unsigned long /*task*/) {
  const std::scoped_lock lock(the_device().mutex);
  the_device().task = nullptr;
}

unsigned hdCheckCalibration() {
  return the_device().fault == LibraryFault::uncalibrated ? hd::kCalibrationNeedsUpdate : hd::kCalibrationOk;
}
void hdUpdateCalibration(unsigned style) { the_device().updated_by = style; }

void virtual_hd_reset() {
  VirtualHd& device = the_device();
  const std::scoped_lock lock(device.mutex);
  device.handle = {};
  device.sensor = {};
  device.force_N = {};
  device.error = 0;
  device.task = nullptr;
  device.enabled = device.opened = device.running = device.threaded = false;
  device.fault = LibraryFault::none;
  device.buttons = 0;
  device.updated_by = 0;
  device.on_force = nullptr;
}
void virtual_hd_run() { the_device().threaded = true; }
void virtual_hd_call() { call(); }
void virtual_hd_inject(int fault) {
  const std::scoped_lock lock(the_device().mutex);
  the_device().fault = static_cast<LibraryFault>(fault);
}
void virtual_hd_pull_to(double x, double y, double z) {
  const std::scoped_lock lock(the_device().mutex);
  the_device().handle.goal_m = {x, y, z};
}
/// Calls `on_force` with each force that is set.
void virtual_hd_report(void (*on_force)(void*, double, double, double), void* data) {
  const std::scoped_lock lock(the_device().mutex);
  the_device().on_force = on_force;
  the_device().reported_to = data;
}
/// The next call of hdGetError() returns this.
void virtual_hd_fail(unsigned code) { fail(code); }
void virtual_hd_press(int buttons) { the_device().buttons = buttons; }
/// The force that the motors hold.
void virtual_hd_force(double* x, double* y, double* z) {
  const std::scoped_lock lock(the_device().mutex);
  const VirtualHd& device = the_device();
  const Vec3 held = device.enabled && device.running && !is_gone() ? device.force_N : Vec3{};
  *x = held.x;
  *y = held.y;
  *z = held.z;
}
int virtual_hd_is_open() { return the_device().opened ? 1 : 0; }
unsigned virtual_hd_updated_by() { return the_device().updated_by; }

}  // extern "C"
