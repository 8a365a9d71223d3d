// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/ground.hpp"

#include "palpable/vision/background.hpp"
#include "palpable/vision/regions.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>
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

/// A ground comes nearer towards the bottom of the picture, noticeably, and the camera's roll is moderate.
bool could_be_ground(const DisparityPlane& plane, int height, double range_px) {
  constexpr double kMostRoll = 0.6;
  const double rise_px = plane.b * height;
  return rise_px > std::max(2.0, 0.12 * range_px) && std::abs(plane.a) < kMostRoll * plane.b;
}

/// Inliers count up to 1 each. Nothing lies under a ground: what seems to, speaks against it.
double support_of(const DisparityPlane& plane, std::span<const Sample> samples, double tolerance_px) {
  constexpr double kUnder = 0.5;
  double support = 0.0;
  for (const Sample& s : samples) {
    const double r = (s.d - plane.at(s.x, s.y)) / tolerance_px;
    if (std::abs(r) < 1.0) support += 1.0 - r * r;
    if (r < -2.0 && plane.at(s.x, s.y) > 0.0) support -= kUnder;
  }
  return support;
}

double range_of(std::vector<Sample> samples) {
  const auto quantile = [&samples](double q) {
    const auto k = static_cast<std::ptrdiff_t>(q * static_cast<double>(samples.size() - 1));
    std::nth_element(samples.begin(), samples.begin() + k, samples.end(),
                     [](const Sample& a, const Sample& b) { return a.d < b.d; });
    return samples[static_cast<std::size_t>(k)].d;
  };
  return quantile(0.98) - quantile(0.02);
}

std::optional<DisparityPlane> best_supported(std::span<const Sample> samples, int width, int height,
                                             const Work& work) {
  constexpr int kTrials = 3000;
  constexpr double kTolerance_px = 0.75;
  const double range_px = range_of({samples.begin(), samples.end()});
  std::mt19937_64 random(work.seed);
  // Three points from anywhere seldom share a plane: the second and third are sought near the first.
  const double reach = 0.3 * std::max(width, height);
  const auto pick = [&] { return samples[random() % samples.size()]; };
  const auto pick_near = [&](const Sample& p) {
    for (int attempt = 0; attempt < 8; ++attempt)
      if (const Sample q = pick(); std::hypot(q.x - p.x, q.y - p.y) < reach) return q;
    return pick();
  };
  std::optional<DisparityPlane> best;
  double most = 0.0;
  for (int trial = 0; trial < kTrials && !work.cancelled(); ++trial) {
    const Sample p = pick();
    const auto plane = plane_through(p, pick_near(p), pick_near(p));
    if (!plane || !could_be_ground(*plane, height, range_px)) continue;
    const double support = support_of(*plane, samples, kTolerance_px);
    if (support > most) {
      most = support;
      best = plane;
    }
  }
  return most > 0.0 ? best : std::nullopt;
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

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

struct Fit {
  DisparityPlane plane;
  /// Standard deviation of the inliers, robustly.
  double sigma_px = 0.0;
};

/// Tukey's biweight, iterated; the scale from the inliers' median deviation.
std::optional<Fit> refined(DisparityPlane plane, std::span<const Sample> samples) {
  constexpr int kIterations = 12;
  constexpr double kTukey = 4.685, kLeastSigma_px = 0.02, kMostSigma_px = 0.35, kNear_px = 1.5;
  double sigma = kMostSigma_px;
  std::vector<double> weights(samples.size());
  for (int iteration = 0; iteration < kIterations; ++iteration) {
    std::vector<double> near;
    for (std::size_t i = 0; i < samples.size(); ++i) {
      const double r = samples[i].d - plane.at(samples[i].x, samples[i].y);
      if (std::abs(r) < std::min(kNear_px, 6.0 * sigma)) near.push_back(std::abs(r));
      const double u = r / (kTukey * sigma);
      weights[i] = std::abs(u) < 1.0 ? (1.0 - u * u) * (1.0 - u * u) : 0.0;
    }
    if (near.size() < 50) return std::nullopt;
    plane = fitted(samples, weights);
    sigma = std::clamp(1.4826 * median(std::move(near)), kLeastSigma_px, kMostSigma_px);
  }
  return Fit{plane, sigma};
}

/// For each region, the share of its known pixels that lie on the plane.
std::vector<double> shares_on_plane(const Regions& regions, const Raster<float>& disparity_px,
                                    const DisparityPlane& plane, double tolerance_px) {
  std::vector<double> on(regions.pixels.size()), known(regions.pixels.size());
  for (int y = 0; y < disparity_px.height(); ++y) {
    for (int x = 0; x < disparity_px.width(); ++x) {
      const double r = disparity_px(x, y) - plane.at(x, y);
      if (!std::isfinite(r)) continue;
      const auto region = static_cast<std::size_t>(regions.of_pixel(x, y));
      known[region] += 1.0;
      on[region] += std::abs(r) <= tolerance_px ? 1.0 : 0.0;
    }
  }
  for (std::size_t i = 0; i < on.size(); ++i) on[i] = known[i] > 0.0 ? on[i] / known[i] : 0.0;
  return on;
}

/// How a pixel's neighbourhood lies to the plane.
struct Lie {
  /// Mean distance, pixels of disparity; infinite where nothing is known.
  double distance_px = std::numeric_limits<double>::infinity();
  /// How much the distance grows with each row downwards.
  double slope = 0.0;
};

/// Over the 11 x 11 neighbours of the same region that lie within `near_px` of the plane: matching noise
/// shrinks, and what stands beside the ground does not spoil the mean.
Lie lie_at(int x, int y, const Regions& regions, const Raster<float>& disparity_px,
           const DisparityPlane& plane, double near_px) {
  constexpr int kReach = 5;
  double n = 0.0, sv = 0.0, sr = 0.0, svv = 0.0, svr = 0.0;
  for (int v = std::max(0, y - kReach); v <= std::min(disparity_px.height() - 1, y + kReach); ++v) {
    for (int u = std::max(0, x - kReach); u <= std::min(disparity_px.width() - 1, x + kReach); ++u) {
      const double distance = disparity_px(u, v) - plane.at(u, v);
      if (!(std::abs(distance) <= near_px) || regions.of_pixel(u, v) != regions.of_pixel(x, y)) continue;
      const double r = distance, row = v - y;
      n += 1.0;
      sv += row;
      sr += r;
      svv += row * row;
      svr += row * r;
    }
  }
  if (n < 1.0) return {};
  const double spread = n * svv - sv * sv;
  return {sr / n, spread > 0.0 ? (n * svr - sv * sr) / spread : 0.0};
}

/// A pixel belongs to the ground where its neighbourhood lies on the plane and runs along it: the foot of a
/// thing lies on it too, but rises from it. A region that is mostly ground takes in pixels that the matching
/// left somewhat off or unknown.
Raster<std::uint8_t> mask_of(const Regions& regions, const Raster<float>& disparity_px, const Fit& fit,
                             const Work& work) {
  constexpr double kMostly = 0.8, kLeast_px = 0.12;
  const double tolerance_px = std::max(2.0 * fit.sigma_px, kLeast_px);
  const double near_px = std::max(4.0 * tolerance_px, 0.5), rises = -0.5 * fit.plane.b;
  const auto shares =
      shares_on_plane(regions, disparity_px, fit.plane, std::max(3.0 * fit.sigma_px, kLeast_px));
  Raster<std::uint8_t> mask(disparity_px.width(), disparity_px.height());
  parallel_for(work, mask.height(), 8, [&](int begin, int end) {
    for (int y = begin; y < end && !work.cancelled(); ++y) {
      for (int x = 0; x < mask.width(); ++x) {
        const bool mostly = shares[static_cast<std::size_t>(regions.of_pixel(x, y))] > kMostly;
        const Lie lie = lie_at(x, y, regions, disparity_px, fit.plane, near_px);
        const double own = std::abs(disparity_px(x, y) - fit.plane.at(x, y));
        const double distance = std::abs(lie.distance_px);
        const bool along = distance <= tolerance_px && lie.slope > rises && !(own > near_px);
        mask(x, y) =
            along || (mostly && !(std::isfinite(distance) && distance > 2.0 * tolerance_px)) ? 255 : 0;
      }
    }
  });
  return mask;
}

/// Each pixel as most of its 5 x 5 neighbours are: single wrong matches do not make holes or specks.
Raster<std::uint8_t> majority(const Raster<std::uint8_t>& mask) {
  constexpr int kReach = 2;
  Raster<std::uint8_t> out(mask.width(), mask.height());
  for (int y = 0; y < mask.height(); ++y) {
    for (int x = 0; x < mask.width(); ++x) {
      int ground = 0, all = 0;
      for (int v = std::max(0, y - kReach); v <= std::min(mask.height() - 1, y + kReach); ++v) {
        for (int u = std::max(0, x - kReach); u <= std::min(mask.width() - 1, x + kReach); ++u) {
          ground += mask(u, v) != 0 ? 1 : 0;
          ++all;
        }
      }
      out(x, y) = 2 * ground > all ? 255 : 0;
    }
  }
  return out;
}

void measure(Ground& ground, const Raster<float>& disparity_px) {
  double squares = 0.0, known = 0.0, seen = 0.0;
  for (int y = 0; y < disparity_px.height(); ++y) {
    for (int x = 0; x < disparity_px.width(); ++x) {
      if (ground.mask(x, y) == 0) continue;
      seen += 1.0;
      const double r = disparity_px(x, y) - ground.plane.at(x, y);
      if (!std::isfinite(r)) continue;
      squares += r * r;
      known += 1.0;
    }
  }
  ground.share = seen / static_cast<double>(disparity_px.count());
  ground.rms_px = known > 0.0 ? std::sqrt(squares / known) : 0.0;
}

}  // namespace

std::optional<Ground> find_ground(const Raster<Rgb8>& left, const Raster<float>& disparity_px,
                                  const Work& work) {
  PALPABLE_CHECK(left.width() == disparity_px.width() && left.height() == disparity_px.height());
  constexpr double kTried = 6000.0, kFitted = 60000.0, kLeastShare = 0.05;
  const auto few = samples_of(disparity_px, kTried);
  if (few.size() < 100) return std::nullopt;
  const auto found = best_supported(few, disparity_px.width(), disparity_px.height(), work);
  if (!found || work.cancelled()) return std::nullopt;
  const auto fit = refined(*found, samples_of(disparity_px, kFitted));
  if (!fit) return std::nullopt;
  Ground ground;
  ground.plane = fit->plane;
  ground.mask = majority(mask_of(merge_regions(left), disparity_px, *fit, work));
  measure(ground, disparity_px);
  if (ground.share < kLeastShare || work.cancelled()) return std::nullopt;
  return ground;
}

Vector<CameraFrame> normal_of(const DisparityPlane& plane, const StereoRig& rig) {
  // With Z = B fx / (d + doffs), X = (x - cx) Z / fx and Y = (y - cy) Z / fy, the plane n . p = h reads
  // d + doffs = (B fx / h) (nx (x - cx) / fx + ny (y - cy) / fy + nz).
  const Pinhole& camera = rig.left;
  const Vec3 away{plane.a * camera.fx, plane.b * camera.fy, plane.at(camera.cx, camera.cy) + rig.doffs_px};
  return {-unit(away)};
}

std::string_view name_of(GroundTreatment treatment) {
  switch (treatment) {
    case GroundTreatment::keep:
      return "keep";
    case GroundTreatment::flatten:
      return "flatten";
    case GroundTreatment::remove:
      return "remove";
  }
  return "keep";
}

std::optional<GroundTreatment> ground_treatment_from(std::string_view name) {
  for (const GroundTreatment t : {GroundTreatment::keep, GroundTreatment::flatten, GroundTreatment::remove})
    if (name_of(t) == name) return t;
  return std::nullopt;
}

DisparityMap treat_ground(const DisparityMap& disparity, const Ground& ground, GroundTreatment treatment) {
  if (treatment == GroundTreatment::keep) return disparity;
  DisparityMap out = disparity;
  if (treatment == GroundTreatment::flatten) out.rig.reset();
  Raster<std::uint8_t> goes(ground.mask.width(), ground.mask.height());
  for (int y = 0; y < out.disparity_px.height(); ++y) {
    for (int x = 0; x < out.disparity_px.width(); ++x) {
      const double above_px = disparity.disparity_px(x, y) - ground.plane.at(x, y);
      goes(x, y) = ground.mask(x, y) != 0 || above_px < 0.0 ? 1 : 0;
      if (treatment == GroundTreatment::flatten)
        out.disparity_px(x, y) = goes(x, y) != 0 ? 0.0F : static_cast<float>(above_px);
    }
  }
  return treatment == GroundTreatment::remove ? lowered(out, goes) : out;
}

}  // namespace palpable::vision
