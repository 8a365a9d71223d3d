// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/recipes/solid/grid_recipe.hpp"

#include "palpable/core/numbers/quantile.hpp"
#include "palpable/recipes/relief/treated_pair.hpp"
#include "palpable/recipes/solid/volume_under_relief.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

namespace palpable::recipes {
namespace {

/// Share of outliers that is excluded at each end of the scene's extent.
constexpr double kOutlierShare = 0.005;

/// The camera that is assumed if none is known: 2 atan(1/2) = 53 degrees wide.
StereoRig assumed_rig(const Raster<float>& disparity_px) {
  const int w = disparity_px.width(), h = disparity_px.height();
  return {Pinhole{1.0 * w, 1.0 * w, 0.5 * (w - 1), 0.5 * (h - 1), w, h}, 0.1, 0.0};
}

struct Range {
  double least = 0.0;
  double most = 0.0;
  double width() const { return most - least; }
  double middle() const { return 0.5 * (least + most); }
};

Range range_of(std::vector<float>& values) {
  return {double{quantile_of(values, kOutlierShare)}, double{quantile_of(values, 1.0 - kOutlierShare)}};
}

/// The extent of the seen points, in the camera's frame.
struct SeenBox {
  Range x, y, z;
};

SeenBox box_of(const DepthMap& depth) {
  const Pinhole& camera = *depth.camera;
  std::vector<float> x, y, z;
  for (int v = 0; v < depth.depth_m.height(); ++v)
    for (int u = 0; u < depth.depth_m.width(); ++u) {
      const double d = depth.depth_m(u, v);
      if (!std::isfinite(d)) continue;
      x.push_back(static_cast<float>(d * (u - camera.cx) / camera.fx));
      y.push_back(static_cast<float>(d * (v - camera.cy) / camera.fy));
      z.push_back(static_cast<float>(d));
    }
  if (z.empty()) return {};
  return {range_of(x), range_of(y), range_of(z)};
}

/// The highest occupied point of every column, as a relief.
Result<models::Relief> seen_from_above(const models::Occupancy& o) {
  Raster<float> heights(o.counts[0], o.counts[1], 0.0F);
  for (int y = 0; y < o.counts[1]; ++y)
    for (int x = 0; x < o.counts[0]; ++x)
      for (int z = o.counts[2] - 1; z >= 0; --z)
        if (o.occupied[o.index(x, y, z)] != 0) {
          heights(x, o.counts[1] - 1 - y) = static_cast<float>(std::max(0.0, o.origin_m.z + o.spacing_m * z));
          break;
        }
  return models::Relief::from_samples(std::move(heights), o.spacing_m);
}

}  // namespace

Result<MadeScene> grid_from_disparity(DisparityMap disparity, const GridRecipe& recipe, const Work& work) {
  MadeScene made;
  if (!disparity.rig) {
    disparity.rig = assumed_rig(disparity.disparity_px);
    made.notes.emplace_back("The camera is not known, so one of 53 degrees is assumed: give its calibration.",
                            Reason::needs_calibration);
  }
  auto depth = *depth_from_disparity(disparity);
  const SeenBox seen = box_of(depth);
  if (!(seen.x.width() > 0.0 && seen.y.width() > 0.0 && seen.z.width() > 0.0))
    return invalid_input("has no pixel left to fill a grid from");
  // Larger depths are farther; those beyond the range are outliers.
  for (float& z : depth.depth_m.values())
    if (!(z >= static_cast<float>(seen.z.least) && z <= static_cast<float>(seen.z.most)))
      z = std::numeric_limits<float>::quiet_NaN();
  const double scale = std::min(
      {recipe.size_m.x / seen.x.width(), recipe.size_m.y / seen.y.width(), recipe.size_m.z / seen.z.width()});
  // Camera x right, y down, z forward; the farthest point lies on the base.
  Transform<SceneFrame, CameraFrame> scene_from_camera;
  scene_from_camera.rotation = {1, 0, 0, 0, -1, 0, 0, 0, -1};
  scene_from_camera.scale = scale;
  scene_from_camera.translation_m = scale * Vec3{-seen.x.middle(), seen.y.middle(), seen.z.most};
  // A whole number of spacings, so that the lattice's middle is the scene's.
  const Vec3 size = scale * Vec3{seen.x.width(), seen.y.width(), seen.z.width()};
  const double spacing_m = std::max({size.x, size.y, size.z}) / recipe.occupancy.resolution;
  const auto half = [&](double side) { return 0.5 * spacing_m * std::round(side / spacing_m + 0.5); };
  const Vec3 least{-half(size.x), -half(size.y), 0.0};
  const sculpt::VolumeBox box{least, {-least.x, -least.y, size.z}, 0.0};
  work.report(0.95, "filling the grid");
  const sculpt::DepthView view{&depth, scene_from_camera};
  const auto filled = sculpt::occupancy_from_depth({&view, 1}, box, recipe.occupancy, work);
  if (!filled) return filled.error();
  auto occupancy = models::OccupancyGrid::from(*filled, work);
  if (!occupancy) return occupancy.error();
  auto above = seen_from_above(*filled);
  if (!above) return above.error();
  made.scene.model = std::make_shared<const models::Grid>(
      models::Grid{*std::move(occupancy), std::make_shared<const models::Relief>(*std::move(above))});
  made.scene.scene_from_input.scale = scale;
  made.scene.scene_from_input.rotation = scene_from_camera.rotation;
  made.scene.scene_from_input.translation_m = scene_from_camera.translation_m;
  return made;
}

Result<MadeScene> grid_from_pair(const vision::StereoPair& pair, const StereoRecipe& stereo,
                                 const ReliefRecipe& regions, const GridRecipe& recipe, const Work& work) {
  auto treated = treated_pair(pair, stereo, regions, work);
  if (!treated) return treated.error();
  // Labelled pixels are ground or background.
  const auto& labels = treated->regions.labels;
  auto& disparity_px = treated->disparity.disparity_px;
  const bool ground_goes = regions.ground == vision::GroundTreatment::remove;
  if (ground_goes || regions.background == BackgroundTreatment::remove)
    for (std::size_t i = 0; i < labels.count(); ++i)
      if (labels.values()[i] != 0) disparity_px.values()[i] = std::numeric_limits<float>::quiet_NaN();
  auto made = grid_from_disparity(std::move(treated->disparity), recipe, work);
  if (!made) return made;
  made->notes.insert(made->notes.begin(), treated->notes.begin(), treated->notes.end());
  made->scene.warnings = std::move(treated->regions.warnings);
  made->scene.source.method = treated->method + ", filled into a grid from the camera";
  return made;
}

Result<MadeScene> grid_from_relief(MadeScene made, const GridRecipe& recipe, const Work& work) {
  const auto relief = relief_to_fill(made.scene);
  if (!relief) return relief.error();
  work.report(0.95, "filling the grid");
  const auto filled = sculpt::occupancy_from_relief(**relief, recipe.occupancy);
  if (!filled) return filled.error();
  auto occupancy = models::OccupancyGrid::from(*filled, work);
  if (!occupancy) return occupancy.error();
  made.scene.model = std::make_shared<const models::Grid>(models::Grid{*std::move(occupancy), *relief});
  made.scene.source.method += ", filled into a grid";
  return made;
}

}  // namespace palpable::recipes
