// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/motion/depth/video_depth.hpp"

#include "palpable/core/numbers/quantile.hpp"
#include "palpable/vision/motion/depth/plane_sweep.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

namespace palpable::vision {
namespace {

std::vector<int> posed_frames(const CameraMotion& motion) {
  std::vector<int> out;
  for (std::size_t i = 0; i < motion.poses.size(); ++i)
    if (motion.poses[i]) out.push_back(static_cast<int>(i));
  return out;
}

const CameraPose& pose_of(const CameraMotion& motion, int frame) {
  return *motion.poses[static_cast<std::size_t>(frame)];
}

// The median depth of the structure in the cameras of all frames; 0 without points.
double middle_depth(const CameraMotion& motion, const std::vector<int>& frames) {
  std::vector<double> depths;
  for (const int frame : frames) {
    const auto camera_from_world = pose_of(motion, frame).inverse();
    for (const StructurePoint& point : motion.points)
      if (const double z = (camera_from_world * point.position).v.z; z > 0) depths.push_back(z);
  }
  return depths.empty() ? 0.0 : quantile_of(depths, 0.5);
}

// The normal of the favoured planes in a camera's frame, turned towards its axis until all pixels meet them.
Vec3 swept_normal(const CameraPose& pose, const Pinhole& camera, const VideoDepthOptions& options) {
  constexpr Vec3 kAxis{0, 0, 1};
  Vec3 favoured = unit(pose.inverse().rotate(options.favoured_normal));
  if (favoured.z < 0) favoured = -favoured;
  const auto is_met = [&](const Vec3& normal) {
    for (const int x : {0, camera.width - 1})
      for (const int y : {0, camera.height - 1})
        if (dot(normal, line_of_sight(camera, x, y)) < options.least_incidence * normal.z) return false;
    return normal.z > 0;
  };
  constexpr int kTurns = 32;
  for (int i = 0; i < kTurns; ++i) {
    const double turned = static_cast<double>(i) / kTurns;
    if (const Vec3 normal = unit((1 - turned) * favoured + turned * kAxis); is_met(normal)) return normal;
  }
  return kAxis;
}

// Planes with this normal through the structure, without its outliers, with a margin.
SweptPlanes planes_through(const CameraMotion& motion, const CameraPose& pose, const Vec3& normal,
                           double margin_beyond, const VideoDepthOptions& options) {
  const auto camera_from_world = pose.inverse();
  std::vector<double> distances;
  for (const StructurePoint& point : motion.points)
    if (const Vec3 p = (camera_from_world * point.position).v; p.z > 0 && dot(normal, p) > 0)
      distances.push_back(dot(normal, p));
  if (distances.empty()) return {};
  const double near = quantile_of(distances, options.range_outliers),
               far = quantile_of(distances, 1 - options.range_outliers);
  return {near * (1 - options.range_margin), far * (1 + margin_beyond), normal};
}

std::vector<SweptPlanes> sweeps_of(const CameraMotion& motion, const CameraPose& pose, const Pinhole& camera,
                                   const VideoDepthOptions& options) {
  std::vector<SweptPlanes> out;
  const bool favoured = norm(options.favoured_normal) > 0;
  if (favoured)
    out.push_back(
        planes_through(motion, pose, swept_normal(pose, camera, options), options.favoured_margin, options));
  if (!favoured || options.facing_too == 1)
    out.push_back(planes_through(motion, pose, {0, 0, 1}, options.range_margin, options));
  return out;
}

// The nearest frame in one direction (+1, -1) in which the scene's centre is seen under the angle; -1 if the
// video ends before.
int frame_at_angle(const CameraMotion& motion, const std::vector<int>& frames, std::size_t from,
                   int direction, double wanted) {
  const Vec3 here = pose_of(motion, frames[from]).translation_m;
  for (auto i = static_cast<std::ptrdiff_t>(from) + direction; i >= 0 && i < std::ssize(frames);
       i += direction) {
    const int frame = frames[static_cast<std::size_t>(i)];
    if (norm(pose_of(motion, frame).translation_m - here) >= wanted) return frame;
  }
  return -1;
}

std::vector<int> compared_frames(const CameraMotion& motion, const std::vector<int>& frames, std::size_t from,
                                 double middle, const VideoDepthOptions& options) {
  std::set<int> out;
  const auto insert = [&](int direction, double degrees) {
    const int frame =
        frame_at_angle(motion, frames, from, direction, degrees * std::numbers::pi / 180 * middle);
    return out.insert(frame), frame >= 0;
  };
  for (const int direction : {-1, 1}) {
    if (!insert(direction, options.near_angle_deg)) insert(-direction, options.near_angle_deg / 2);
    if (!insert(direction, options.far_angle_deg))
      insert(-direction, (options.near_angle_deg + options.far_angle_deg) / 2);
  }
  out.erase(-1);
  return {out.begin(), out.end()};
}

// The posed frames whose depth is computed, as indices into `frames`.
std::set<std::size_t> references(const std::vector<int>& frames, const VideoDepthOptions& options) {
  const auto wanted = std::min<std::size_t>(frames.size(), static_cast<std::size_t>(options.maps));
  std::set<std::size_t> out;
  for (std::size_t i = 0; i < wanted; ++i)
    out.insert(wanted > 1 ? i * (frames.size() - 1) / (wanted - 1) : 0);
  for (const int frame : options.also)
    if (const auto at = std::find(frames.begin(), frames.end(), frame); at != frames.end())
      out.insert(static_cast<std::size_t>(at - frames.begin()));
  return out;
}

}  // namespace

std::vector<Parameter> parameters_of(VideoDepthOptions& o) {
  std::vector<Parameter> out{
      {"maps", &o.maps, {2, 200}, "", "Frames whose depth is computed"},
      {"near_angle_deg", &o.near_angle_deg, {0.2, 30}, "degrees", "Angle to the nearer frames compared"},
      {"far_angle_deg", &o.far_angle_deg, {0.2, 30}, "degrees", "Angle to the farther frames compared"},
      {"range_outliers",
       &o.range_outliers,
       {0, 0.2},
       "",
       "Share of the points at each end left out of the depths"},
      {"range_margin", &o.range_margin, {0, 0.9}, "", "Share by which the searched depths reach farther"},
      {"facing_too", &o.facing_too, {0, 1}, "", "1: planes that face the camera are tried too"},
      {"favoured_margin",
       &o.favoured_margin,
       {0, 0.9},
       "",
       "The same beyond the structure, in planes that are parallel to the ground"},
      {"least_incidence",
       &o.least_incidence,
       {0.01, 1},
       "",
       "Least product of lines of sight with the normal of the favoured planes, share of that in the "
       "middle"}};
  append_parameters(out, "sweep", parameters_of(o.sweep));
  append_parameters(out, "consistency", parameters_of(o.consistency));
  append_parameters(out, "filling", parameters_of(o.filling));
  return out;
}

Result<std::vector<FrameDepth>> depth_of_video(std::span<const Raster<Rgb8>* const> pictures,
                                               const CameraMotion& motion, const Pinhole& camera,
                                               const VideoDepthOptions& options, const Work& work) {
  if (auto checked = check_ranges(options); !checked) return checked.error();
  const std::vector<int> frames = posed_frames(motion);
  const double middle = middle_depth(motion, frames);
  const std::set<std::size_t> wanted = references(frames, options);
  std::vector<FrameDepth> maps;
  std::size_t done = 0;
  for (const std::size_t from : wanted) {
    work.report(static_cast<double>(done++) / static_cast<double>(wanted.size()), "computing depth");
    std::vector<PosedFrame> others;
    for (const int other : compared_frames(motion, frames, from, middle, options))
      others.push_back({pictures[static_cast<std::size_t>(other)], pose_of(motion, other)});
    if (others.empty()) continue;
    const PosedFrame reference{pictures[static_cast<std::size_t>(frames[from])],
                               pose_of(motion, frames[from])};
    auto depth = multi_view_depth(reference, others, camera,
                                  sweeps_of(motion, reference.pose, camera, options), options.sweep, work);
    if (!depth) return depth.error();
    maps.push_back({frames[from], {std::move(*depth), reference.pose}});
  }
  if (maps.size() < 2)
    return Error{
        ErrorCode::invalid_input,
        "the camera moved too little to compute depth: record it again, moving farther around the model",
        {},
        Reason::unspecified};
  std::vector<PosedDepthMap> raw;
  for (const FrameDepth& map : maps) raw.push_back(map.map);
  ConsistencyOptions consistency = options.consistency;
  consistency.least_agreeing = std::min(consistency.least_agreeing, static_cast<int>(maps.size()) - 1);
  auto consistent = consistent_depth(raw, consistency, work);
  if (!consistent) return consistent.error();
  auto filled = filled_depth(*consistent, options.filling, work);
  if (!filled) return filled.error();
  for (std::size_t i = 0; i < maps.size(); ++i) {
    maps[i].map = std::move((*consistent)[i]);
    maps[i].filled = std::move((*filled)[i].depth);
  }
  return maps;
}

}  // namespace palpable::vision
