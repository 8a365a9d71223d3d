// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/system/hand_off.hpp"
#include "palpable/device/falcon/falcon_kinematics.hpp"
#include "palpable/device/falcon/falcon_wire.hpp"
#include "palpable/device/stuck_encoder.hpp"
#include "palpable/device/transport/force_hand_off.hpp"
#include "palpable/device/transport/usb_transfers.hpp"

#include <atomic>

namespace palpable::device {

/// The exchange of packets with a Falcon: one command for each reply. One thread calls exchange() again and
/// again; the servo's thread puts forces and takes states without waiting. No allocation.
///
/// Motors get zero while the arms are not homed, without a valid force (ForceHandOff), without a believable
/// reply for kPatience_s, where the arms do not determine the place, and after an encoder stood still.
class FalconLink {
 public:
  /// Without a reply for this long there is no force.
  static constexpr double kPatience_s = 0.004;
  /// A command without a reply for this long is sent again, so that one lost reply ends no force.
  static constexpr double kResend_s = 0.002;

  struct State {
    /// In the linkage's frame.
    Vec3 place_m;
    std::uint32_t buttons = 0;
    bool homed = false;
  };

  /// `usb`: its firmware runs (begin_falcon_packets()).
  explicit FalconLink(UsbTransfers& usb) noexcept : usb_(usb), last_s_(usb.now_s()), heard_s_(last_s_) {}

  /// Waits for half a millisecond at most for a packet, and sends a command if one is due.
  void exchange() noexcept;

  LatestValue<State> states;
  ForceHandOff forces;

  // Any thread.
  bool lost() const noexcept { return usb_.lost(); }
  bool is_homed() const noexcept { return homed_.load(std::memory_order_relaxed); }
  /// An encoder stood still; exchange() then sends zero for ever.
  bool is_stuck() const noexcept { return stuck_.load(std::memory_order_relaxed); }

 private:
  void follow(const FalconReply& reply) noexcept;
  bool is_plausible(const FalconReply& reply) const noexcept;
  void send() noexcept;
  std::array<int, 3> words_for(Vec3 force_N) const noexcept;

  UsbTransfers& usb_;
  FalconReplies replies_;
  /// 23 degrees. A stroke, along a wall most of all, holds one arm to a count for long where its way touches
  /// that of a circle of this arm: 13 degrees happened.
  StuckEncoder<3> still_{0.4};
  double now_s_ = 0.0;
  /// The last command; the last believable reply; the last call of take().
  double sent_s_ = -1.0;
  double last_s_;
  double heard_s_;
  bool awaited_ = false;
  bool heard_ = false;
  std::array<int, 3> counts_{};
  ArmAngles angles_{};
  Vec3 place_m_ = falcon::kCentre_m;
  bool has_place_ = false;
  std::atomic<bool> homed_{false};
  std::atomic<bool> stuck_{false};
};

}  // namespace palpable::device
