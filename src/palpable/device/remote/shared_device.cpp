// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/device/remote/shared_device.hpp"

#include <chrono>
#include <utility>

namespace palpable::device {

SharedDevice::SharedDevice(std::unique_ptr<Device> device, std::shared_ptr<SharedExchange> exchange,
                           std::shared_ptr<CurrentSurface> current, std::function<double()> now_s)
    : device_(std::move(device)),
      exchange_(std::move(exchange)),
      current_(std::move(current)),
      now_s_(std::move(now_s)) {
  *current_ = {};
}

bool SharedDevice::take_surface(double now_s) noexcept {
  const double newest_read_at_s = current_->surface.read_at_s;
  LocalSurface next;
  if (exchange_->surfaces.take(next)) {
    // Of two surfaces the one of the newer reading holds; none is of a reading that is still to come.
    const bool is_newer =
        !has_surface_ || next.kind == LocalSurface::Kind::none || next.read_at_s >= newest_read_at_s;
    if (is_newer && next.read_at_s <= now_s) {
      current_->surface = next;
      has_surface_ = true;
      came_at_s_ = now_s;
    }
  }
  if (!exchange_->connected.load(std::memory_order_acquire)) has_surface_ = false;
  return has_surface_ && current_->surface.kind != LocalSurface::Kind::none &&
         now_s - came_at_s_ <= kSilent_s && now_s - current_->surface.read_at_s <= kOldest_s;
}

Reading SharedDevice::read() noexcept {
  Reading reading = device_->read();
  const double now_s = now_s_();
  exchange_->readings.put({now_s, reading.position, reading.status, reading.buttons});
  current_->is_usable = take_surface(now_s);
  if (reading.status == Status::ok && !current_->is_usable)
    reading.status = has_surface_ ? Status::stale : Status::not_ready;
  return reading;
}

std::optional<ZeroWrite> SharedDevice::zero_write() const {
  const auto* guardable = dynamic_cast<const Guardable*>(device_.get());
  return guardable != nullptr ? guardable->zero_write() : std::nullopt;
}

double shared_clock_s() {
  using Clock = std::chrono::steady_clock;
  static const auto kBegin = Clock::now();
  return std::chrono::duration<double>(Clock::now() - kBegin).count();
}

}  // namespace palpable::device
