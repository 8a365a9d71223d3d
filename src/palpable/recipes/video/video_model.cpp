// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/recipes/video/video_model.hpp"

#include "palpable/core/numbers/quantile.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>

namespace palpable::recipes {
namespace {

using vision::FrameDepth;

PointCloud structure_of(std::span<const FrameDepth> maps, int step) {
  PointCloud out;
  for (const FrameDepth& map : maps)
    for (int y = 0; y < map.map.depth.depth_m.height(); y += step)
      for (int x = 0; x < map.map.depth.depth_m.width(); x += step)
        if (map.map.depth.depth_m(x, y) > 0) out.places_m.push_back(place_of_pixel(map, x, y).v);
  return out;
}

// The middle of the narrowest interval with that share of the heights.
double height_of_ground(std::vector<double> heights, double share) {
  std::sort(heights.begin(), heights.end());
  const auto count = static_cast<std::size_t>(share * static_cast<double>(heights.size()));
  std::size_t best = 0;
  for (std::size_t i = 0; i + count < heights.size(); ++i)
    if (heights[i + count] - heights[i] < heights[best + count] - heights[best]) best = i;
  return heights[best + count / 2];
}

// The standard deviation of a normal distribution with the half width that the heights have below the ground
// at half their greatest density. Above it stands the model.
double noise_of_ground(std::vector<double> heights, double ground, double share) {
  std::sort(heights.begin(), heights.end());
  const auto below = [&](double height) {
    return static_cast<double>(std::lower_bound(heights.begin(), heights.end(), height) - heights.begin());
  };
  const auto density = [&](double height, double half) {
    return below(height + half) - below(height - half);
  };
  // A window that is narrow beside the distribution: an eighth of the ground's share of the points.
  const double wanted = share / 8 * static_cast<double>(heights.size());
  double half = 1e-6 * std::max(1e-6, heights.back() - heights.front());
  constexpr double kFiner = 1.1, kHalfWidth = 1.1774;
  while (density(ground, half) < wanted) half *= kFiner;
  const double peak = density(ground, half);
  double distance = 0.0;
  while (ground - distance > heights.front() && density(ground - distance, half) > 0.5 * peak)
    distance += 0.25 * half;
  return distance / kHalfWidth;
}

// The height above which points belong to the model; that of the lowest point where hardly anything rises.
double height_of_raised(const std::vector<Vec3>& places, const VideoModel& model,
                        const VideoModelOptions& options) {
  std::vector<double> across;
  for (const Vec3& p : places) across.push_back(p.x);
  const double extent =
      quantile_of(across, 1 - options.extent_outliers) - quantile_of(across, options.extent_outliers);
  const double above =
      model.ground_height + std::max(options.least_rise * extent, options.rise_noises * model.ground_noise);
  const auto raised = std::count_if(places.begin(), places.end(), [&](const Vec3& p) { return p.z > above; });
  constexpr double kEverything = -std::numeric_limits<double>::infinity();
  return static_cast<double>(raised) < options.least_raised * static_cast<double>(places.size()) ? kEverything
                                                                                                 : above;
}

bool inside(const Vec3& p, const VideoModel& model) {
  return p.x >= model.least.x && p.x <= model.most.x && p.y >= model.least.y && p.y <= model.most.y &&
         p.z >= model.least.z && p.z <= model.most.z;
}

struct Interval {
  double least = 0.0, most = 0.0;
};
Interval with_margin(std::vector<double> values, double below, double above, double margin) {
  const double least = quantile_of(values, below), most = quantile_of(values, 1 - above);
  return {least - margin * (most - least), most + margin * (most - least)};
}

// Moves the origin of the axes to the middle of the model, on the ground.
void centre(VideoModel& model) {
  const Vec3 origin{(model.least.x + model.most.x) / 2, (model.least.y + model.most.y) / 2,
                    model.ground_height};
  model.axes.translation = -origin;
  model.least = model.least - origin, model.most = model.most - origin;
  for (Vec3& p : model.raised) p = p - origin;
  model.raised_above -= origin.z;
  model.ground_height = 0.0;
}

}  // namespace

Point<WorldFrame> place_of_pixel(const FrameDepth& depth, int x, int y) {
  const Pinhole& camera = *depth.map.depth.camera;
  const double z = static_cast<double>(depth.map.depth.depth_m(x, y));
  return depth.map.pose *
         Point<CameraFrame>{{(x - camera.cx) / camera.fx * z, (y - camera.cy) / camera.fy * z, z}};
}

std::vector<Parameter> parameters_of(VideoModelOptions& o) {
  std::vector<Parameter> all{
      {"structure_step_px",
       &o.structure_step_px,
       {1, 64},
       "px",
       "Spacing of structure points in each depth map"},
      {"outliers", &o.outliers, {0, 0.2}, "", "Share of points at each end that count as outliers"},
      {"margin", &o.margin, {0, 2}, "", "Margin around the model, share of its extent"},
      {"least_rise",
       &o.least_rise,
       {0.001, 0.5},
       "",
       "Height of the model above the ground, share of the extent"},
      {"rise_noises",
       &o.rise_noises,
       {0, 20},
       "",
       "The same, standard deviations of the ground's measured heights"},
      {"outliers_below",
       &o.outliers_below,
       {0, 0.2},
       "",
       "Share of points under the ground that count as outliers"},
      {"outliers_above",
       &o.outliers_above,
       {0, 0.2},
       "",
       "Share of points above the model that count as outliers"},
      {"extent_outliers",
       &o.extent_outliers,
       {0, 0.4},
       "",
       "Share of points at each end left out of the extent"},
      {"least_raised",
       &o.least_raised,
       {0, 1},
       "",
       "Share of the points above the ground that a model needs"},
      {"flat_noises",
       &o.flat_noises,
       {0, 20},
       "",
       "Heights that become the ground, standard deviations of its measured heights"},
      {"ground_share", &o.ground_share, {0.05, 0.9}, "", "Share of the points that lie on the ground"}};
  append_parameters(all, "axes", parameters_of(o.axes));
  return all;
}

VideoModel video_model(std::span<const FrameDepth> maps, const VideoModelOptions& options,
                       std::uint64_t seed) {
  VideoModel out;
  out.structure = structure_of(maps, options.structure_step_px);
  if (out.structure.places_m.empty()) return out;
  std::vector<vision::CameraPose> poses;
  for (const FrameDepth& map : maps) poses.push_back(map.map.pose);
  out.axes = ground_axes(out.structure, poses, options.axes, seed);
  const auto axes_from_world = out.axes.axes_from_world();
  std::vector<Vec3> places;
  std::vector<double> heights;
  for (const Vec3& place : out.structure.places_m) {
    places.push_back((axes_from_world * Point<WorldFrame>{place}).v);
    heights.push_back(places.back().z);
  }
  out.ground_height = height_of_ground(heights, options.ground_share);
  out.ground_noise = noise_of_ground(std::move(heights), out.ground_height, options.ground_share);
  out.raised_above = height_of_raised(places, out, options);
  std::copy_if(places.begin(), places.end(), std::back_inserter(out.raised),
               [&](const Vec3& p) { return p.z > out.raised_above; });
  std::array<std::vector<double>, 2> across;
  for (const Vec3& p : out.raised) across[0].push_back(p.x), across[1].push_back(p.y);
  const Interval x = with_margin(std::move(across[0]), options.outliers, options.outliers, options.margin),
                 y = with_margin(std::move(across[1]), options.outliers, options.outliers, options.margin);
  std::vector<double> up;
  for (const Vec3& p : places)
    if (p.x >= x.least && p.x <= x.most && p.y >= y.least && p.y <= y.most) up.push_back(p.z);
  const Interval z =
      with_margin(std::move(up), options.outliers_below, options.outliers_above, options.margin);
  out.least = {x.least, y.least, z.least}, out.most = {x.most, y.most, z.most};
  std::erase_if(out.raised, [&](const Vec3& p) { return !inside(p, out); });
  centre(out);
  return out;
}

std::vector<Vec3> raised_points(const FrameDepth& map, const VideoModel& model, int step_px) {
  const auto axes_from_world = model.axes.axes_from_world();
  std::vector<Vec3> out;
  for (int y = 0; y < map.map.depth.depth_m.height(); y += step_px)
    for (int x = 0; x < map.map.depth.depth_m.width(); x += step_px) {
      if (!(map.map.depth.depth_m(x, y) > 0)) continue;
      const Vec3 p = (axes_from_world * place_of_pixel(map, x, y)).v;
      if (p.z > model.raised_above && inside(p, model)) out.push_back(p);
    }
  return out;
}

void flatten_ground(std::span<FrameDepth> maps, const VideoModel& model, const VideoModelOptions& options) {
  const double flat = options.flat_noises * model.ground_noise;
  const double extent = std::max(model.most.x - model.least.x, model.most.y - model.least.y);
  if (!(flat > 0) || flat > options.least_rise * extent) return;
  const auto axes_from_world = model.axes.axes_from_world();
  for (FrameDepth& map : maps) {
    const double eye = (axes_from_world * Point<WorldFrame>{map.map.pose.translation_m}).v.z;
    for (int y = 0; y < map.map.depth.depth_m.height(); ++y)
      for (int x = 0; x < map.map.depth.depth_m.width(); ++x) {
        float& depth = map.map.depth.depth_m(x, y);
        if (!(depth > 0)) continue;
        const double height = (axes_from_world * place_of_pixel(map, x, y)).v.z;
        if (std::abs(height) >= 2 * flat || eye <= 2 * flat) continue;
        const double share = std::clamp(std::abs(height) / flat - 1, 0.0, 1.0);
        const double wanted = height * share * share * (3 - 2 * share);
        depth *= static_cast<float>((wanted - eye) / (height - eye));
      }
  }
}

void crop(std::span<FrameDepth> maps, const VideoModel& model) {
  const auto axes_from_world = model.axes.axes_from_world();
  for (FrameDepth& map : maps)
    for (int y = 0; y < map.map.depth.depth_m.height(); ++y)
      for (int x = 0; x < map.map.depth.depth_m.width(); ++x) {
        float& depth = map.map.depth.depth_m(x, y);
        if (depth > 0 && !inside((axes_from_world * place_of_pixel(map, x, y)).v, model))
          depth = kUnknownDepth;
      }
}

}  // namespace palpable::recipes
