// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/haptics/servo/probe_path.hpp"

#include "palpable/haptics/law/rehearsal.hpp"
#include "palpable/haptics/servo/real_time.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

namespace palpable::haptics {
namespace {

// Tick length of the first sample of a path, which has no previous one.
constexpr double kFirstTick_s = 0.001;

Hand hand_at(std::span<const PathSample> path, std::size_t i) {
  Hand hand;
  hand.position = path[i].position;
  hand.dt_s = kFirstTick_s;
  if (i == 0) return hand;
  hand.dt_s = path[i].t_s - path[i - 1].t_s;
  hand.velocity_m_per_s = (1.0 / hand.dt_s) * (path[i].position - path[i - 1].position);
  return hand;
}

}  // namespace

Result<void> check_path(std::span<const PathSample> path) {
  if (path.empty()) return invalid_input("the path has no samples");
  for (std::size_t i = 0; i < path.size(); ++i) {
    if (!std::isfinite(path[i].t_s) || !is_finite(path[i].position))
      return invalid_input("sample " + std::to_string(i + 1) + " is not finite");
    if (i > 0 && !(path[i].t_s > path[i - 1].t_s))
      return invalid_input("sample " + std::to_string(i + 1) + " is not later than the one before");
  }
  return {};
}

void probe_path(const Touchable& touchable, std::span<const PathSample> path,
                const std::function<void(const PathSample&, const LawOutput&)>& each) {
  TouchState state;
  for (std::size_t i = 0; i < path.size(); ++i) each(path[i], touchable.evaluate(hand_at(path, i), state));
}

TickTimes time_path(const Touchable& touchable, std::span<const PathSample> path, int passes,
                    Rehearsal rehearsal) {
  flush_denormals();
  const TickClock clock = TickClock::calibrate();
  std::vector<double> least_ns(path.size(), std::numeric_limits<double>::infinity());
  std::size_t contacts = 0;
  for (int pass = 0; pass <= passes; ++pass) {
    TouchState state;
    Hand last;
    for (std::size_t i = 0; i < path.size(); ++i) {
      Hand hand = hand_at(path, i);
      // As in a loop, whose motors hold the force for a tick.
      hand.acts_after_s = 0.5 * hand.dt_s;
      if (i > 0 && rehearsal == Rehearsal::yes) rehearse(touchable, last, state);
      last = hand;
      const std::uint64_t start = TickClock::now();
      const LawOutput output = touchable.evaluate(hand, state);
      const std::uint64_t stop = TickClock::now();
      if (pass > 0) least_ns[i] = std::min(least_ns[i], clock.nanoseconds(start, stop));
      if (pass == passes) contacts += output.contact ? 1U : 0U;
    }
  }
  LatencyRecorder recorder;
  for (const double ns : least_ns) recorder.record_ns(ns);
  TickTimes times;
  times.latency = recorder.summary();
  if (!path.empty())
    times.contact_fraction = static_cast<double>(contacts) / static_cast<double>(path.size());
  return times;
}

}  // namespace palpable::haptics
