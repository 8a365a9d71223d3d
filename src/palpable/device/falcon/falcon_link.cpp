// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/device/falcon/falcon_link.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace palpable::device {
namespace {

constexpr double kLook_s = 0.0005;

bool is_inside(Vec3 place_m) noexcept {
  const Vec3 from = place_m - falcon::kCentre_m;
  const Vec3 half = 0.5 * falcon::kWorkspace_m;
  return std::abs(from.x) < half.x && std::abs(from.y) < half.y && std::abs(from.z) < half.z;
}

}  // namespace

void FalconLink::exchange() noexcept {
  UsbTransfers::Packet packet{};
  const std::size_t count = usb_.receive(packet, kLook_s);
  now_s_ = usb_.now_s();
  if (count > UsbTransfers::kStatus_bytes) {
    const auto reply = replies_.take(std::span(packet).first(count).subspan(UsbTransfers::kStatus_bytes));
    if (reply) follow(*reply);
  }
  if (!awaited_ || now_s_ - sent_s_ >= kResend_s) send();
}

bool FalconLink::is_plausible(const FalconReply& reply) const noexcept {
  // A hand at 3 m/s turns an arm by at most this much; what goes beyond it was no reply.
  constexpr double kFastest_1_per_s = 160e3;
  constexpr double kLeast = 40.0;
  // However long ago the last one was.
  constexpr double kMost = 1200.0;
  if (!heard_) return true;
  const double most = std::min(kMost, kLeast + kFastest_1_per_s * (now_s_ - heard_s_));
  for (std::size_t k = 0; k < 3; ++k)
    if (std::abs(static_cast<double>(reply.counts[k] - counts_[k])) > most) return false;
  return true;
}

void FalconLink::follow(const FalconReply& reply) noexcept {
  awaited_ = false;
  // Homing sets the counts anew.
  const bool homed = reply.is_homed();
  if (homed != homed_.load(std::memory_order_relaxed)) heard_ = false;
  if (!is_plausible(reply)) return;
  counts_ = reply.counts;
  heard_s_ = now_s_;
  heard_ = true;
  homed_.store(homed, std::memory_order_relaxed);
  for (std::size_t k = 0; k < 3; ++k) angles_[k] = arm_angle(counts_[k]);
  auto place = falcon::place_of(angles_, place_m_);
  if (!place) place = falcon::place_of(angles_);
  has_place_ = place.has_value();
  if (place) place_m_ = *place;
  const bool counts_mean_places = homed && has_place_;
  if (still_.follow({angles_[0], angles_[1], angles_[2]}, counts_mean_places && is_inside(place_m_)))
    stuck_.store(true, std::memory_order_relaxed);
  if (has_place_ || !homed) states.put({place_m_, reply.buttons(), homed});
}

std::array<int, 3> FalconLink::words_for(Vec3 force_N) const noexcept {
  const auto torques = falcon::torques(angles_, place_m_, force_N);
  return torques ? motor_words(*torques) : std::array<int, 3>{};
}

void FalconLink::send() noexcept {
  const bool homed = homed_.load(std::memory_order_relaxed);
  const auto taken =
      forces.take(now_s_ - last_s_, homed && heard_ && has_place_ && now_s_ - heard_s_ < kPatience_s &&
                                        !stuck_.load(std::memory_order_relaxed));
  last_s_ = now_s_;
  FalconCommand command;
  command.lights =
      homed ? FalconCommand::kGreen : static_cast<std::uint8_t>(FalconCommand::kRed | FalconCommand::kHoming);
  if (taken.valid) command.motors = words_for(taken.command);
  if (!usb_.send(falcon_packet(command))) return;
  awaited_ = true;
  sent_s_ = now_s_;
  forces.sent(taken);
}

}  // namespace palpable::device
