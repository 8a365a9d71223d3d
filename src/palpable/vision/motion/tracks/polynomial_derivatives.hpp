// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>

// Inside vision's sources only.
namespace palpable::vision {

struct Derivatives {
  double first = 0.0, second = 0.0;
};

inline constexpr std::size_t kMostNodes = 5;

/// The derivatives at time 0 of the polynomial through values at times, which all differ (Newton's divided
/// differences). Up to kMostNodes; zero for fewer than two. Allocates nothing.
inline Derivatives derivatives_at_zero(std::span<const double> times, std::span<const double> values) {
  std::array<double, kMostNodes> differences{};
  std::copy(values.begin(), values.end(), differences.begin());
  for (std::size_t order = 1; order < times.size(); ++order)
    for (std::size_t i = times.size() - 1; i >= order; --i)
      differences[i] = (differences[i] - differences[i - 1]) / (times[i] - times[i - order]);
  Derivatives out;
  double value = 0.0;
  for (std::size_t i = times.size(); i-- > 0;) {
    out.second = -times[i] * out.second + 2 * out.first;
    out.first = -times[i] * out.first + value;
    value = -times[i] * value + differences[i];
  }
  return out;
}

/// The frames around one through whose values such a polynomial goes: up to two on each side of those that
/// `is_known(frame)` has values of. The frame itself is only one of them where all others are on one side:
/// the movement must not depend on its own noise, which a wrong readout could else remove.
struct NodeFrames {
  std::array<int, kMostNodes> frames{};
  std::array<double, kMostNodes> times{};
  std::size_t count = 0;
};

template <class IsKnown>
NodeFrames node_frames(int frame, std::span<const int> frame_numbers, const IsKnown& is_known) {
  NodeFrames out;
  const auto insert = [&](int other) {
    if (other < 0 || other >= static_cast<int>(frame_numbers.size()) || !is_known(other)) return;
    out.frames[out.count] = other;
    out.times[out.count++] =
        frame_numbers[static_cast<std::size_t>(other)] - frame_numbers[static_cast<std::size_t>(frame)];
  };
  for (int step = 1; step <= 2; ++step) insert(frame - step), insert(frame + step);
  const auto times = std::span(out.times).first(out.count);
  if (out.count > 0 && (std::ranges::max(times) < 0 || std::ranges::min(times) > 0)) insert(frame);
  return out;
}

}  // namespace palpable::vision
