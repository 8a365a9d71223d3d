// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/segmentation/ground.hpp"

#include "palpable/vision/segmentation/background.hpp"
#include "palpable/vision/segmentation/ground_plane.hpp"
#include "palpable/vision/segmentation/regions.hpp"
#include "palpable/vision/segmentation/side_by_colour.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <opencv2/imgproc.hpp>

namespace palpable::vision {
namespace {

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

/// A line fitted to a neighbourhood's distances from the plane.
struct PlaneFit {
  /// Mean distance, pixels of disparity; infinite where nothing is known.
  double distance_px = std::numeric_limits<double>::infinity();
  /// Growth of the distance with each row downwards.
  double slope = 0.0;
};

/// Over the neighbours of the same region that lie within `near_px` of the plane: matching noise averages
/// out, and objects beside the ground do not distort the mean.
PlaneFit fit_around(int x, int y, const Regions& regions, const Raster<float>& disparity_px,
                    const DisparityPlane& plane, int reach, double near_px) {
  double n = 0.0, sv = 0.0, sr = 0.0, svv = 0.0, svr = 0.0;
  for (int v = std::max(0, y - reach); v <= std::min(disparity_px.height() - 1, y + reach); ++v) {
    for (int u = std::max(0, x - reach); u <= std::min(disparity_px.width() - 1, x + reach); ++u) {
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

/// A pixel belongs to the ground where its neighbourhood lies on the plane and is parallel to it: the foot of
/// an object lies on it too, but rises from it. A region that is mostly ground takes in pixels that the
/// matching left somewhat off or unknown, but not objects of its colour.
Raster<std::uint8_t> mask_of(const Regions& regions, const Raster<float>& disparity_px,
                             const GroundPlane& fit, const GroundMaskOptions& options, const Work& work) {
  const double tolerance_px = std::max(options.sigmas * fit.sigma_px, options.least_tolerance_px);
  const double near_px = std::max(options.near_tolerances * tolerance_px, options.least_near_px);
  const double rises = -options.most_rise_share * fit.plane.b;
  const auto shares =
      shares_on_plane(regions, disparity_px, fit.plane,
                      std::max(1.5 * options.sigmas * fit.sigma_px, options.least_tolerance_px));
  Raster<std::uint8_t> mask(disparity_px.width(), disparity_px.height());
  parallel_for(work, mask.height(), 8, [&](int begin, int end) {
    for (int y = begin; y < end && !work.cancelled(); ++y) {
      for (int x = 0; x < mask.width(); ++x) {
        const bool mostly = shares[static_cast<std::size_t>(regions.of_pixel(x, y))] > options.mostly_share;
        const PlaneFit around =
            fit_around(x, y, regions, disparity_px, fit.plane, options.neighbourhood_px, near_px);
        const double own = std::abs(disparity_px(x, y) - fit.plane.at(x, y));
        const double distance = std::abs(around.distance_px);
        const bool along = distance <= tolerance_px && around.slope > rises && !(own > near_px);
        mask(x, y) = along || (mostly && !(own > options.far_px) &&
                               !(std::isfinite(distance) && distance > 2.0 * tolerance_px))
                         ? 255
                         : 0;
      }
    }
  });
  return mask;
}

/// Majority filter: single wrong matches do not make holes or specks.
Raster<std::uint8_t> majority(const Raster<std::uint8_t>& mask, int reach) {
  Raster<std::uint8_t> out(mask.width(), mask.height());
  for (int y = 0; y < mask.height(); ++y) {
    for (int x = 0; x < mask.width(); ++x) {
      int ground = 0, all = 0;
      for (int v = std::max(0, y - reach); v <= std::min(mask.height() - 1, y + reach); ++v) {
        for (int u = std::max(0, x - reach); u <= std::min(mask.width() - 1, x + reach); ++u) {
          ground += mask(u, v) != 0 ? 1 : 0;
          ++all;
        }
      }
      out(x, y) = 2 * ground > all ? 255 : 0;
    }
  }
  return out;
}

/// What the other picture shows at each of its columns: the nearest disparity that lands there.
Raster<float> nearest_there(const Raster<float>& disparity_px) {
  Raster<float> out(disparity_px.width(), disparity_px.height(), -std::numeric_limits<float>::infinity());
  for (int y = 0; y < out.height(); ++y) {
    for (int x = 0; x < out.width(); ++x) {
      const float d = disparity_px(x, y);
      if (!std::isfinite(d)) continue;
      const int there = static_cast<int>(std::lround(static_cast<float>(x) - d));
      if (there >= 0 && there < out.width()) out(there, y) = std::max(out(there, y), d);
    }
  }
  return out;
}

/// Whether the other camera does not see this pixel, if it lies at this disparity.
bool hidden(const Raster<float>& nearest, int x, int y, double disparity, double by_px) {
  const auto there = static_cast<int>(std::lround(x - disparity));
  return there < 0 || (there < nearest.width() && nearest(there, y) > disparity + by_px);
}

/// The plane's disparity at the far end of the ground, without the farthest share `beyond` of its pixels.
double furthest_of(const Raster<std::uint8_t>& mask, const DisparityPlane& plane, double beyond) {
  std::vector<double> seen;
  for (int y = 0; y < mask.height(); ++y)
    for (int x = 0; x < mask.width(); ++x)
      if (mask(x, y) != 0) seen.push_back(plane.at(x, y));
  if (seen.empty()) return std::numeric_limits<double>::infinity();
  const auto end = seen.begin() + static_cast<std::ptrdiff_t>(beyond * static_cast<double>(seen.size()));
  std::nth_element(seen.begin(), end, seen.end());
  return *end;
}

cv::Mat opened(const cv::Mat& mask, const cv::Mat& square) {
  cv::Mat out;
  cv::morphologyEx(mask, out, cv::MORPH_OPEN, square, {-1, -1}, 1, cv::BORDER_REPLICATE);
  return out;
}

cv::Mat shrunk_by(const cv::Mat& mask, const cv::Mat& square) {
  cv::Mat out;
  cv::erode(mask, out, square, {-1, -1}, 1, cv::BORDER_REPLICATE);
  return out;
}

/// Matching windows carry the disparity of one side over to the other; so beside the ground's border the
/// picture decides, except for parts that are thinner than the strip. So it does where disparity is a guess:
/// where the other camera sees neither the measured point nor the ground in its place, no farther away than
/// the ground is seen elsewhere.
Raster<Side> sides_known(const Raster<std::uint8_t>& mask, const Raster<float>& disparity_px,
                         const DisparityPlane& plane, const GroundMaskOptions& options) {
  const int border_px = options.border_px;
  const Raster<float> nearest = nearest_there(disparity_px);
  const double furthest = furthest_of(mask, plane, options.far_end_share);
  Raster<Side> side(mask.width(), mask.height());
  const cv::Mat ground(mask.height(), mask.width(), CV_8U, const_cast<std::uint8_t*>(mask.data()));
  const cv::Mat rest = 255 - ground;
  const cv::Mat square = cv::Mat::ones(2 * border_px + 1, 2 * border_px + 1, CV_8U);
  const cv::Mat wide_ground = opened(ground, square), deep_ground = shrunk_by(ground, square);
  const cv::Mat wide_rest = opened(rest, square), deep_rest = shrunk_by(rest, square);
  for (int y = 0; y < mask.height(); ++y) {
    for (int x = 0; x < mask.width(); ++x) {
      const float d = disparity_px(x, y);
      const bool is_ground = mask(x, y) != 0;
      const bool beside =
          is_ground ? wide_ground.at<std::uint8_t>(y, x) != 0 && deep_ground.at<std::uint8_t>(y, x) == 0
                    : wide_rest.at<std::uint8_t>(y, x) != 0 && deep_rest.at<std::uint8_t>(y, x) == 0;
      const bool guessed = !is_ground && plane.at(x, y) >= furthest &&
                           (!std::isfinite(d) || hidden(nearest, x, y, d, options.hidden_px)) &&
                           hidden(nearest, x, y, plane.at(x, y), options.hidden_px);
      if (guessed)
        side(x, y) = Side::unknown;
      else if (is_ground)
        side(x, y) = beside ? Side::perhaps_inside : Side::inside;
      else
        side(x, y) = beside ? Side::perhaps_outside : Side::outside;
    }
  }
  return side;
}

/// The mask with its borders where the picture has them.
Raster<std::uint8_t> along_edges(const Raster<Rgb8>& left, const Raster<std::uint8_t>& mask,
                                 const Raster<float>& disparity_px, const DisparityPlane& plane,
                                 const GroundOptions& options, const Work& work) {
  Raster<Side> side = sides_known(mask, disparity_px, plane, options.mask);
  decide_by_colour(left, side, work, options.colour);
  Raster<std::uint8_t> out(mask.width(), mask.height());
  for (std::size_t i = 0; i < out.count(); ++i) out.values()[i] = side.values()[i] == Side::inside ? 255 : 0;
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
                                  const Work& work, DisparityOrigin origin, const GroundOptions& options) {
  PALPABLE_CHECK(left.width() == disparity_px.width() && left.height() == disparity_px.height());
  const auto found = find_ground_plane(disparity_px, work, options.plane);
  if (!found) return std::nullopt;
  Ground ground;
  ground.plane = found->plane;
  ground.mask = majority(
      mask_of(merge_regions(left, options.mask.region_complexity), disparity_px, *found, options.mask, work),
      options.mask.majority_px);
  if (origin == DisparityOrigin::matched)
    ground.mask = majority(along_edges(left, ground.mask, disparity_px, ground.plane, options, work),
                           options.mask.majority_px);
  measure(ground, disparity_px);
  if (ground.share < options.least_share || work.cancelled()) return std::nullopt;
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
