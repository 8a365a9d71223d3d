// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/study/simulated/closed_line.hpp"

#include <cstdint>
#include <deque>
#include <memory>
#include <random>

namespace palpable::study {

/// How a simulated person follows a line with the eye. A model, never evidence about people. All values come
/// from the literature but the speed, which was fitted once to the mean times without assistance of
/// "Design and implementation of a graphic-haptic display system" (2006), and to nothing else.
struct TracerParameters {
  /// What the person means to go at on a straight line, m/s.
  double speed_m_per_s = 0.0100;
  /// From seeing to moving: people answer a displaced target or cursor 150 to 200 ms later (Saunders & Knill
  /// 2003, Brenner & Smeets 1997).
  double delay_s = 0.16;
  /// From one planned piece of movement to the next: tracking is corrected several times a second (Miall,
  /// Weir & Stein 1993; Gawthrop et al. 2011).
  double interval_s = 0.2;
  /// Each piece has the velocity profile of least jerk and lasts so long; neighbours add up (Flash & Henis
  /// 1991).
  double lasts_s = 0.4;
  /// Standard deviation of a piece's end in each direction, as a share of its length: noise that grows with
  /// the command (Harris & Wolpert 1998; van Beers, Haggard & Wolpert 2004 found about a tenth).
  double motor_noise = 0.1;
  /// Standard deviation of where the hand is seen, each time. A pixel and a half of the paper's screen.
  double seen_m = 0.0003;
  /// Share of the seen distance from the line that one piece takes back.
  double correction = 0.6;
  /// Share of a displacement by an outer force that the hand's aim follows within one interval: 1 plans each
  /// piece from where the hand is, 0 holds on to the aim.
  double yielding = 1.0;
};

/// Plans the aim that an arm's spring pulls the hand to. Deterministic for a seed.
class SimulatedTracer {
 public:
  SimulatedTracer(std::shared_ptr<const LineByLength> line, const TracerParameters& parameters,
                  std::uint64_t seed);

  Vec3 aim() const { return aim_m_; }
  /// One tick: `hand_m` is where the hand is. Returns the aim.
  Vec3 step(Vec3 hand_m, double dt_s);
  /// The hand has come to the line's end.
  bool finished() const { return finished_; }

 private:
  struct Piece {
    Vec3 way_m;
    double age_s = 0.0;
  };
  void plan();
  /// What the pieces under way will still add.
  Vec3 to_come() const;
  double drawn() { return normal_(random_); }

  std::shared_ptr<const LineByLength> line_;
  TracerParameters p_;
  std::mt19937_64 random_;
  std::normal_distribution<double> normal_;
  Vec3 aim_m_;
  std::deque<Piece> pieces_;
  /// The hand's places over the last delay, oldest first, and what was commanded since each.
  std::deque<Vec3> seen_m_;
  std::deque<Vec3> commanded_m_;
  double until_next_s_ = 0.0;
  double along_m_ = 0.0;
  bool finished_ = false;
};

}  // namespace palpable::study
