// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/haptics/tick/tick.hpp"

#include <cstdint>

// For tests.
namespace palpable::session {

/// Computes the ticks of a touch again from its recorded readings and times, by the same pipeline without a
/// device: the written forces must be equal to the last bit. The touch must have one scene.
class OfflineTicks {
 public:
  OfflineTicks(const device::Traits& traits, const haptics::HapticScene& scene,
               const haptics::TickOptions& options)
      : reader_(traits), scene_(scene), tick_(reader_, scene_, options, events_) {}

  void step(const haptics::TouchSample& recorded) {
    reader_.next = {recorded.device_position, recorded.status, recorded.buttons, recorded.device_rotation,
                    device::RecordedTime{recorded.t_s, recorded.dt_s, recorded.flags}};
    const haptics::TouchSample& again = tick_.step(recorded.t_s, recorded.dt_s);
    ++ticks_;
    if (again.written_force_N != recorded.written_force_N || again.raw_force_N != recorded.raw_force_N)
      ++differing_;
    while (events_.take()) {
    }
  }
  std::uint64_t ticks() const { return ticks_; }
  std::uint64_t differing() const { return differing_; }

 private:
  struct Reader final : device::Device {
    explicit Reader(const device::Traits& recorded) : own(recorded) {}
    const device::Traits& traits() const noexcept override { return own; }
    device::Reading read() noexcept override { return next; }
    void write(Vector<DeviceFrame> /*force_N*/) noexcept override {}
    void stop() noexcept override {}
    device::Traits own;
    device::Reading next;
  };
  Reader reader_;
  haptics::HapticScene scene_;
  Ring<haptics::TouchEvent> events_{1024};
  haptics::TickPipeline tick_;
  std::uint64_t ticks_ = 0;
  std::uint64_t differing_ = 0;
};

}  // namespace palpable::session
