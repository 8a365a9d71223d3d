// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/describe/place_words.hpp"

#include <deque>
#include <optional>
#include <string>

namespace palpable::describe {

struct CommentaryOptions {
  /// How long a probe must be on something before its name is said, so that a quick sweep stays silent.
  double dwell_s = 0.12;
  /// Between two utterances, at the least; and before the same name is said again.
  double gap_s = 1.2;
  double repeat_s = 4.0;
  /// What counts as an edge: a change of height within this distance by this share of the scene's range of
  /// height, and at least this much.
  double edge_reach_m = 0.003;
  double edge_share = 0.2;
  double edge_least_m = 0.0005;
};

/// What a sweeping probe meets, in few words: the name of what it comes onto once, an edge once, a line of
/// contours once. One for each probe and scene; one thread.
class Commentary {
 public:
  explicit Commentary(CommentaryOptions options = {}) : options_(options) {}

  /// The probe is at `place`; `now_s` never falls. What to say now, or nothing. To be called 20 times a
  /// second or more while the probe moves.
  std::optional<std::string> at(const models::Scene& scene, double depth, Place place, double now_s);
  /// The person has just heard what is at `place` in another way, and hears no more of it.
  void heard(const models::Scene& scene, Place place, double now_s);

 private:
  struct Step {
    Place place;
    double height_m;
  };
  /// "Edge up", "Edge down" where the probe meets one; also keeps the way behind the probe.
  std::string edge_at(const models::Scene& scene, double depth, Place place);

  CommentaryOptions options_;
  /// The way behind the probe, at most edge_reach_m long.
  std::deque<Step> way_;
  bool on_edge_ = false;
  std::string candidate_;
  double candidate_since_s_ = 0.0;
  std::string current_;
  std::string said_;
  double said_s_ = -1e9;
};

}  // namespace palpable::describe
