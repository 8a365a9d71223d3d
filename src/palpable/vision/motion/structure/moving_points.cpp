// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/motion/structure/moving_points.hpp"

#include "palpable/core/numbers/quantile.hpp"
#include "palpable/vision/motion/structure/triangulation.hpp"

#include <cstddef>
#include <limits>
#include <optional>
#include <vector>

namespace palpable::vision {
namespace {

std::vector<PosedObservation> posed_observations(const PointTrack& track,
                                                 const std::vector<std::optional<BundlePose>>& poses) {
  std::vector<PosedObservation> out;
  for (int frame = track.first_frame; frame < track.end_frame(); ++frame)
    if (const auto& pose = poses[static_cast<std::size_t>(frame)]; pose && track.in_frame(frame))
      out.push_back({*pose, track.in(frame)});
  return out;
}

}  // namespace

std::vector<Parameter> parameters_of(MovingPointOptions& o) {
  return {{"least_frames", &o.least_frames, {3, 100}, "", "Frames in which a point is judged"},
          {"least_error_px",
           &o.least_error_px,
           {0.5, 50},
           "px",
           "Median error from which on a point moves by itself"}};
}

MovingPoints moving_points(std::span<const PointTrack> tracks, const CameraMotion& motion,
                           const MovingPointOptions& options) {
  std::vector<std::optional<BundlePose>> poses;
  for (const auto& pose : motion.poses)
    poses.push_back(pose ? std::optional(bundle_pose(*pose)) : std::nullopt);
  TriangulationOptions any_error;
  any_error.outlier_px = std::numeric_limits<double>::infinity();
  MovingPoints out;
  for (const PointTrack& track : tracks) {
    const auto observations = posed_observations(track, poses);
    if (std::ssize(observations) < options.least_frames) continue;
    const auto point = triangulated_point(observations, motion.camera, any_error);
    if (!point) continue;
    std::vector<double> errors_px;
    for (const PosedObservation& seen : observations)
      errors_px.push_back(projection_error_px(motion.camera, seen.pose, *point, seen.place));
    ++out.judged;
    out.moving += quantile_of(errors_px, 0.5) > options.least_error_px ? 1 : 0;
  }
  return out;
}

}  // namespace palpable::vision
