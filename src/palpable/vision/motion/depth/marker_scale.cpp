// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/motion/depth/marker_scale.hpp"

#include "palpable/vision/motion/structure/triangulation.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <vector>

namespace palpable::vision {
namespace {

using Corners = std::array<std::vector<PosedObservation>, 4>;

// The observations of the corners of each marker.
std::map<int, Corners> observations_of_markers(std::span<const Raster<std::uint8_t>> greys,
                                               const CameraMotion& motion, const MarkerOptions& options,
                                               const Work& work) {
  std::map<int, Corners> out;
  const std::size_t step = (greys.size() + static_cast<std::size_t>(options.most_frames) - 1) /
                           static_cast<std::size_t>(options.most_frames);
  for (std::size_t i = 0; i < greys.size() && !work.cancelled(); i += std::max<std::size_t>(1, step)) {
    if (!motion.poses[i]) continue;
    const BundlePose pose = bundle_pose(*motion.poses[i]);
    for (const SeenMarker& marker : find_markers(greys[i], options))
      for (std::size_t k = 0; k < 4; ++k) out[marker.side_mm][k].push_back({pose, marker.corners[k]});
  }
  return out;
}

// The point of a corner, without the frames in which it was found somewhere else: at most a third of them.
std::optional<Vec3> corner_of(std::vector<PosedObservation> seen, const Pinhole& camera, double outlier_px) {
  constexpr double kAny_px = 1e9, kLeastAngle_deg = 1.0;
  for (std::size_t left = seen.size() / 3 + 1; left > 0 && seen.size() >= 2; --left) {
    const auto point = triangulated_point(seen, camera, {kLeastAngle_deg, kAny_px});
    if (!point) return std::nullopt;
    const auto error = [&](const PosedObservation& one) {
      return projection_error_px(camera, one.pose, *point, one.place);
    };
    const auto worst = std::max_element(seen.begin(), seen.end(),
                                        [&](const auto& a, const auto& b) { return error(a) < error(b); });
    if (error(*worst) <= outlier_px) return Vec3{(*point)[0], (*point)[1], (*point)[2]};
    seen.erase(worst);
  }
  return std::nullopt;
}

std::optional<MarkerScale> scale_of(int side_mm, const Corners& seen, const Pinhole& camera,
                                    const MarkerOptions& options) {
  std::array<Vec3, 4> corners;
  for (std::size_t k = 0; k < 4; ++k) {
    const auto point = corner_of(seen[k], camera, options.outlier_px);
    if (!point) return std::nullopt;
    corners[k] = *point;
  }
  // Both diagonals, divided by the square root of 2, are sides too.
  std::array<double, 6> sides{};
  for (std::size_t k = 0; k < 4; ++k) sides[k] = norm(corners[(k + 1) % 4] - corners[k]);
  for (std::size_t k = 0; k < 2; ++k) sides[4 + k] = norm(corners[k + 2] - corners[k]) / std::numbers::sqrt2;
  double mean = 0.0;
  for (const double side : sides) mean += side / static_cast<double>(sides.size());
  MarkerScale out{side_mm / 1000.0 / mean, side_mm, static_cast<int>(seen[0].size()), 0.0};
  for (const double side : sides) out.difference = std::max(out.difference, std::abs(side / mean - 1));
  return out.difference <= options.most_difference ? std::optional(out) : std::nullopt;
}

}  // namespace

std::optional<MarkerScale> scale_from_markers(std::span<const Raster<std::uint8_t>> greys,
                                              const CameraMotion& motion, const MarkerOptions& options,
                                              const Work& work) {
  std::optional<MarkerScale> best;
  for (const auto& [side_mm, seen] : observations_of_markers(greys, motion, options, work)) {
    if (seen[0].size() < 2 || (best && static_cast<int>(seen[0].size()) <= best->frames)) continue;
    if (const auto scale = scale_of(side_mm, seen, motion.camera, options)) best = scale;
  }
  return work.cancelled() ? std::nullopt : best;
}

void scale_motion(CameraMotion& motion, double factor) {
  for (auto& pose : motion.poses)
    if (pose) pose->translation_m *= factor;
  for (StructurePoint& point : motion.points) point.position.v *= factor;
}

void scale_depth(std::span<FrameDepth> maps, double factor) {
  for (FrameDepth& map : maps) {
    map.map.pose.translation_m *= factor;
    for (Raster<float>* depths : {&map.map.depth.depth_m, &map.filled.depth_m})
      for (float& depth : depths->values()) depth *= static_cast<float>(factor);
  }
}

}  // namespace palpable::vision
