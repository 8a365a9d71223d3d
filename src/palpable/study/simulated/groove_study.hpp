// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/result.hpp"
#include "palpable/device/simulated/simulated_hand.hpp"
#include "palpable/haptics/law/laws.hpp"

#include <vector>

namespace palpable::study {

/// How steady each law is in a concave place: a simulated hand rests in a V-shaped groove, pressed down.
/// Gomez 2012, chapter 12, saw the naive law vibrate there, and averaged to end it.
struct GrooveStudyOptions {
  std::vector<haptics::Law> laws{haptics::Law::penalty, haptics::Law::averaged, haptics::Law::proxy};
  std::vector<double> stiffnesses_N_per_m{200.0, 400.0, 800.0};
  /// Of the groove's walls, 0.1 … 3.
  double slope = 1.0;
  double damping_Ns_per_m = 0.5;
  /// Of the surface. The naive laws have none, so neither has the proxy, or it would rest on friction alone.
  double friction = 0.0;
  /// How far below the bottom the hand aims, and how far beside its middle.
  double deep_m = 0.004;
  double beside_m = 0.0002;
  /// Its script is not used: it holds still.
  device::HandOptions hand;
  double rate_hz = 1000.0;
};

struct GrooveResult {
  haptics::Law law = haptics::Law::proxy;
  double stiffness_N_per_m = 0.0;
  /// The greatest distance between two places of the hand in the last second, across the groove and in
  /// height.
  double across_m = 0.0;
  double height_m = 0.0;
  /// How often a second the force changed the side to which it pushes.
  double turns_per_s = 0.0;
  /// Greatest change of the force from tick to tick in that second.
  double force_step_N = 0.0;
  /// The hand's place across the groove in the last 200 ticks.
  std::vector<double> end_m;
};

/// One result for each law and stiffness, the laws' first varying slowest. Without caps or controller: what
/// the law itself does. Three seconds of simulated time each, deterministic. Errors: make_touchable()'s.
Result<std::vector<GrooveResult>> study_groove(const GrooveStudyOptions& options);

}  // namespace palpable::study
