// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/device/evdev/evdev.hpp"

#include "palpable/device/open_options.hpp"
#include "palpable/device/transport/fresh_reading.hpp"
#include "palpable/device/url.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <system_error>
#include <utility>

#include <unistd.h>

namespace palpable::device {
namespace {

constexpr double kGreatestLevel = 32767.0;
constexpr double kGreatestRumble = 65535.0;

/// The direction in which an effect pushes, as the kernel counts it: 0 towards the user, 0x4000 to the left,
/// 0x8000 away from the user, 0xC000 to the right.
std::uint16_t direction_of(Vec3 force_N) {
  const double turns = std::atan2(-force_N.x, -force_N.y) / (2.0 * std::numbers::pi);
  return static_cast<std::uint16_t>(std::llround((turns - std::floor(turns)) * 65536.0) & 0xFFFF);
}

double in_workspace(int value, std::array<int, 2> range, double size_m) {
  const double share = (static_cast<double>(value) - range[0]) / (static_cast<double>(range[1]) - range[0]);
  return size_m * (std::clamp(share, 0.0, 1.0) - 0.5);
}

}  // namespace

EvdevDevice::EvdevDevice(std::unique_ptr<EventPort> port, const EvdevOptions& options)
    : port_(std::move(port)), options_(options) {
  const EventAbilities& can = port_->abilities();
  traits_.name = can.name.empty() ? "joystick" : can.name;
  traits_.degrees_of_freedom = 2;
  traits_.workspace_m = {options.size_m, options.size_m, 0.05};
  traits_.max_force_N = options.max_force_N;
  traits_.continuous_force_N = continuous_force(options.continuous_force_N, traits_.max_force_N);
  traits_.pushes_back = can.has_constant_force;
  const int steps = std::min(can.range[0][1] - can.range[0][0], can.range[1][1] - can.range[1][0]);
  traits_.position_resolution_m = options.size_m / std::max(1, steps);
  // A period of USB, and the time between two effects.
  traits_.delay_samples = 8;
  traits_.rate_hz = options.rate_hz;
  traits_.sensor_period_s = options.sensor_period_s;
  effect_.id = -1;
  effect_.replay.length = kEffectLasts_ms;
  effect_.type = can.has_constant_force ? FF_CONSTANT : FF_RUMBLE;
  // The kernel reports changes only.
  take_current();
}

EvdevDevice::~EvdevDevice() { send({}); }

void EvdevDevice::take_current() noexcept {
  std::array<input_event, 18> events{};
  const std::size_t count = port_->current(events);
  for (std::size_t k = 0; k < count; ++k) take(events[k]);
}

void EvdevDevice::take(const input_event& event) noexcept {
  if (event.type == EV_SYN && event.code == SYN_DROPPED) {
    lost_events_ = true;
  } else if (event.type == EV_SYN && event.code == SYN_REPORT && std::exchange(lost_events_, false)) {
    take_current();
  }
  if (lost_events_) return;
  const auto& range = port_->abilities().range;
  if (event.type == EV_ABS && event.code == ABS_X)
    reading_.position.v.x = in_workspace(event.value, range[0], options_.size_m);
  // The kernel's Y grows towards the user.
  if (event.type == EV_ABS && event.code == ABS_Y)
    reading_.position.v.y = -in_workspace(event.value, range[1], options_.size_m);
  const auto first = static_cast<unsigned>(port_->abilities().first_button());
  if (event.type != EV_KEY || event.code < first || event.code >= first + 16U) return;
  const std::uint32_t bit = 1U << (event.code - first);
  reading_.buttons = event.value != 0 ? reading_.buttons | bit : reading_.buttons & ~bit;
}

Reading EvdevDevice::read() noexcept {
  std::array<input_event, 32> events{};
  const std::size_t count = port_->read(events);
  for (std::size_t k = 0; k < count; ++k) take(events[k]);
  reading_.status = port_->lost() || refused_s_ > FreshReading::kSilent_s ? Status::fault
                    : refused_s_ > FreshReading::kStale_s                 ? Status::stale
                                                                          : Status::ok;
  return reading_;
}

bool EvdevDevice::send(Vec3 force_N) noexcept {
  const double share = std::min(1.0, std::hypot(force_N.x, force_N.y) / options_.max_force_N);
  const bool pushes = share > 0.0;
  if (!pushes && !pushes_) return true;
  if (effect_.type == FF_CONSTANT) {
    effect_.direction = direction_of(force_N);
    effect_.u.constant.level = static_cast<std::int16_t>(std::lround(kGreatestLevel * share));
  } else {
    effect_.u.rumble.strong_magnitude = static_cast<std::uint16_t>(std::lround(kGreatestRumble * share));
    effect_.u.rumble.weak_magnitude = effect_.u.rumble.strong_magnitude;
  }
  if (!port_->upload(effect_) || !port_->play(effect_.id, pushes)) return false;
  pushes_ = pushes;
  return true;
}

void EvdevDevice::write(Vector<DeviceFrame> force_N) noexcept {
  since_effect_s_ += 1.0 / options_.rate_hz;
  const bool stopped = stopped_.exchange(false);
  const Vec3 force = reading_.status == Status::ok ? force_N.v : Vec3{};
  const bool releases = pushes_ && force.x == 0.0 && force.y == 0.0;
  if (!stopped && !releases && since_effect_s_ < kEffect_s) return;
  if (!send(force)) {
    refused_s_ += 1.0 / options_.rate_hz;
    return;
  }
  since_effect_s_ = 0.0;
  refused_s_ = 0.0;
}

void EvdevDevice::stop() noexcept {
  stopped_ = true;
  if (effect_.id >= 0) port_->play(effect_.id, false);
}

std::string EvdevDevice::fault() const {
  return "the " + traits_.name + (port_->lost() ? " was unplugged" : " takes no forces any more");
}

Result<std::vector<std::string>> evdev_ports() {
  std::vector<std::string> ports;
  int forbidden = 0;
  std::error_code none;
  for (const auto& entry : std::filesystem::directory_iterator("/dev/input", none)) {
    const std::string path = entry.path().string();
    if (!entry.path().filename().string().starts_with("event")) continue;
    if (open_event_port(path)) ports.push_back(path);
    forbidden += ::access(path.c_str(), R_OK | W_OK) != 0 && errno == EACCES ? 1 : 0;
  }
  if (ports.empty() && forbidden > 0)
    return Error{ErrorCode::device,
                 "none of those that may be opened, and " + std::to_string(forbidden) +
                     " input devices may not: join the group input and log in again",
                 "evdev"};
  std::ranges::sort(ports);
  return ports;
}

Result<std::unique_ptr<Device>> open_evdev(DeviceUrl& url, const OpenOptions& options) {
  constexpr double kMillimetre = 1e-3;
  EvdevOptions wanted;
  wanted.max_force_N = url.take_number("max-force", wanted.max_force_N, 0.1, 40.0);
  wanted.continuous_force_N = take_continuous_force(url);
  wanted.sensor_period_s = 1e-3 * url.take_number("sensor-ms", 0.0, 0.0, 100.0);
  wanted.size_m = kMillimetre * url.take_number("size-mm", wanted.size_m / kMillimetre, 10.0, 1000.0);
  wanted.rate_hz = options.rate_hz;
  if (auto valid = url.finish(); !valid) return std::move(valid).error();
  std::string path = url.path();
  if (path.empty()) {
    const auto ports = evdev_ports();
    if (!ports) return ports.error();
    if (ports->empty())
      return Error{ErrorCode::device, "no joystick or gamepad with force feedback is plugged in", "evdev"};
    path = ports->front();
  }
  auto port = open_event_port(path);
  if (!port) return std::move(port).error();
  return std::unique_ptr<Device>(std::make_unique<EvdevDevice>(*std::move(port), wanted));
}

}  // namespace palpable::device
