// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/recipes/video_recipe.hpp"

#include "palpable/core/quantile.hpp"
#include "palpable/recipes/fused_depth_recipe.hpp"
#include "palpable/recipes/table_axes.hpp"
#include "palpable/vision/image/luma.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

namespace palpable::recipes {
namespace {

using vision::CameraMotion;
using vision::FrameDepth;

std::vector<Raster<std::uint8_t>> greys_of(const std::vector<FilmedFrame>& frames) {
  std::vector<Raster<std::uint8_t>> out;
  for (const FilmedFrame& frame : frames) out.push_back(vision::luma8(frame.picture));
  return out;
}

Point<WorldFrame> seen_at(const FrameDepth& depth, int x, int y) {
  const Pinhole& camera = *depth.map.depth.camera;
  const double z = static_cast<double>(depth.map.depth.depth_m(x, y));
  return depth.map.pose *
         Point<CameraFrame>{{(x - camera.cx) / camera.fx * z, (y - camera.cy) / camera.fy * z, z}};
}

// Points of all maps, subsampled.
PointCloud structure_of(const std::vector<FrameDepth>& maps) {
  constexpr int kStep = 4;
  PointCloud out;
  for (const FrameDepth& map : maps)
    for (int y = 0; y < map.map.depth.depth_m.height(); y += kStep)
      for (int x = 0; x < map.map.depth.depth_m.width(); x += kStep)
        if (map.map.depth.depth_m(x, y) > 0) out.places_m.push_back(seen_at(map, x, y).v);
  return out;
}

// The height of the table: the height at which most points lie.
double table_height(std::vector<double> heights) {
  std::sort(heights.begin(), heights.end());
  // The narrowest interval that contains this share of the heights.
  constexpr double kShare = 0.3;
  const auto count = static_cast<std::size_t>(kShare * static_cast<double>(heights.size()));
  std::size_t best = 0;
  for (std::size_t i = 0; i + count < heights.size(); ++i)
    if (heights[i + count] - heights[i] < heights[best + count] - heights[best]) best = i;
  return heights[best + count / 2];
}

// The points above the table; all points if there are hardly any.
std::vector<Vec3> raised(const std::vector<Vec3>& places) {
  constexpr double kRise = 0.02, kHardlyAny = 0.01;
  std::vector<double> heights, across;
  for (const Vec3& p : places) heights.push_back(p.z), across.push_back(p.x);
  const double extent = quantile_of(across, 0.95) - quantile_of(across, 0.05);
  const double table = table_height(std::move(heights));
  std::vector<Vec3> out;
  std::copy_if(places.begin(), places.end(), std::back_inserter(out),
               [&](const Vec3& p) { return p.z > table + kRise * extent; });
  return static_cast<double>(out.size()) < kHardlyAny * static_cast<double>(places.size()) ? places : out;
}

// Removes what is far from the model: the rest of the table and the room.
void crop(std::vector<FrameDepth>& maps, const TableAxes& axes, const PointCloud& structure) {
  constexpr double kOutliers = 0.01, kMargin = 0.15;
  std::vector<Vec3> places;
  for (const Vec3& place : structure.places_m) places.push_back(axes.rotate({place}).v);
  std::array<std::vector<double>, 2> across;
  for (const Vec3& p : raised(places)) across[0].push_back(p.x), across[1].push_back(p.y);
  std::array<double, 3> least{}, most{};
  for (std::size_t i = 0; i < 2; ++i) {
    least[i] = quantile_of(across[i], kOutliers), most[i] = quantile_of(across[i], 1 - kOutliers);
    const double margin = kMargin * (most[i] - least[i]);
    least[i] -= margin, most[i] += margin;
  }
  std::vector<double> heights;
  for (const Vec3& p : places)
    if (p.x >= least[0] && p.x <= most[0] && p.y >= least[1] && p.y <= most[1]) heights.push_back(p.z);
  least[2] = quantile_of(heights, kOutliers / 2), most[2] = quantile_of(heights, 1 - kOutliers / 10);
  const double margin = kMargin * (most[2] - least[2]);
  least[2] -= margin, most[2] += margin;
  for (FrameDepth& map : maps)
    for (int y = 0; y < map.map.depth.depth_m.height(); ++y)
      for (int x = 0; x < map.map.depth.depth_m.width(); ++x) {
        float& depth = map.map.depth.depth_m(x, y);
        if (!(depth > 0)) continue;
        const Vec3 p = axes.rotate(seen_at(map, x, y)).v;
        const bool inside = p.x >= least[0] && p.x <= most[0] && p.y >= least[1] && p.y <= most[1] &&
                            p.z >= least[2] && p.z <= most[2];
        if (!inside) depth = kUnknownDepth;
      }
}

VideoReconstruction reconstruction_of(const std::vector<FilmedFrame>& frames, const CameraMotion& motion,
                                      const std::vector<FrameDepth>& maps, PointCloud structure) {
  VideoReconstruction out;
  const auto number = [&](int frame) { return frames[static_cast<std::size_t>(frame)].number; };
  for (std::size_t i = 0; i < motion.poses.size(); ++i)
    if (motion.poses[i]) out.poses.push_back({frames[i].number, *motion.poses[i]});
  for (const FrameDepth& map : maps) out.depth_maps.push_back({number(map.frame), map.map.depth});
  out.structure = std::move(structure);
  out.reprojection_rms_px = motion.reprojection_rms_px;
  return out;
}

}  // namespace

Result<MadeScene> field_from_video(const std::vector<FilmedFrame>& frames, const vision::VideoCamera& camera,
                                   const VideoRecipe& recipe, const Work& work) {
  const auto tracks = vision::track_points(greys_of(frames), recipe.tracks, work);
  if (!tracks) return tracks.error();
  const auto motion =
      vision::motion_from_tracks(*tracks, static_cast<int>(frames.size()), camera, recipe.motion, work);
  if (!motion) return motion.error();
  std::vector<const Raster<Rgb8>*> pictures;
  for (const FilmedFrame& frame : frames) pictures.push_back(&frame.picture);
  auto maps = vision::depth_of_video(pictures, *motion, motion->camera, recipe.depth, work);
  if (!maps) return maps.error();
  PointCloud structure = structure_of(*maps);
  if (structure.places_m.empty())
    return Error{ErrorCode::invalid_input,
                 "no surface was seen alike from several sides: film again, more slowly and in more light",
                 {},
                 Reason::unspecified};
  std::vector<vision::CameraPose> poses;
  for (const FrameDepth& map : *maps) poses.push_back(map.map.pose);
  const TableAxes axes = table_axes(structure, poses, work.seed);
  VideoReconstruction reconstruction = reconstruction_of(frames, *motion, *maps, structure);
  crop(*maps, axes, structure);
  std::vector<sculpt::DepthView> views;
  for (const FrameDepth& map : *maps) views.push_back({&map.map.depth, axes.scene_from(map.map.pose)});
  FieldRecipe field = recipe.field;
  field.placement.default_size = sculpt::DefaultSize::for_a_hand;
  field.placement.convention = {AxisDirection::plus_z, LengthUnit::unknown};
  if (field.placement.lay == sculpt::Lay::automatic) field.placement.lay = sculpt::Lay::flat;
  auto made = field_from_views(views, {recipe.fusion, field}, "video", work);
  if (!made) return made.error();
  made->notes.insert(
      made->notes.begin(),
      Note(fmt::format("The camera's path was found in {} of {} frames; points are {:.2f} px from where "
                       "they should be (root mean square).",
                       reconstruction.poses.size(), frames.size(), motion->reprojection_rms_px)));
  made->video = std::make_shared<const VideoReconstruction>(std::move(reconstruction));
  return made;
}

}  // namespace palpable::recipes
