// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/frame.hpp"

#include <algorithm>
#include <cmath>

namespace palpable::haptics {

/// A force after a limit was applied, and whether the limit changed it.
template <class Frame>
struct Limited {
  Vector<Frame> force_N;
  bool limited = false;
};

/// Limits the magnitude to `max_N` (>= 0) and keeps the direction. Tick path.
template <class Frame>
Limited<Frame> cap_force(Vector<Frame> force_N, double max_N) noexcept {
  const double size = norm(force_N);
  return size > max_N ? Limited<Frame>{(max_N / size) * force_N, true} : Limited<Frame>{force_N, false};
}

/// The force that may be written, whatever was computed: `force_N`, at most `max_N` long; zero if it is not
/// finite or `max_N` is not above 0. Tick path.
template <class Frame>
Vector<Frame> bounded(Vector<Frame> force_N, double max_N) noexcept {
  if (!is_finite(force_N) || !(max_N > 0.0)) return {};
  // A component that is too large for its square gives a length that is not finite, and no force.
  return cap_force(force_N, max_N).force_N;
}

/// Lets a force grow by at most `max_rise_N` (>= 0) from one tick to the next. A decrease is never delayed:
/// the part of `before_N` that the new force does not contain is dropped at once. Only the part that is new
/// is limited, also when the direction turns at constant magnitude. Tick path.
template <class Frame>
Limited<Frame> cap_rise(Vector<Frame> force_N, Vector<Frame> before_N, double max_rise_N) noexcept {
  const double size = norm(before_N);
  const Vector<Frame> along = size > 0.0 ? (1.0 / size) * before_N : Vector<Frame>{};
  const Vector<Frame> kept = std::clamp(dot(force_N, along), 0.0, size) * along;
  const Limited<Frame> risen = cap_force(force_N - kept, max_rise_N);
  return risen.limited ? Limited<Frame>{kept + risen.force_N, true} : Limited<Frame>{force_N, false};
}

/// The same for the force on a hand that moves at `velocity`: what is kept of the last force gives the hand
/// no more power than the wanted force does. Where a force turns faster than it may grow, its old direction
/// would push the hand on after the law has ended that push. The new part first turns the force away from the
/// movement; what is kept is shortened only if that is not enough, since a hand that moves across its force
/// would lose nearly all of it for a power that is nearly zero. The result is never longer than without the
/// velocity. At most `most_lost` of what is kept, 0 ... 1, is shortened: in a tick that is much shorter than
/// the period hardly anything may grow, and without it such a tick would take the whole force. Tick path.
template <class Frame>
Limited<Frame> cap_rise(Vector<Frame> force_N, Vector<Frame> before_N, double max_rise_N,
                        Vector<Frame> velocity, double most_lost = 1.0) noexcept {
  Limited<Frame> risen = cap_rise(force_N, before_N, max_rise_N);
  if (!risen.limited) return risen;
  const double allowed_W = std::max(0.0, dot(force_N, velocity));
  const double size = norm(before_N);
  if (!(dot(risen.force_N, velocity) > allowed_W) || !(size > 0.0)) return risen;
  const Vector<Frame> along = (1.0 / size) * before_N;
  Vector<Frame> kept = std::clamp(dot(force_N, along), 0.0, size) * along;
  // Above 0: only what is kept can give more than the wanted force.
  const double kept_W = dot(kept, velocity);
  if (!(kept_W > 0.0)) return risen;
  Vector<Frame> grown = risen.force_N - kept;
  const Vector<Frame> across = velocity - dot(velocity, along) * along;
  if (const double across_m_per_s = norm(across); across_m_per_s > 0.0) {
    const Vector<Frame> side = (1.0 / across_m_per_s) * across;
    const Vector<Frame> other = grown - dot(grown, side) * side;
    const double sideways_N =
        std::max(-max_rise_N, (allowed_W - kept_W - dot(other, velocity)) / across_m_per_s);
    const double left_N = std::sqrt(std::max(0.0, max_rise_N * max_rise_N - sideways_N * sideways_N));
    grown = cap_force(other, left_N).force_N + sideways_N * side;
  }
  const double excess_W = kept_W + dot(grown, velocity) - allowed_W;
  if (excess_W > 0.0) kept = (1.0 - std::min(most_lost, excess_W / kept_W)) * kept;
  risen.force_N = kept + grown;
  return risen;
}

/// A factor 0 ... 1 that moves linearly towards 0 or 1. The force is multiplied by it at start, pause and
/// fault.
class Ramp {
 public:
  /// Times in seconds from 1 to 0 and from 0 to 1, both > 0. The factor begins at 0.
  Ramp(double down_s, double up_s) : down_s_(down_s), up_s_(up_s), next_up_s_(up_s) {}

  /// The factor after `dt_s`; it rises towards 1 while `wanted`, else it falls towards 0. It stays where it
  /// is in a step that is not above 0. Tick path.
  double step(bool wanted, double dt_s) noexcept {
    if (!(dt_s > 0.0)) return value_;
    value_ = wanted ? std::min(1.0, value_ + dt_s / next_up_s_) : std::max(0.0, value_ - dt_s / down_s_);
    if (!wanted || value_ >= 1.0) next_up_s_ = up_s_;
    return value_;
  }
  /// To 1 at once: for a hand in free air, where the force is 0 anyway.
  void finish() noexcept {
    value_ = 1.0;
    next_up_s_ = up_s_;
  }
  /// To 0 at once; the next rise takes the time from 0 to 1, or `up_s` > 0 if that is shorter.
  void reset() noexcept { reset(up_s_); }
  void reset(double up_s) noexcept {
    value_ = 0.0;
    next_up_s_ = std::min(up_s, up_s_);
  }
  double value() const noexcept { return value_; }
  /// How long a rise from 0 to 1 takes now, s.
  double up_s() const noexcept { return next_up_s_; }

 private:
  double down_s_;
  double up_s_;
  double next_up_s_;
  double value_ = 0.0;
};

}  // namespace palpable::haptics
