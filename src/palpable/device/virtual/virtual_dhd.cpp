// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// A double of Force Dimension's library for tests, with one device: each force moves its handle by 1 ms. The
// virtual_dhd_ functions are for the test. All calls come from one thread.
#include "palpable/device/virtual/library_board.hpp"
#include "palpable/device/virtual/moved_handle.hpp"

#include <optional>

namespace {

using palpable::Vec3;
using palpable::device::LibraryFault;
using palpable::device::VendorCall;

struct VirtualDhd {
  palpable::device::MovedHandle handle;
  palpable::device::LibrarySensor sensor;
  // In the vendor's frame: x towards the user, y to the right, z up.
  Vec3 force_N;
  bool enabled = false;
  bool opened = false;
  bool initialised = false;
  LibraryFault fault = LibraryFault::none;
  int buttons = 0;
  void (*on_force)(void*, double, double, double) = nullptr;
  void* data = nullptr;
};

VirtualDhd& the_device() {
  static VirtualDhd device;
  return device;
}

bool is_gone() {
  const auto fault = the_device().fault;
  return fault == LibraryFault::unplugged || fault == LibraryFault::absent;
}

void hold(Vec3 force_N) {
  the_device().force_N = force_N;
  if (auto* board = palpable::device::library_board(); board != nullptr) board->set(force_N);
}

}  // namespace

extern "C" {

int dhdGetDeviceCount() { return is_gone() ? 0 : 1; }

int dhdOpenID(char index) {
  palpable::device::pass(VendorCall::opening);
  if (is_gone() || index != 0) return -1;
  the_device().opened = true;
  return 0;
}

int dhdClose(char /*number*/) {
  palpable::device::pass(VendorCall::closing);
  the_device().opened = false;
  return 0;
}

int dhdStop(char /*number*/) {
  hold({});
  the_device().enabled = false;
  return 0;
}

int dhdEnableForce(unsigned char on, char /*number*/) {
  the_device().enabled = on != 0;
  return is_gone() ? -1 : 0;
}

int dhdGetPosition(double* x, double* y, double* z, char /*number*/) {
  palpable::device::pass(VendorCall::reading);
  VirtualDhd& device = the_device();
  if (auto* board = palpable::device::library_board(); board != nullptr)
    board->goal_m.take(device.handle.goal_m);
  const auto place = is_gone() ? std::nullopt : device.sensor.measure(device.handle, device.fault);
  if (!place) return -1;
  *x = place->x;
  *y = place->y;
  *z = place->z;
  return 0;
}

int dhdSetForce(double x, double y, double z, char /*number*/) {
  palpable::device::pass(VendorCall::forcing);
  VirtualDhd& device = the_device();
  if (is_gone()) return -1;
  hold({x, y, z});
  if (device.on_force != nullptr) device.on_force(device.data, x, y, z);
  device.handle.move(device.enabled ? device.force_N : Vec3{}, 0.001);
  // "Sent too early" is an answer of the real library, and no error.
  return 1;
}

int dhdGetButton(int button, char /*number*/) {
  return (static_cast<unsigned>(the_device().buttons) >> static_cast<unsigned>(button)) & 1U ? 1 : 0;
}

double dhdGetMaxForce(char /*number*/) { return 12.0; }
const char* dhdGetSystemName(char /*number*/) { return "omega.3"; }
const char* dhdErrorGetLastStr() { return is_gone() ? "no device found" : ""; }

int drdAutoInit(char /*number*/) {
  if (the_device().fault == LibraryFault::uncalibrated) return -1;
  the_device().initialised = true;
  return 0;
}

void virtual_dhd_reset() { the_device() = VirtualDhd{}; }
void virtual_dhd_inject(int fault) { the_device().fault = static_cast<LibraryFault>(fault); }
void virtual_dhd_pull_to(double x, double y, double z) { the_device().handle.goal_m = {x, y, z}; }
/// Calls `on_force` with each force that is set.
void virtual_dhd_report(void (*on_force)(void*, double, double, double), void* data) {
  the_device().on_force = on_force;
  the_device().data = data;
}
void virtual_dhd_press(int buttons) { the_device().buttons = buttons; }
/// The force that the motors hold.
void virtual_dhd_force(double* x, double* y, double* z) {
  const VirtualDhd& device = the_device();
  const Vec3 held = device.enabled && !is_gone() ? device.force_N : Vec3{};
  *x = held.x;
  *y = held.y;
  *z = held.z;
}
int virtual_dhd_is_open() { return the_device().opened ? 1 : 0; }
int virtual_dhd_is_initialised() { return the_device().initialised ? 1 : 0; }

}  // extern "C"
