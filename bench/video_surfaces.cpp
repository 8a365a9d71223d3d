// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "video_surfaces.hpp"

#include "palpable/core/numbers/quantile.hpp"
#include "palpable/recipes/video/corrected_model.hpp"
#include "palpable/sculpt/field/level_set_surface.hpp"
#include "palpable/sculpt/points/depth_fusion.hpp"
#include "palpable/sculpt/triangles/small_parts.hpp"
#include "palpable/sculpt/triangles/triangle_tree.hpp"

#include <algorithm>
#include <cmath>
#include <ctime>

#include <fmt/format.h>

namespace palpable::bench {
namespace {

using Truth = Transform<measure::TrueWorldFrame, CameraFrame>;

// Of the rendered frames whose depth is compared, and the pixels of each.
constexpr int kFrames = 7, kStep_px = 4;
// Lower places belong to the board.
constexpr double kObject_m = 0.002;

struct TrueFrame {
  Truth pose;
  Raster<float> depth;
};

class TrueModel {
 public:
  TrueModel(const RenderedVideo& video, const Work& work) : camera_(video.camera()) {
    for (int k = 0; k < kFrames; ++k) {
      const int frame = k * (video.frames() - 1) / (kFrames - 1);
      const auto pose = video.pose(frame);
      frames_.push_back({{pose.rotation, pose.translation_m, 1.0}, video.depth(frame, work)});
      for (int y = 0; y < camera_.height; y += kStep_px)
        for (int x = 0; x < camera_.width; x += kStep_px) {
          const double z = static_cast<double>(frames_.back().depth(x, y));
          if (!(z > 0)) continue;
          const Vec3 p = (frames_.back().pose * Point<CameraFrame>{{(x - camera_.cx) / camera_.fx * z,
                                                                    (y - camera_.cy) / camera_.fy * z, z}})
                             .v;
          if (p.z > kObject_m) places_.push_back(p);
        }
    }
    Vec3 least = places_.front(), most = least;
    for (const Vec3& p : places_) {
      least = {std::min(least.x, p.x), std::min(least.y, p.y), std::min(least.z, p.z)};
      most = {std::max(most.x, p.x), std::max(most.y, p.y), std::max(most.z, p.z)};
    }
    within_m_ = 0.01 * norm(most - least);
  }

  SurfaceFigures compare(Mesh surface, const Transform<measure::TrueWorldFrame, SceneFrame>& true_from_axes) {
    for (Vec3& v : surface.vertices_m) v = (true_from_axes * Point<SceneFrame>{v}).v;
    const sculpt::TriangleTree tree(surface);
    std::vector<double> distances;
    SurfaceFigures out;
    for (const Vec3& p : places_) {
      distances.push_back(std::sqrt(tree.nearest(p, 0).squared_distance_m2));
      out.mean_mm += 1000 * distances.back() / static_cast<double>(places_.size());
      out.within_percent += distances.back() < within_m_ ? 100.0 / static_cast<double>(places_.size()) : 0;
    }
    out.diagonal_mm = 1000 * within_m_ / 0.01;
    out.median_mm = 1000 * quantile_of(distances, 0.5);
    const auto air = std::count_if(surface.vertices_m.begin(), surface.vertices_m.end(),
                                   [&](const Vec3& v) { return is_in_air(v); });
    out.in_air_percent = 100.0 * static_cast<double>(air) / static_cast<double>(surface.vertices_m.size());
    return out;
  }

 private:
  bool is_in_air(const Vec3& v) const {
    return std::any_of(frames_.begin(), frames_.end(), [&](const TrueFrame& frame) {
      const Vec3 c = (frame.pose.inverse() * Point<measure::TrueWorldFrame>{v}).v;
      const double x = camera_.fx * c.x / c.z + camera_.cx, y = camera_.fy * c.y / c.z + camera_.cy;
      if (!(c.z > 0 && x >= 0 && y >= 0 && x < camera_.width - 1 && y < camera_.height - 1)) return false;
      const double z = static_cast<double>(
          frame.depth(static_cast<int>(std::lround(x)), static_cast<int>(std::lround(y))));
      return z > 0 && c.z < z - within_m_;
    });
  }

  Pinhole camera_;
  std::vector<TrueFrame> frames_;
  std::vector<Vec3> places_;
  double within_m_ = 0;
};

double processor_seconds_now() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

std::string name_of(const recipes::ModelStep& step, const std::vector<vision::FrameDepth>& maps) {
  constexpr const char* kNames[] = {"segments", "superquadrics", "sampled", "corrected"};
  return fmt::format("{}, frame {}, own error {:.5f}{}", kNames[static_cast<int>(step.kind)],
                     maps[step.map].frame, step.error, step.taken ? "" : ", not taken");
}

}  // namespace

Result<std::vector<NamedSurface>> surfaces_of(const RenderedVideo& video,
                                              std::vector<vision::FrameDepth> maps,
                                              const std::vector<Raster<Rgb8>>& pictures,
                                              const measure::CameraPathScore& path, Surfaces which,
                                              recipes::VideoRecipe& recipe, const Work& work) {
  TrueModel truth(video, work);
  const recipes::VideoModel model = recipes::video_model(maps, recipe.model, work.seed);
  if (model.raised.empty()) return invalid_input("nothing is raised");
  recipes::flatten_ground(maps, model, recipe.model);
  recipes::crop(maps, model);
  const auto axes_from_world = model.axes.axes_from_world();
  const auto true_from_axes = path.true_from_found * axes_from_world.inverse();
  std::vector<NamedSurface> out;
  double begin = processor_seconds_now();
  std::vector<sculpt::DepthView> views;
  for (const auto& map : maps) views.push_back({&map.map.depth, axes_from_world * map.map.pose});
  sculpt::FusionOptions fusion = recipe.fusion;
  fusion.unseen = sculpt::Unseen::solid_below_surfaces;
  const auto set = sculpt::fused_depth(views, fusion, work);
  if (!set) return set.error();
  auto fused = sculpt::surface_of_level_set(*set, work);
  if (!fused) return fused.error();
  *fused = sculpt::without_small_parts(*fused, recipe.fused.least_part);
  out.push_back({"fused", truth.compare(*std::move(fused), true_from_axes), processor_seconds_now() - begin});
  if (which == Surfaces::fused) return out;
  begin = processor_seconds_now();
  double own = 0;
  const auto observe = [&](const recipes::ModelStep& step, const Mesh& surface) {
    own = processor_seconds_now() - begin;
    out.push_back({name_of(step, maps), truth.compare(surface, true_from_axes), own});
  };
  const auto corrected =
      recipes::corrected_model(model, maps, pictures[static_cast<std::size_t>(maps.front().frame)],
                               recipe.shapes, recipe.corrected, observe, work);
  if (!corrected) return corrected.error();
  out.back().name +=
      fmt::format("; {} objects, {} superquadrics, reach {:.2f} mm", corrected->shapes.objects,
                  corrected->shapes.shapes.size() - 1, 1000 * corrected->reach * path.true_from_found.scale);
  return out;
}

}  // namespace palpable::bench
