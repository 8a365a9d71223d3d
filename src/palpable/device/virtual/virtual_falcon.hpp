// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/device/transport/usb_transfers.hpp"
#include "palpable/device/virtual/moved_handle.hpp"

#include <array>
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <random>
#include <vector>

namespace palpable::device {

/// A Falcon behind the transfers of its USB chip, for tests, in simulated time that passes in receive(): boot
/// program, firmware that is loaded, packets parsed by its own code, homing, a grip on a hand's spring,
/// encoders in whole counts, and the chip's packets with two bytes of status at each millisecond. Its motors
/// hold the last command, which is the worst that a device can do.
class VirtualFalcon {
 public:
  enum class Fault : std::uint8_t {
    none,
    /// Takes commands and replies nothing.
    silent,
    /// Replies with random bytes.
    garbage,
    /// Replies with the first half of a reply.
    short_packets,
    /// Replies come in pairs, the newer one first.
    reordered,
    /// Every second reply is missing.
    dropped,
    /// Nothing passes in either direction.
    stalled,
    /// An encoder's count that does not change any more.
    stuck_encoder,
    /// Encoders turned by so much that the arms cannot be so.
    wrong_calibration,
    unplugged
  };
  struct Options {
    bool firmware_runs = true;
    bool homed = true;
    /// Echoes of the boot program that come back changed, after so many good ones.
    int wrong_echoes = 0;
    int good_echoes = 0;
    /// Whether a boot program answers.
    bool boots = true;
    std::vector<std::byte> firmware{};
  };

  explicit VirtualFalcon(Options options);
  VirtualFalcon() : VirtualFalcon(Options{}) {}

  /// The transfers of the driver; the virtual device must live longer.
  std::unique_ptr<UsbTransfers> plug_in();

  /// Called at each step of a tenth of a millisecond.
  std::function<void()> on_step;
  /// Called after each command, when its motors hold it.
  std::function<void()> on_command;

  void inject(Fault fault) { fault_ = fault; }
  void pull_to(Vec3 goal_m) { grip_.goal_m = goal_m; }
  void press(std::uint8_t buttons) { buttons_ = buttons; }
  /// The person has moved all arms through their stops.
  void home() { homed_ = true; }
  const std::array<int, 3>& motors() const { return motors_; }
  bool is_free() const { return motors_ == std::array<int, 3>{}; }
  std::uint8_t lights() const { return lights_; }
  Vec3 grip_m() const { return grip_.position_m; }
  std::array<int, 3> counts() const;
  /// The force of its motors on the grip, N.
  Vec3 force_N() const;
  double now_s() const { return now_s_; }
  std::uint64_t commands() const { return commands_; }
  const std::vector<std::byte>& loaded() const { return image_; }
  /// Bytes that were no command of the firmware.
  std::uint64_t strange_bytes() const { return strange_; }

 private:
  class Transfers;
  enum class State : std::uint8_t { boot, greeted, loading, running, dead };

  bool control(std::uint8_t request, std::uint16_t value);
  bool send(std::span<const std::byte> bytes);
  std::size_t receive(UsbTransfers::Packet& packet, double longest_s);
  void step();
  void boot_with(std::span<const std::byte> bytes);
  void set_baud(std::uint16_t divisor);
  void take_command();
  void reply();
  std::vector<std::byte> reply_packet();
  void queue(std::span<const std::byte> bytes) { line_.insert(line_.end(), bytes.begin(), bytes.end()); }

  Options options_;
  State state_;
  Fault fault_ = Fault::none;
  bool homed_;
  double now_s_ = 0.0;
  double latency_s_ = 0.001;
  double packet_s_ = 0.0;
  std::uint16_t baud_ = 0;
  bool dtr_ = false;
  MovedHandle grip_;
  std::uint8_t buttons_ = 0;
  std::uint8_t lights_ = 0;
  std::array<int, 3> motors_{};
  int stuck_count_ = 0;
  std::vector<std::byte> command_;
  std::vector<std::byte> image_;
  std::vector<std::byte> kept_reply_;
  std::deque<std::byte> line_;
  std::uint64_t commands_ = 0;
  std::uint64_t strange_ = 0;
  std::mt19937 random_{7};
};

}  // namespace palpable::device
