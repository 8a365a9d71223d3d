// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/study/simulated/closed_line.hpp"

#include <cstdint>
#include <deque>
#include <memory>
#include <random>

namespace palpable::study {

/// A model of a person who traces a visible line; no evidence about people. All values are from the
/// literature, except the speed: it was fitted once, to the mean times without assistance in "Design and
/// implementation of a graphic-haptic display system" (2006).
struct TracerParameters {
  /// Intended speed on a straight line, m/s.
  double speed_m_per_s = 0.0100;
  /// Visuomotor delay: people correct for a displaced target or cursor after 150 to 200 ms (Saunders & Knill
  /// 2003, Brenner & Smeets 1997).
  double delay_s = 0.16;
  /// Interval between submovements: tracking is corrected intermittently, several times per second (Miall,
  /// Weir & Stein 1993; Gawthrop et al. 2011).
  double interval_s = 0.2;
  /// Duration of a submovement, which has a minimum-jerk velocity profile; overlapping submovements add up
  /// (Flash & Henis 1991).
  double duration_s = 0.4;
  /// Standard deviation of a submovement's end in each direction, as a share of its length: signal-dependent
  /// noise (Harris & Wolpert 1998; about a tenth in van Beers, Haggard & Wolpert 2004).
  double motor_noise = 0.1;
  /// Standard deviation of each visual estimate of the hand's position: 1.5 pixels of the paper's screen.
  double visual_noise_m = 0.0003;
  /// Share of the seen deviation from the line that one submovement corrects.
  double correction = 0.6;
  /// Share of a displacement by an external force that the aim follows within one interval. With 1 each
  /// submovement is planned from the hand's position, with 0 from the aim.
  double compliance = 1.0;
};

/// Plans the aim: the rest position of the arm's spring, which pulls the hand. Deterministic for a seed.
class SimulatedTracer {
 public:
  SimulatedTracer(std::shared_ptr<const LineByLength> line, const TracerParameters& parameters,
                  std::uint64_t seed);

  Vec3 aim() const { return aim_m_; }
  /// One tick: takes the hand's position and returns the aim.
  Vec3 step(Vec3 hand_m, double dt_s);
  /// The hand has reached the line's end.
  bool finished() const { return finished_; }

 private:
  struct Submovement {
    Vec3 displacement_m;
    double age_s = 0.0;
  };
  void plan();
  /// The rest of the displacement of the running submovements.
  Vec3 remaining_m() const;
  double gaussian() { return normal_(random_); }

  std::shared_ptr<const LineByLength> line_;
  TracerParameters p_;
  std::mt19937_64 random_;
  std::normal_distribution<double> normal_;
  Vec3 aim_m_;
  std::deque<Submovement> submovements_;
  /// The hand's positions over the last delay, oldest first, and the commanded steps since then.
  std::deque<Vec3> seen_m_;
  std::deque<Vec3> commanded_m_;
  double until_next_s_ = 0.0;
  double along_m_ = 0.0;
  bool finished_ = false;
};

}  // namespace palpable::study
