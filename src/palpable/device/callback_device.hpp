// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/device/device.hpp"

#include <functional>
#include <utility>

namespace palpable::device {

/// A device made of two functions, for hardware that a program drives itself and for simulations. The servo's
/// thread calls both once per tick, `read` first. They must not throw. They should neither allocate nor lock,
/// so that the tick keeps its deadline.
class CallbackDevice final : public Device {
 public:
  using Read = std::function<Reading()>;
  using Write = std::function<void(Vector<DeviceFrame> force_N)>;

  /// Neither function may be empty.
  CallbackDevice(Traits traits, Read read, Write write)
      : traits_(std::move(traits)), read_(std::move(read)), write_(std::move(write)) {}
  ~CallbackDevice() override { write_({}); }
  CallbackDevice(const CallbackDevice&) = delete;
  CallbackDevice& operator=(const CallbackDevice&) = delete;

  const Traits& traits() const noexcept override { return traits_; }
  Reading read() noexcept override { return read_(); }
  void write(Vector<DeviceFrame> force_N) noexcept override { write_(force_N); }
  void stop() noexcept override { write_({}); }

 private:
  Traits traits_;
  Read read_;
  Write write_;
};

}  // namespace palpable::device
