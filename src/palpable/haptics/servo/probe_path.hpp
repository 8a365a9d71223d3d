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

/// Where the hand is at a time; t_s rises strictly along a path.
struct PathSample {
  double t_s = 0.0;
  Point<SceneFrame> position;
};

/// The law's raw force along a path: no caps, ramps or passivity. The first sample starts a new touch at
/// rest; the velocity is the backward difference. Deterministic. Samples must be finite and rise strictly in
/// time (see check_path). Calls `each` for every sample in order.
void probe_path(const Touchable& touchable, std::span<const PathSample> path,
                const std::function<void(const PathSample&, const LawOutput&)>& each);

/// The first fault of a path, as a sentence for the person with the sample's number; nothing if it is valid.
Result<void> check_path(std::span<const PathSample> path);

/// What `bench` reports of one law on one path.
struct TickTimes {
  LatencySummary latency;
  /// Share of the ticks in contact, 0 ... 1.
  double contact_fraction = 0.0;
};

/// Every tick timed by itself after one warm-up pass over the whole path; the touch starts anew in each pass.
/// From then on the calling thread flushes denormals, as the servo's does.
TickTimes time_path(const Touchable& touchable, std::span<const PathSample> path);

}  // namespace palpable::haptics
