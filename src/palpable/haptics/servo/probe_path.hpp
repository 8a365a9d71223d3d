// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/result.hpp"
#include "palpable/haptics/law/touchable.hpp"
#include "palpable/haptics/servo/latency_recorder.hpp"

#include <functional>
#include <span>
#include <vector>

namespace palpable::haptics {

/// Position of the hand at a time. t_s is strictly increasing along a path.
struct PathSample {
  double t_s = 0.0;
  Point<SceneFrame> position;
};

/// Evaluates the law's force along a path, without caps, ramps or passivity control. The first sample starts
/// a new touch at rest; the velocity is the backward difference. Deterministic. Samples must be valid
/// (check_path). `each` is called for every sample in order.
void probe_path(const Touchable& touchable, std::span<const PathSample> path,
                const std::function<void(const PathSample&, const LawOutput&)>& each);

/// Checks a path: finite positions and strictly increasing times. The error is a sentence with the number of
/// the first invalid sample.
Result<void> check_path(std::span<const PathSample> path);

/// Result of `palpable bench` for one law on one path.
struct TickTimes {
  LatencySummary latency;
  /// Share of the ticks in contact, 0 ... 1.
  double contact_fraction = 0.0;
};

/// Whether the expected tick is rehearsed before each timed one, as in a loop, which does so while it waits.
enum class Rehearsal : bool { no, yes };

/// Times every tick of the path, after one warm-up pass over the whole path. Each pass starts a new touch, so
/// its ticks are the same. With `passes` > 1 a tick's time is the least of its times: what it takes on a
/// machine that other programs keep busy. Denormals are flushed on the calling thread during the call, as on
/// the servo's thread.
TickTimes time_path(const Touchable& touchable, std::span<const PathSample> path, int passes = 1,
                    Rehearsal rehearsal = Rehearsal::no);

}  // namespace palpable::haptics
