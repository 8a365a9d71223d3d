// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/device/pointer/pointer.hpp"

#include "palpable/device/url.hpp"

#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

namespace palpable::device {
namespace {

constexpr double kSilence_s = 0.5;
constexpr double kFollow_rad_per_s = 2.0 * std::numbers::pi * 12.0;

}  // namespace

PointerDevice::PointerDevice(std::shared_ptr<PointerFeed> feed, double rate_hz)
    : feed_(std::move(feed)), period_s_(1.0 / rate_hz) {
  traits_.name = "pointer";
  traits_.max_force_N = 5.0;
  traits_.rate_hz = rate_hz;
  traits_.pushes_back = false;
  traits_.may_rest = true;
}

Reading PointerDevice::read() noexcept {
  std::optional<Point<DeviceFrame>> place;
  silence_s_ += period_s_;
  if (feed_->take(place)) {
    if (!place) began_ = false;
    if (place && is_finite(*place)) follow(place->v);
  }
  Reading reading;
  if (!began_) {
    reading.status = Status::not_ready;
    return reading;
  }
  // Exact step of x'' = w²(target - x) - 2w·x' for a target that is constant during the tick.
  const double decay = std::exp(-kFollow_rad_per_s * period_s_);
  const Vec3 off = position_m_ - target_m_;
  const Vec3 slope = velocity_m_per_s_ + kFollow_rad_per_s * off;
  position_m_ = target_m_ + decay * (off + period_s_ * slope);
  velocity_m_per_s_ = decay * (velocity_m_per_s_ - (kFollow_rad_per_s * period_s_) * slope);
  reading.position.v = position_m_;
  if (silence_s_ > kSilence_s) reading.status = Status::stale;
  return reading;
}

void PointerDevice::follow(Vec3 place_m) noexcept {
  silence_s_ = 0.0;
  target_m_ = place_m;
  if (began_) return;
  began_ = true;
  position_m_ = place_m;
  velocity_m_per_s_ = {};
}

Result<std::unique_ptr<Device>> open_pointer(DeviceUrl& url, const OpenOptions& options) {
  if (auto valid = url.finish(); !valid) return std::move(valid).error();
  if (!url.path().empty())
    return Error{ErrorCode::usage, "there is only one pointer, the page's: pointer: takes no name",
                 "pointer"};
  if (options.pointer == nullptr)
    return Error{ErrorCode::usage,
                 "needs the page: without one there is no pointer (sim: explores by itself)", "pointer"};
  return std::unique_ptr<Device>(std::make_unique<PointerDevice>(options.pointer, options.rate_hz));
}

}  // namespace palpable::device
