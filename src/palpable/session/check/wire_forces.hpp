// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/vec3.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <mutex>
#include <vector>

// For tests.
namespace palpable::session {

/// Compares the forces that a virtual device received with those that the servo wrote. A driver may send a
/// force again, leave one out, or send zero where it withholds one; it may not change one by more than a step
/// of its wire, nor their order.
class WireForces {
 public:
  explicit WireForces(double step_N) : step_N_(step_N) {}

  /// By the device's thread.
  void receive(Vec3 force_N) {
    const std::lock_guard lock(mutex_);
    received_.push_back(force_N);
  }
  void wrote(Vec3 force_N) { written_.push_back(force_N); }

  /// What was received until now is compared next. Call it before the servo's newest forces are taken: while
  /// this thread waits for the processor, more may come that no written force is known for.
  void mark() {
    const std::lock_guard lock(mutex_);
    marked_ = received_.size();
  }
  /// Matches what was received before the last mark(), or everything at the end. The newest forces are left,
  /// since what the servo wrote is known a little later than to the device.
  void compare(bool at_end) {
    std::vector<Vec3> got;
    {
      const std::lock_guard lock(mutex_);
      const std::size_t known = at_end ? received_.size() : marked_ - std::min(kLeft, marked_);
      got.assign(received_.begin(), received_.begin() + static_cast<std::ptrdiff_t>(known));
      received_.erase(received_.begin(), received_.begin() + static_cast<std::ptrdiff_t>(known));
      marked_ -= std::min(marked_, known);
    }
    for (const Vec3 force : got) match(force);
  }
  std::uint64_t matched() const { return matched_; }
  std::uint64_t withheld() const { return withheld_; }
  std::uint64_t different() const { return different_; }
  double max_difference_N() const { return max_difference_N_; }
  std::uint64_t with_force() const { return with_force_; }

 private:
  static constexpr std::size_t kLeft = 400;
  /// How many written forces are searched: a device on a busy machine may be seconds behind, and a spell in
  /// the air is as many equal ones.
  static constexpr std::size_t kSkipped = 5000;
  static constexpr std::size_t kNear = 20;

  void match(Vec3 force_N) {
    if (force_N == Vec3{}) {
      // Zero is written for long spells, and may be sent without having been written: it tells nothing of
      // how far the device is.
      const auto near = written_.begin() + static_cast<std::ptrdiff_t>(std::min(kNear, written_.size()));
      const bool was_written = std::find(written_.begin(), near, Vec3{}) != near;
      ++(was_written ? matched_ : withheld_);
      return;
    }
    const std::size_t most = std::min(kSkipped, written_.size());
    const auto off_N = [&](std::size_t k) { return norm(written_[k] - force_N); };
    for (std::size_t k = 0; k < most; ++k) {
      if (off_N(k) > step_N_) continue;
      // A slowly changing force: the nearest one of those that follow.
      while (k + 1 < most && off_N(k + 1) < off_N(k)) ++k;
      max_difference_N_ = std::max(max_difference_N_, off_N(k));
      written_.erase(written_.begin(), written_.begin() + static_cast<std::ptrdiff_t>(k));
      ++with_force_;
      ++matched_;
      return;
    }
    ++different_;
  }

  double step_N_;
  std::mutex mutex_;
  std::size_t marked_ = 0;
  std::deque<Vec3> received_;
  std::deque<Vec3> written_;
  std::uint64_t matched_ = 0;
  std::uint64_t withheld_ = 0;
  std::uint64_t different_ = 0;
  std::uint64_t with_force_ = 0;
  double max_difference_N_ = 0.0;
};

}  // namespace palpable::session
