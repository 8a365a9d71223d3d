// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/device/device.hpp"
#include "palpable/device/open_options.hpp"

#include <memory>

namespace palpable::device {

class DeviceUrl;

/// The page's pointer, finger, pen or arrow keys as a device without motors. Positions arrive about sixty
/// times per second. Between them the probe moves smoothly (a critically damped follower of 12 Hz), so that a
/// law does not see jumps of several millimetres. Not ready before the first position and after the pointer
/// was removed; stale if none arrived for half a second (the page repeats the position of a resting pointer).
class PointerDevice final : public Device {
 public:
  PointerDevice(std::shared_ptr<PointerFeed> feed, double rate_hz);

  const Traits& traits() const noexcept override { return traits_; }
  Reading read() noexcept override;
  void write(Vector<DeviceFrame>) noexcept override {}
  void stop() noexcept override {}

 private:
  void follow(Vec3 place_m) noexcept;

  Traits traits_;
  std::shared_ptr<PointerFeed> feed_;
  double period_s_;
  Vec3 target_m_;
  Vec3 position_m_;
  Vec3 velocity_m_per_s_;
  double silence_s_ = 0.0;
  bool began_ = false;
};

/// Opens `pointer:`. Errors (usage): any option; a session without a page.
Result<std::unique_ptr<Device>> open_pointer(DeviceUrl& url, const OpenOptions& options);

}  // namespace palpable::device
