// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/system/child_process.hpp"
#include "palpable/device/two_diy/two_diy_variant.hpp"

#include <array>
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

namespace palpable::device {

/// A 2DIY behind a pseudo-terminal, for tests: it parses the bytes by itself, holds the last torques as the
/// real board does, and moves a hand on a spring by 1 ms for each message with torques.
class VirtualTwoDiy {
 public:
  enum class Fault : std::uint8_t {
    none,
    /// Answers nothing any more.
    silent,
    /// Answers with random bytes.
    garbage,
    /// Answers with the first half of an answer.
    cut_answers,
    /// Answers with numbers that are none.
    not_finite,
    /// The angles of the last answer again and again.
    stuck,
    /// The first motor's angle does not change any more.
    stuck_encoder,
    /// Angles as after a setup at another place: both links turned by 60 degrees.
    wrong_calibration,
    /// Answers every second message only.
    dropped,
    /// Answers each second message by an angle of before.
    reordered,
    /// Neither reads nor answers.
    stalled,
    /// The port hangs up.
    unplugged
  };

  explicit VirtualTwoDiy(const TwoDiyVariant& variant, bool ordered_by_motor = false);
  ~VirtualTwoDiy();
  VirtualTwoDiy(const VirtualTwoDiy&) = delete;
  VirtualTwoDiy& operator=(const VirtualTwoDiy&) = delete;

  /// The serial port.
  const std::string& path() const { return path_; }
  /// Torques of the motors on ports 1 and 2 now, N m.
  std::array<float, 2> torques() const;
  /// The force on the handle that these make, in the pantograph's plane, N.
  InPlane force_N() const;
  InPlane handle() const;
  /// The last setup message.
  std::vector<std::uint8_t> setup() const;
  /// Waits, for 20 s at most, until it has handled so many messages with torques.
  void wait_for(std::uint64_t messages) const;
  /// Waits until the motors are free; false: not within 20 s.
  [[nodiscard]] bool wait_until_free() const;
  std::uint64_t messages() const;
  /// Bytes that began no message, and torques that were no numbers.
  std::uint64_t strange() const;
  /// Where the hand wants to be, in the pantograph's plane.
  void pull_to(InPlane goal);
  void inject(Fault fault);
  /// Called with the force of each message's torques, where the handle is then; set it before the port is
  /// opened.
  std::function<void(InPlane)> on_force;
  /// The same with the torques of the first and second motor, N m.
  std::function<void(std::array<double, 2>)> on_torques;

 private:
  void run();
  bool read_into(std::uint8_t* bytes, std::size_t count);
  bool take_setup();
  bool take_torques(std::uint8_t id);
  bool is_swapped() const { return !ordered_by_motor_ && variant_.joints[0].port != 1; }
  std::array<double, 2> torques_by_motor() const;
  void move();
  void answer(std::uint8_t id);

  const TwoDiyVariant& variant_;
  const bool ordered_by_motor_;
  std::string path_;
  Descriptor terminal_;
  /// Keeps the port there while nobody else has it open.
  Descriptor port_;

  mutable std::mutex mutex_;
  mutable std::condition_variable changed_;
  std::array<float, 2> torques_{};
  std::vector<std::uint8_t> setup_;
  InPlane place_;
  InPlane velocity_;
  InPlane goal_;
  std::array<float, 2> last_answer_{};
  /// What was answered last, and before.
  std::array<float, 2> newest_answer_{};
  std::array<float, 2> older_answer_{};
  std::uint64_t messages_ = 0;
  std::uint64_t strange_ = 0;
  Fault fault_ = Fault::none;
  bool ended_ = false;
  std::thread thread_;
};

}  // namespace palpable::device
