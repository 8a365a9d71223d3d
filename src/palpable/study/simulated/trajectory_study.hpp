// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/result.hpp"
#include "palpable/core/work.hpp"
#include "palpable/models/relief/relief.hpp"

#include <cstdint>
#include <memory>
#include <vector>

namespace palpable::haptics {
class Touchable;
}

namespace palpable::study {

/// Whether the law `proxy` ever lets a hand through: random strokes over reliefs of walls, grooves and
/// spikes.
struct TrajectoryStudyOptions {
  /// How many touches, each at another place, 1 ... 100 million. They are shared out evenly among `grounds`
  /// random reliefs (1 ... 1000), with and without limited slopes, with and without friction, for a point and
  /// a ball.
  std::int64_t trajectories = 1'000'000;
  int grounds = 24;
  /// Ticks of a millisecond in each touch, 2 ... 100000.
  int ticks = 100;
  /// Speeds lie between a hundredth of this and this, evenly by their logarithm. Above 0, at most 10.
  double fastest_m_per_s = 1.0;
  double stiffness_N_per_m = 500.0;
  double friction = 0.5;
  double ball_m = 0.001;
  /// What the servo lets a force grow by (TickOptions).
  double max_force_rate_N_per_s = 300.0;
  /// Of the large steps, so many of the greatest are listed.
  int listed = 1000;
};

/// A tick in which the force changed by more than the hand's own movement explains, for its proxy went more
/// than twice as far: the place where it stood was no longer the nearest.
struct LargeStep {
  std::int64_t trajectory = 0;
  int tick = 0;
  Vec3 hand_m;
  double hand_moved_m = 0.0;
  double proxy_moved_m = 0.0;
  double force_step_N = 0.0;
};

struct TrajectoryFindings {
  std::int64_t trajectories = 0;
  std::int64_t ticks = 0;
  /// Ticks in which the hand was under the surface.
  std::int64_t under = 0;
  /// Of these, without contact or without any force.
  std::int64_t let_through = 0;
  /// The proxy went from one side of an obstacle to the other in one tick, though it rises above both places
  /// by more than half of its height, there is no way round it near by, and the hand was not in sight over
  /// it.
  std::int64_t jumped_through = 0;
  /// The proxy under the surface by more than a nanometre; a force that points away from it.
  std::int64_t sunk = 0;
  std::int64_t pulled = 0;
  std::int64_t not_finite = 0;
  /// The proxy went at most twice as far as the hand, and yet the force changed by more than stiffness times
  /// what both moved, plus 5 %; and than stiffness times what the hand alone moved.
  std::int64_t kicked = 0;
  std::int64_t beyond_the_hand = 0;
  /// All other steps that are greater than stiffness times the hand's movement, plus 5 %; how often one of
  /// them came through the servo's limit on growing forces.
  std::int64_t large_steps = 0;
  std::int64_t large_and_unlimited = 0;
  /// The greatest of them, greatest first.
  std::vector<LargeStep> largest;
};

/// A relief of 50 x 37.5 mm with walls 1 mm wide, grooves and spikes at places, heights and depths drawn from
/// `seed`. steepest_slope 0 leaves the walls as steep as its pixels can hold them.
Result<std::shared_ptr<const models::Relief>> obstacle_relief(std::uint64_t seed, double steepest_slope);

/// The study. Deterministic for work.seed, whatever the number of threads. Errors: usage for options out of
/// range, interrupted.
Result<TrajectoryFindings> study_trajectories(const TrajectoryStudyOptions& options, const Work& work);

/// One touch of it, of options.ticks ticks; the trajectory's number is left 0. `surface` is what the proxy
/// stands on: the relief, or it dilated by the ball.
TrajectoryFindings follow_trajectory(const haptics::Touchable& touchable, const models::Relief& surface,
                                     std::uint64_t seed, const TrajectoryStudyOptions& options);

}  // namespace palpable::study
