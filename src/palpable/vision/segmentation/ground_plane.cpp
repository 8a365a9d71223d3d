// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/segmentation/ground_plane.hpp"

#include "palpable/core/numbers/quantile.hpp"

#include <algorithm>
#include <cmath>
#include <random>
#include <span>
#include <vector>

namespace palpable::vision {
namespace {

struct Sample {
  double x, y, d;
};

/// Known pixels of a regular grid, about `wanted` of them.
std::vector<Sample> samples_of(const Raster<float>& disparity_px, double wanted) {
  const int step =
      std::max(1, static_cast<int>(std::sqrt(static_cast<double>(disparity_px.count()) / wanted)));
  std::vector<Sample> samples;
  for (int y = step / 2; y < disparity_px.height(); y += step)
    for (int x = step / 2; x < disparity_px.width(); x += step)
      if (std::isfinite(disparity_px(x, y))) samples.push_back({1.0 * x, 1.0 * y, disparity_px(x, y)});
  return samples;
}

std::optional<DisparityPlane> plane_through(const Sample& p, const Sample& q, const Sample& r) {
  const double ux = q.x - p.x, uy = q.y - p.y, ud = q.d - p.d, vx = r.x - p.x, vy = r.y - p.y, vd = r.d - p.d;
  const double area = ux * vy - uy * vx;
  if (std::abs(area) < 25.0) return std::nullopt;
  const double a = (ud * vy - uy * vd) / area, b = (ux * vd - ud * vx) / area;
  return DisparityPlane{a, b, p.d - a * p.x - b * p.y};
}

/// Size and disparity range of the map.
struct Extent {
  PlaneDirection direction;
  int width, height;
  /// The range of disparities without outliers.
  double range_px;
};

/// A ground gets nearer towards the bottom of the picture, and the camera's roll is moderate.
bool could_be_ground(const DisparityPlane& plane, const Extent& extent, const GroundPlaneOptions& options) {
  if (extent.direction == PlaneDirection::any) return true;
  const double rise_px = plane.b * extent.height;
  return rise_px > std::max(options.least_rise_px, options.least_rise_share * extent.range_px) &&
         std::abs(plane.a) < options.most_roll * plane.b;
}

/// Inliers count up to 1 each. Samples below the plane count against it, since nothing is under a ground.
double support_of(const DisparityPlane& plane, std::span<const Sample> samples,
                  const GroundPlaneOptions& options) {
  double support = 0.0;
  for (const Sample& s : samples) {
    const double r = (s.d - plane.at(s.x, s.y)) / options.tolerance_px;
    if (std::abs(r) < 1.0) support += 1.0 - r * r;
    if (r < -2.0 && plane.at(s.x, s.y) > 0.0) support -= options.under_penalty;
  }
  return support;
}

double range_of(std::span<const Sample> samples) {
  std::vector<double> disparities;
  for (const Sample& s : samples) disparities.push_back(s.d);
  return quantile_of(disparities, 0.98) - quantile_of(disparities, 0.02);
}

/// A plane and how well it is supported.
struct Candidate {
  DisparityPlane plane;
  double support = 0.0;
};

/// Whether two planes differ nowhere in the picture by more than this.
bool alike(const DisparityPlane& p, const DisparityPlane& q, int width, int height, double most_px) {
  const DisparityPlane apart{p.a - q.a, p.b - q.b, p.c - q.c};
  const int bottom = height - 1;
  return std::max({std::abs(apart.at(0, bottom)), std::abs(apart.at(width - 1, bottom)),
                   std::abs(apart.at(0.5 * width, 0.5 * height))}) < most_px;
}

/// The best supported distinct planes through three samples each, best first.
std::vector<DisparityPlane> best_supported(std::span<const Sample> samples, const Extent& extent,
                                           const GroundPlaneOptions& options, const Work& work) {
  const auto kept = static_cast<std::size_t>(options.refined_planes);
  std::mt19937_64 random(work.seed);
  // Three distant points rarely share a plane, so the second and third are near the first.
  const double reach = options.reach_share * std::max(extent.width, extent.height);
  const auto pick = [&] { return samples[random() % samples.size()]; };
  const auto pick_near = [&](const Sample& p) {
    for (int attempt = 0; attempt < 8; ++attempt)
      if (const Sample q = pick(); std::hypot(q.x - p.x, q.y - p.y) < reach) return q;
    return pick();
  };
  std::vector<Candidate> best;
  for (int trial = 0; trial < options.trials && !work.cancelled(); ++trial) {
    const Sample p = pick();
    const auto plane = plane_through(p, pick_near(p), pick_near(p));
    if (!plane || !could_be_ground(*plane, extent, options)) continue;
    const Candidate found{*plane, support_of(*plane, samples, options)};
    if (found.support <= 0.0 || (best.size() == kept && found.support <= best.back().support)) continue;
    const auto same = std::find_if(best.begin(), best.end(), [&](const Candidate& other) {
      return alike(found.plane, other.plane, extent.width, extent.height, 2.0 * options.tolerance_px);
    });
    if (same != best.end() && same->support >= found.support) continue;
    if (same != best.end())
      *same = found;
    else
      best.push_back(found);
    std::stable_sort(best.begin(), best.end(),
                     [](const Candidate& l, const Candidate& r) { return l.support > r.support; });
    if (best.size() > kept) best.pop_back();
  }
  std::vector<DisparityPlane> planes;
  planes.reserve(best.size());
  for (const Candidate& candidate : best) planes.push_back(candidate.plane);
  return planes;
}

/// Weighted least squares: solves the 3 x 3 normal equations by Cramer's rule, about the samples' centre.
DisparityPlane fitted(std::span<const Sample> samples, std::span<const double> weights) {
  double sw = 0, sx = 0, sy = 0, sd = 0;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    sw += weights[i];
    sx += weights[i] * samples[i].x;
    sy += weights[i] * samples[i].y;
    sd += weights[i] * samples[i].d;
  }
  const double mx = sx / sw, my = sy / sw, md = sd / sw;
  double xx = 0, xy = 0, yy = 0, xd = 0, yd = 0;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const double x = samples[i].x - mx, y = samples[i].y - my, d = samples[i].d - md;
    xx += weights[i] * x * x;
    xy += weights[i] * x * y;
    yy += weights[i] * y * y;
    xd += weights[i] * x * d;
    yd += weights[i] * y * d;
  }
  const double determinant = xx * yy - xy * xy;
  const double a = (xd * yy - yd * xy) / determinant, b = (yd * xx - xd * xy) / determinant;
  return {a, b, md - a * mx - b * my};
}

/// Tukey's biweight, iterated; the scale from the inliers' median deviation.
std::optional<GroundPlane> refined(DisparityPlane plane, std::span<const Sample> samples,
                                   const GroundPlaneOptions& options) {
  double sigma = options.most_sigma_px;
  std::vector<double> weights(samples.size());
  for (int iteration = 0; iteration < options.iterations; ++iteration) {
    std::vector<double> near;
    for (std::size_t i = 0; i < samples.size(); ++i) {
      const double r = samples[i].d - plane.at(samples[i].x, samples[i].y);
      if (std::abs(r) < std::min(options.near_px, 6.0 * sigma)) near.push_back(std::abs(r));
      const double u = r / (options.biweight * sigma);
      weights[i] = std::abs(u) < 1.0 ? (1.0 - u * u) * (1.0 - u * u) : 0.0;
    }
    if (near.size() < 50) return std::nullopt;
    plane = fitted(samples, weights);
    sigma = std::clamp(1.4826 * quantile_of(near, 0.5), options.least_sigma_px, options.most_sigma_px);
  }
  return GroundPlane{plane, sigma};
}

/// Whether the plane has enough inliers, with a rise larger than noise gives a level plane or a wall.
bool holds(const GroundPlane& ground, std::span<const Sample> samples, PlaneDirection direction,
           const GroundPlaneOptions& options) {
  std::vector<double> on;
  for (const Sample& s : samples)
    if (const double d = ground.plane.at(s.x, s.y); std::abs(s.d - d) < 3.0 * ground.sigma_px)
      on.push_back(d);
  if (static_cast<double>(on.size()) < options.least_share * static_cast<double>(samples.size()))
    return false;
  if (direction == PlaneDirection::any) return true;
  const double rise_px = quantile_of(on, 0.95) - quantile_of(on, 0.05);
  return rise_px > std::max(options.least_held_rise_px, options.least_held_rise_sigmas * ground.sigma_px);
}

std::optional<GroundPlane> find_plane(const Raster<float>& disparity_px, PlaneDirection direction,
                                      const Work& work, const GroundPlaneOptions& options) {
  const auto few = samples_of(disparity_px, options.searched_samples);
  if (few.size() < 100) return std::nullopt;
  const auto many = samples_of(disparity_px, options.fitted_samples);
  const Extent extent{direction, disparity_px.width(), disparity_px.height(), range_of(few)};
  std::optional<GroundPlane> best;
  double most = 0.0;
  for (const DisparityPlane& candidate : best_supported(few, extent, options, work)) {
    const auto fit = refined(candidate, many, options);
    // A plane across the steps of a wall loses its tilt when it is fitted, and is rejected.
    if (!fit || !could_be_ground(fit->plane, extent, options) || !holds(*fit, few, direction, options))
      continue;
    const double support = support_of(fit->plane, few, options);
    if (support <= most) continue;
    most = support;
    best = fit;
  }
  return work.cancelled() ? std::nullopt : best;
}

}  // namespace

std::optional<GroundPlane> find_ground_plane(const Raster<float>& disparity_px, const Work& work,
                                             const GroundPlaneOptions& options) {
  return find_plane(disparity_px, PlaneDirection::ground, work, options);
}

std::optional<GroundPlane> find_back_plane(const Raster<float>& disparity_px, const Work& work,
                                           const GroundPlaneOptions& options) {
  return find_plane(disparity_px, PlaneDirection::any, work, options);
}

}  // namespace palpable::vision
