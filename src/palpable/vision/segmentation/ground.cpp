// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/segmentation/ground.hpp"

#include "palpable/vision/segmentation/background.hpp"
#include "palpable/vision/segmentation/ground_plane.hpp"
#include "palpable/vision/segmentation/plane_mask.hpp"
#include "palpable/vision/segmentation/side_by_colour.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <opencv2/imgproc.hpp>

namespace palpable::vision {
namespace {

/// The disparity map of the other view: at each of its columns the largest disparity that maps there.
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

/// Whether this pixel is occluded in the other view if it has this disparity.
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

/// Matching windows extend one side's disparity to the other (edge fattening), so in a strip along the
/// ground's border colour decides, except for parts thinner than the strip. Colour also decides where
/// disparity is a guess: where the other camera sees neither the measured point nor the ground in its place,
/// and the ground is no farther away than elsewhere.
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

/// The mask with its borders aligned to those of the picture.
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
  ground.mask = plane_mask(merge_regions(left, options.mask.region_complexity), disparity_px, *found,
                           PlaneDirection::ground, options.mask, work);
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
