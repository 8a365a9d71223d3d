// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>

namespace palpable::device {

/// What late slopes may give to a hand so that they give no more than the scene's potential, J. Each slope
/// states the potential where the hand was when it was read, W(s) + U(s) with the work W on the hand until
/// then. A passive scene gives nothing beyond the least of these, above the lowest potential that was stated.
/// What the hand has passed since the reading is not known: a slope that is older than kFresh_s gives less,
/// and from kOld_s on nothing, it only resists. Tick path.
class PotentialAccount {
 public:
  static constexpr double kFresh_s = 0.05;
  static constexpr double kOld_s = 0.07;

  /// Work on the hand since the last call, with the present time, seconds.
  void add(double work_J, double now_s) noexcept {
    work_J_ += work_J;
    now_s_ = now_s;
    constexpr double kShortest_s = 6e-4;
    if (now_s < done_[newest_].at_s + kShortest_s) return;
    newest_ = (newest_ + 1) % done_.size();
    done_[newest_] = {now_s, work_J_};
  }
  /// The potential at the reading of that time.
  void note(double read_at_s, double stored_J) noexcept {
    read_at_s_ = read_at_s;
    lowest_J_ = std::min(lowest_J_, stored_J);
    least_J_ = std::min(least_J_, work_until(read_at_s) + stored_J);
  }
  /// Another surface, whose potential cannot be compared.
  void forget() noexcept { lowest_J_ = least_J_ = std::numeric_limits<double>::infinity(); }
  double left_J() const noexcept {
    if (!(least_J_ < std::numeric_limits<double>::infinity())) return 0.0;
    const double age_s = now_s_ - read_at_s_;
    return std::clamp((kOld_s - age_s) / (kOld_s - kFresh_s), 0.0, 1.0) * (least_J_ - lowest_J_ - work_J_);
  }

 private:
  struct Done {
    double at_s = 0.0;
    double work_J = 0.0;
  };
  double work_until(double time_s) const noexcept {
    std::size_t age = 0;
    const auto of = [this](std::size_t ticks) {
      return done_[(newest_ + done_.size() - ticks) % done_.size()];
    };
    while (age + 1 < done_.size() && of(age).at_s > time_s) ++age;
    return of(age).work_J;
  }

  /// Longer than surfaces are used (SharedDevice::kOldest_s).
  std::array<Done, 512> done_{};
  std::size_t newest_ = 0;
  double work_J_ = 0.0;
  double now_s_ = 0.0;
  double read_at_s_ = 0.0;
  double lowest_J_ = std::numeric_limits<double>::infinity();
  double least_J_ = std::numeric_limits<double>::infinity();
};

}  // namespace palpable::device
