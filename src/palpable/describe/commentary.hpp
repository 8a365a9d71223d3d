// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/describe/place_words.hpp"

#include <deque>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace palpable::describe {

struct CommentaryOptions {
  /// Time that a probe must stay on something before its name is said, so that a quick sweep stays silent.
  double dwell_s = 0.12;
  /// Least time between two utterances, and before the same name is repeated.
  double gap_s = 1.2;
  double repeat_s = 4.0;
  /// At a border, where a hand trembles: a name is left when the probe is farther than this from what has it
  /// (a share of the scene's longer side), or has been outside of it without a break for settle_s.
  double hold = 0.01;
  double settle_s = 1.0;
  /// Whether only leaving for what has no name is held so: on maps small places lie within streets.
  bool holds_before_unnamed_only = false;
  /// An edge is a change of height within edge_reach_m of at least edge_share of the scene's height range,
  /// and of at least edge_least_m.
  double edge_reach_m = 0.003;
  double edge_share = 0.2;
  double edge_least_m = 0.0005;
};

/// For this scene: the streets of a map are named sooner than the parts of other scenes.
CommentaryOptions commentary_options(const models::Scene& scene);

/// Announces in few words what a sweeping probe meets: each name, edge or contour line once when the probe
/// enters it, and the sentence of a name the first time. One object for each probe and scene; one thread.
class Commentary {
 public:
  explicit Commentary(CommentaryOptions options = {}) : options_(options) {}

  /// Updates the probe's place; `now_s` never decreases. Returns what to say now, or nothing. Call it at
  /// least 20 times per second while the probe moves.
  std::optional<std::string> at(const models::Scene& scene, double height_factor, Place place, double now_s);
  /// The sentence of the name that a person gave to `place`, after a blank, if it was not told yet; it counts
  /// as told then. For words that already say the name.
  std::string untold_sentence(const models::Scene& scene, Place place);
  /// The user has just heard otherwise what is at `place`: it is not announced again.
  void heard(const models::Scene& scene, Place place, double now_s);

 private:
  struct Step {
    Place place;
    double height_m;
  };
  /// The name of a place, or the current one where it is held.
  std::string held_name(const models::Scene& scene, Place place, double now_s);
  /// A name as it is said: the first time in a touch with its sentence.
  std::string said_name(const models::Scene& scene, Place place, const std::string& name);
  /// "Edge up" or "Edge down" if the probe meets an edge; also updates way_.
  std::string edge_at(const models::Scene& scene, double height_factor, Place place);

  CommentaryOptions options_;
  /// The probe's recent path, about edge_reach_m long.
  std::deque<Step> way_;
  bool on_edge_ = false;
  std::string candidate_;
  double candidate_since_s_ = 0.0;
  std::string current_;
  /// When the probe was last inside of what has the current name.
  double inside_s_ = -1e9;
  /// Names whose sentence was said.
  std::set<std::string> told_;
  /// What was said within repeat_s.
  struct Said {
    std::string name;
    double at_s;
  };
  std::vector<Said> said_;
  double said_s_ = -1e9;
};

}  // namespace palpable::describe
