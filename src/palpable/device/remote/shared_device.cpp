// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/device/remote/shared_device.hpp"

#include <algorithm>
#include <chrono>
#include <utility>

namespace palpable::device {

SharedDevice::SharedDevice(std::unique_ptr<Device> device, std::shared_ptr<SharedExchange> exchange,
                           std::shared_ptr<CurrentSurface> current, std::function<double()> now_s)
    : device_(std::move(device)),
      exchange_(std::move(exchange)),
      current_(std::move(current)),
      now_s_(std::move(now_s)),
      session_(exchange_->sessions.load(std::memory_order_relaxed)),
      delay_(static_cast<std::size_t>(
          std::clamp(device_->traits().delay_samples, 0, static_cast<int>(kMostDelay)))) {
  // The account goes on where a device is opened again.
  current_->surface = {};
  current_->is_usable = false;
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
      PotentialAccount& potential = current_->account.potential;
      if (next.kind == LocalSurface::Kind::slope)
        potential.note(next.read_at_s, next.stored_J);
      else
        potential.forget();
    }
  }
  if (!exchange_->connected.load(std::memory_order_acquire)) has_surface_ = false;
  return has_surface_ && current_->surface.kind != LocalSurface::Kind::none &&
         now_s - came_at_s_ <= kSilent_s && now_s - current_->surface.read_at_s <= kOldest_s;
}

void SharedDevice::write(Vector<DeviceFrame> force_N) noexcept {
  newest_ = (newest_ + 1) % sent_N_.size();
  sent_N_[newest_] = force_N.v;
  device_->write(force_N);
}

void SharedDevice::count_work(const Reading& reading, double now_s) noexcept {
  // A place farther from the last one is no movement of a hand, and pays for nothing.
  constexpr double kFarthest_m = 0.02;
  const std::uint32_t session = exchange_->sessions.load(std::memory_order_acquire);
  if (std::exchange(session_, session) != session) current_->account = {};
  const bool is_known = reading.status == Status::ok && is_finite(reading.position);
  const std::optional<Vec3> before_m =
      std::exchange(place_m_, is_known ? std::optional(reading.position.v) : std::nullopt);
  if (!before_m || !place_m_) return;
  const Vec3 moved_m = *place_m_ - *before_m;
  const Vec3 held_N = sent_N_[(newest_ + sent_N_.size() - delay_) % sent_N_.size()];
  if (norm(moved_m) <= kFarthest_m && is_finite(held_N)) current_->account.add(dot(held_N, moved_m), now_s);
}

Reading SharedDevice::read() noexcept {
  Reading reading = device_->read();
  const double now_s = now_s_();
  count_work(reading, now_s);
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
