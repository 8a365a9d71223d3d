// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/device/virtual/moved_handle.hpp"

#include <cstdint>
#include <functional>
#include <memory>
#include <string>

namespace palpable::device {

/// The service of an Inverse3 on a WebSocket of the loopback interface, for tests: it lists one device,
/// answers each message by one state, and moves a hand on a spring meanwhile.
class VirtualInverse3 {
 public:
  enum class Fault : std::uint8_t {
    none,
    /// Takes forces and answers nothing.
    silent,
    /// Answers with text that is no JSON.
    garbage,
    /// Answers with the first half of a state.
    short_packets,
    /// Answers with numbers that JSON does not have.
    not_finite,
    /// Answers with 100 000 brackets.
    nested,
    /// Answers with a message of two megabytes.
    huge,
    /// Answers with places metres away.
    far_away,
    /// Answers without the device.
    no_device,
    /// Answers with the place of before the fault.
    stuck,
    /// Answers every second message only.
    dropped,
    /// Answers each second message by the state of before.
    reordered,
    /// Neither reads nor answers.
    stalled,
    /// Hangs up.
    closed
  };
  struct Options {
    /// Called with each force, in the service's frame, by the service's thread.
    std::function<void(Vec3)> on_force{};
    /// Older services take `values`, newer ones `vector`.
    bool takes_values = false;
    bool calibrated = true;
    bool lists_a_device = true;
    /// The first message has this fault already.
    Fault at_first = Fault::none;
  };

  VirtualInverse3() : VirtualInverse3(Options{}) {}
  explicit VirtualInverse3(const Options& options);
  ~VirtualInverse3();
  VirtualInverse3(const VirtualInverse3&) = delete;
  VirtualInverse3& operator=(const VirtualInverse3&) = delete;

  std::uint16_t port() const;
  /// The force that the motors hold, in the service's frame.
  Vec3 force_N() const;
  void pull_to(Vec3 goal_m);
  /// Puts the handle, at rest, where it was at first.
  void hold_at_rest();
  void inject(Fault fault);
  void calibrate();
  std::uint64_t messages() const;
  /// Messages that were no command.
  std::uint64_t strange() const;
  std::string first_message() const;

 private:
  class Server;
  std::unique_ptr<Server> server_;
};

}  // namespace palpable::device
