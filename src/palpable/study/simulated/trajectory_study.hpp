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

/// Whether the law `proxy` ever lets a hand through a surface: random strokes over reliefs with walls,
/// grooves and spikes.
struct TrajectoryStudyOptions {
  /// Number of trajectories, 1 ... 100 million, each with its own start. They are divided evenly among
  /// the reliefs, with and without a slope limit, with and without friction, for a
  /// point and a ball.
  std::int64_t trajectories = 1'000'000;
  /// Number of random reliefs, 1 ... 1000.
  int reliefs = 24;
  /// Ticks of one millisecond per trajectory, 2 ... 100000.
  int ticks = 100;
  /// Speeds are log-uniform between a hundredth of this and this. Above 0, at most 10.
  double fastest_m_per_s = 1.0;
  /// Of the law `proxy`; in its ranges.
  double stiffness_N_per_m = 500.0;
  /// Static and dynamic friction of every second trajectory; in the law's range.
  double friction = 0.5;
  /// Radius of the ball. Above 0, in the law's range.
  double radius_m = 0.001;
  /// The servo's rise limit (TickOptions).
  double max_force_rate_N_per_s = 300.0;
  /// How many of the largest steps are listed.
  int listed = 1000;
};

/// A tick in which the force changed by more than stiffness times the hand's movement, while the proxy moved
/// more than twice as far as the hand: the proxy's position was no longer the nearest point of the surface.
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
  /// Ticks in which the hand was below the surface.
  std::int64_t hand_below_surface = 0;
  /// Those of them without contact or without force.
  std::int64_t let_through = 0;
  /// Ticks in which the proxy jumped through an obstacle that rises above both positions by more than half of
  /// its height, with no path around it near by and no free straight path to the hand.
  std::int64_t jumped_through = 0;
  /// Ticks with the proxy more than a nanometre below the surface.
  std::int64_t proxy_below_surface = 0;
  /// Ticks with a force that points away from the proxy.
  std::int64_t force_away_from_proxy = 0;
  /// Ticks with a force that is not finite.
  std::int64_t not_finite = 0;
  /// Ticks in which the proxy moved at most twice as far as the hand, and the force changed by more than
  /// stiffness times the movement of both, plus 5 %; without those whose contact is a crest that the hand cut
  /// within the tick, a release into the air.
  std::int64_t step_beyond_both_motions = 0;
  /// The same with the movement of the hand alone.
  std::int64_t step_beyond_hand_motion = 0;
  /// Ticks in which the proxy moved farther, and the force changed by more than stiffness times the hand's
  /// movement, plus 5 %.
  std::int64_t large_steps = 0;
  /// Those of them that the rise limit did not limit.
  std::int64_t large_and_unlimited = 0;
  /// The largest of the large steps, largest first.
  std::vector<LargeStep> largest;
};

/// A relief of 50 x 37.5 mm with walls 1 mm wide, grooves and spikes; positions, heights and depths are
/// random, from `seed`. steepest_slope 0 means no slope limit.
Result<std::shared_ptr<const models::Relief>> obstacle_relief(std::uint64_t seed, double steepest_slope);

/// The study. Deterministic for work.seed, whatever the number of threads. Errors: usage for options out of
/// range, interrupted.
Result<TrajectoryFindings> study_trajectories(const TrajectoryStudyOptions& options, const Work& work);

/// One trajectory of options.ticks ticks; its number is left 0. `surface` is the surface that holds the
/// proxy: the relief, or the relief dilated by the ball.
TrajectoryFindings follow_trajectory(const haptics::Touchable& touchable, const models::Relief& surface,
                                     std::uint64_t seed, const TrajectoryStudyOptions& options);

}  // namespace palpable::study
