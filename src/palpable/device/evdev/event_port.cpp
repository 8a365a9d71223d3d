// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/device/evdev/event_port.hpp"

#include "palpable/core/system/child_process.hpp"

#include <atomic>
#include <cerrno>
#include <cstring>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <sys/ioctl.h>
#include <unistd.h>

namespace palpable::device {
namespace {

template <std::size_t kBytes>
bool has_bit(const std::array<unsigned char, kBytes>& bits, unsigned bit) {
  return bit / 8 < kBytes && ((bits[bit / 8] >> (bit % 8)) & 1U) != 0;
}

EventAbilities abilities_of(int descriptor) {
  EventAbilities can;
  std::array<char, 128> name{};
  if (::ioctl(descriptor, EVIOCGNAME(name.size() - 1), name.data()) >= 0) can.name = name.data();
  std::array<unsigned char, ABS_CNT / 8 + 1> axes{};
  std::array<unsigned char, FF_CNT / 8 + 1> forces{};
  ::ioctl(descriptor, EVIOCGBIT(EV_ABS, axes.size()), axes.data());
  ::ioctl(descriptor, EVIOCGBIT(EV_FF, forces.size()), forces.data());
  can.has_axes = has_bit(axes, ABS_X) && has_bit(axes, ABS_Y);
  can.has_constant_force = has_bit(forces, FF_CONSTANT);
  can.has_rumble = has_bit(forces, FF_RUMBLE);
  for (std::size_t k = 0; k < 2; ++k) {
    input_absinfo axis{};
    if (::ioctl(descriptor, EVIOCGABS(k == 0 ? ABS_X : ABS_Y), &axis) < 0 || axis.maximum <= axis.minimum)
      can.has_axes = false;
    can.range[k] = {axis.minimum, axis.maximum};
  }
  return can;
}

class KernelEventPort final : public EventPort {
 public:
  KernelEventPort(Descriptor descriptor, EventAbilities can)
      : descriptor_(std::move(descriptor)), can_(std::move(can)) {}

  const EventAbilities& abilities() const noexcept override { return can_; }

  std::size_t read(std::span<input_event> events) noexcept override {
    const auto bytes = ::read(descriptor_.number(), events.data(), events.size_bytes());
    if (bytes < 0 && errno != EAGAIN && errno != EINTR) lost_ = true;
    return bytes > 0 ? static_cast<std::size_t>(bytes) / sizeof(input_event) : 0;
  }

  std::size_t current(std::span<input_event> events) noexcept override {
    constexpr int kButtons = 16;
    std::size_t count = 0;
    const auto put = [&](int type, int code, int value) {
      events[count] = {};
      events[count].type = static_cast<std::uint16_t>(type);
      events[count].code = static_cast<std::uint16_t>(code);
      events[count++].value = value;
    };
    for (const int axis : {ABS_X, ABS_Y}) {
      input_absinfo now{};
      if (::ioctl(descriptor_.number(), EVIOCGABS(axis), &now) >= 0) put(EV_ABS, axis, now.value);
    }
    std::array<unsigned char, KEY_CNT / 8 + 1> keys{};
    if (::ioctl(descriptor_.number(), EVIOCGKEY(keys.size()), keys.data()) < 0) return count;
    for (int button = can_.first_button(); button < can_.first_button() + kButtons; ++button)
      put(EV_KEY, button, has_bit(keys, static_cast<unsigned>(button)) ? 1 : 0);
    return count;
  }

  bool upload(ff_effect& effect) noexcept override {
    if (::ioctl(descriptor_.number(), EVIOCSFF, &effect) >= 0) return true;
    if (errno == ENODEV) lost_ = true;
    return false;
  }

  bool play(int effect_id, bool on) noexcept override {
    input_event event{};
    event.type = EV_FF;
    event.code = static_cast<std::uint16_t>(effect_id);
    event.value = on ? 1 : 0;
    return ::write(descriptor_.number(), &event, sizeof event) == sizeof event;
  }

  bool lost() const noexcept override { return lost_.load(std::memory_order_relaxed); }

 private:
  Descriptor descriptor_;
  EventAbilities can_;
  std::atomic<bool> lost_{false};
};

}  // namespace

Result<std::unique_ptr<EventPort>> open_event_port(const std::string& path) {
  Descriptor descriptor(::open(path.c_str(), O_RDWR | O_NONBLOCK | O_CLOEXEC));
  if (descriptor.number() < 0) {
    const int failure = errno;
    return Error{ErrorCode::device,
                 failure == EACCES ? "may not be opened: join the group input and log in again"
                                   : "cannot be opened: " + std::system_category().message(failure),
                 path};
  }
  EventAbilities can = abilities_of(descriptor.number());
  if (!can.has_axes) return Error{ErrorCode::device, "is no joystick: it has no axes X and Y", path};
  if (!can.has_constant_force && !can.has_rumble)
    return Error{ErrorCode::device, "has no force feedback", path};
  return std::unique_ptr<EventPort>(std::make_unique<KernelEventPort>(std::move(descriptor), std::move(can)));
}

}  // namespace palpable::device
