// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/result.hpp"
#include "palpable/device/simulated/simulated_hand.hpp"
#include "palpable/haptics/law/laws.hpp"

#include <string>
#include <vector>

namespace palpable::study {

/// A law under a name, with what is set of it besides stiffness, damping and friction.
struct StudiedLaw {
  std::string name;
  haptics::LawParameters parameters;
};

/// The papers' naive law (`averaged` without neighbours), `averaged`, `penalty` and `proxy`.
std::vector<StudiedLaw> laws_in_a_groove();

/// How steady each law is in a concave place: a simulated hand rests in a V-shaped groove, pressed down.
/// Gomez 2012, chapter 12, saw the naive law vibrate there, and averaged to end it.
struct GrooveStudyOptions {
  std::vector<StudiedLaw> laws = laws_in_a_groove();
  std::vector<double> stiffnesses_N_per_m{200.0, 400.0, 800.0};
  /// Slope of the groove's walls, 0.1 … 3.
  double slope = 1.0;
  double damping_Ns_per_m = 0.5;
  /// Friction of the surface: 0, as in the penalty laws, or the proxy would rest on friction alone.
  double friction = 0.0;
  /// The hand's goal: depth below the bottom, and distance beside the middle.
  double deep_m = 0.004;
  double beside_m = 0.0002;
  /// Its script is ignored: the hand holds still.
  device::HandOptions hand;
  double rate_hz = 1000.0;
};

struct GrooveResult {
  std::string law;
  double stiffness_N_per_m = 0.0;
  /// Range of the hand's positions in the last second, across the groove and in height.
  double across_m = 0.0;
  double height_m = 0.0;
  /// Sign changes of the lateral force per second.
  double turns_per_s = 0.0;
  /// Largest change of the force between ticks in that second.
  double force_step_N = 0.0;
  /// The hand's position across the groove in the last 200 ticks.
  std::vector<double> end_m;
};

/// One result for each law and stiffness; the law varies slowest. The law alone acts: no force cap, rise
/// limit or passivity controller. Three seconds of simulated time each; deterministic. Errors:
/// make_touchable()'s.
Result<std::vector<GrooveResult>> study_groove(const GrooveStudyOptions& options);

}  // namespace palpable::study
