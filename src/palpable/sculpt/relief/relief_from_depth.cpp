// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sculpt/relief/relief_from_depth.hpp"

#include "palpable/models/relief/relief_shaping.hpp"
#include "palpable/sculpt/relief/holes.hpp"
#include "palpable/sculpt/relief/relief_shape.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include <opencv2/imgproc.hpp>

namespace palpable::sculpt {
namespace {

Error usage(std::string message) { return {ErrorCode::usage, std::move(message), {}}; }

Result<void> check(const ReliefOptions& options) {
  const Vec3 size = options.size_m.value_or(kDefaultReliefSize_m);
  if (auto valid = check_relief_shape(size, options.steepest_slope); !valid) return valid;
  if (!(options.exaggerate >= 0.1 && options.exaggerate <= 10.0))
    return usage("exaggerate must be 0.1 to 10");
  if (!(options.compression >= 1.5 && options.compression <= 100.0))
    return usage("the compression must be 1.5 to 100");
  if (!(options.smooth_m >= 0.0 && options.smooth_m <= 0.01))
    return usage("the smoothing must be 0 to 10 mm");
  if (options.samples_on_a_side < 2 || options.samples_on_a_side > 4096)
    return usage("a relief takes 2 to 4096 samples on its longer side");
  if (options.most_pixels_on_a_side < 2) return usage("a relief needs at least 2 pixels on a side");
  for (const auto& end : {options.near, options.far})
    if (end && !std::isfinite(*end)) return usage("the depth window's ends must be finite");
  if (options.near && options.far && *options.near == *options.far)
    return usage("the depth window's near and far ends are the same");
  return {};
}

/// Means of k x k known values; a mean of none is unknown.
Raster<float> averaged_down(const Raster<float>& values, int k) {
  Raster<float> small((values.width() + k - 1) / k, (values.height() + k - 1) / k);
  for (int y = 0; y < small.height(); ++y)
    for (int x = 0; x < small.width(); ++x) {
      double sum = 0.0;
      int known = 0;
      for (int b = y * k; b < std::min((y + 1) * k, values.height()); ++b)
        for (int a = x * k; a < std::min((x + 1) * k, values.width()); ++a)
          if (std::isfinite(values(a, b))) sum += double{values(a, b)}, ++known;
      small(x, y) = known > 0 ? static_cast<float>(sum / known) : std::nanf("");
    }
  return small;
}

struct Window {
  double low;
  double high;
};

/// The 0.5th and 99.5th percentile of the known values, without outliers.
Window percentile_window(const Raster<float>& values) {
  std::vector<float> known;
  known.reserve(values.count());
  std::copy_if(values.values().begin(), values.values().end(), std::back_inserter(known),
               [](float v) { return std::isfinite(v); });
  const auto at = [&](double fraction) {
    const auto k = static_cast<std::ptrdiff_t>(std::lround(fraction * static_cast<double>(known.size() - 1)));
    std::nth_element(known.begin(), known.begin() + k, known.end());
    return double{known[static_cast<std::size_t>(k)]};
  };
  return {at(0.005), at(0.995)};
}

/// Clamps values to the window and maps it to 0 (far) … 1 (near). An empty window gives 0.
void stretch(Raster<float>& nearness, Window window) {
  const double range = window.high - window.low;
  for (float& v : nearness.values()) {
    const double clamped = std::clamp(double{v}, window.low, window.high);
    v = range > 0.0 ? static_cast<float>((clamped - window.low) / range) : 0.0F;
  }
}

/// Gaussian smoothing of this full width at half maximum; below a third of a pixel nothing is done.
void smooth(Raster<float>& heights, double width_px) {
  constexpr double kWidthOfDeviation = 2.3548;
  constexpr double kLeast_px = 1.0 / 3.0;
  if (width_px < kLeast_px) return;
  cv::Mat values(heights.height(), heights.width(), CV_32F, heights.data());
  const double deviation_px = width_px / kWidthOfDeviation;
  cv::GaussianBlur(values, values, {}, deviation_px, deviation_px, cv::BORDER_REPLICATE);
}

void resample(Raster<float>& nearness, const ReliefOptions& options) {
  const double scale =
      static_cast<double>(options.samples_on_a_side) / std::max(nearness.width(), nearness.height());
  const auto side = [scale](int n) { return std::max(2, static_cast<int>(std::lround(n * scale))); };
  nearness = resampled(nearness, side(nearness.width()), side(nearness.height()), options.resampling);
}

/// `nearness`: greater is nearer, NaN unknown; in any unit.
Result<models::Relief> relief_from_nearness(Raster<float> nearness, Window window,
                                            const ReliefOptions& options, const Work& work,
                                            DepthOrders* orders) {
  work.report(0.2, "closing holes");
  fill_unknown_heights(nearness);
  if (work.cancelled()) return Work::interrupted();
  stretch(nearness, window);
  if (options.resampling != Resampling::none) resample(nearness, options);

  const Vec3 size = options.size_m.value_or(kDefaultReliefSize_m);
  const double pixel_m = std::min(size.x / nearness.width(), size.y / nearness.height());
  double height_m = size.z * options.exaggerate;
  if (options.size_m) height_m = std::min(height_m, size.z);
  work.report(0.3, "mapping detail");
  auto heights =
      map_detail(nearness, options.detail, {pixel_m, height_m, options.steepest_slope, options.compression},
                 options.detail_options, Work{work.threads, work.seed, {}, work.cancel});
  if (!heights) return heights.error();
  if (options.sense == Sense::engrave)
    for (float& z : heights->values()) z = -z;

  work.report(0.8, "limiting slopes");
  models::limit_slope(*heights, pixel_m, options.steepest_slope);
  if (orders != nullptr) {
    *orders = depth_orders(nearness, *heights);
    if (options.sense == Sense::engrave)
      for (DepthOrder* order : {&orders->anywhere, &orders->nearby}) std::swap(order->kept, order->inverted);
  }
  // A mean of slopes is no steeper than the steepest one, so the limit still holds.
  if (options.smooth_m > 0.0) smooth(*heights, options.smooth_m / pixel_m);
  if (work.cancelled()) return Work::interrupted();
  const float lowest = *std::min_element(heights->values().begin(), heights->values().end());
  for (float& z : heights->values()) z -= lowest;
  work.report(1.0, "relief");
  return models::Relief::from_samples(*std::move(heights), pixel_m);
}

Result<models::Relief> checked_relief(Raster<float> nearness, std::optional<double> near,
                                      std::optional<double> far, const ReliefOptions& options,
                                      const Work& work, DepthOrders* orders) {
  if (const auto valid = check(options); !valid) return valid.error();
  if (nearness.width() < 2 || nearness.height() < 2)
    return invalid_input("a relief needs at least 2 x 2 pixels");
  const int longest = std::max(nearness.width(), nearness.height());
  const int k = (longest + options.most_pixels_on_a_side - 1) / options.most_pixels_on_a_side;
  if (k > 1) nearness = averaged_down(nearness, k);
  if (nearness.width() < 2 || nearness.height() < 2)
    return invalid_input("the picture is too thin for a relief");
  if (std::none_of(nearness.values().begin(), nearness.values().end(),
                   [](float v) { return std::isfinite(v); }))
    return invalid_input("no pixel has a known depth");
  const Window whole = percentile_window(nearness);
  Window window = whole;
  if (far) window.low = *far;
  if (near) window.high = *near;
  if (window.low > window.high) {
    if (near && far)
      std::swap(window.low, window.high);
    else
      return usage("the depth window lies outside the picture's depths");
  }
  if (window.high < whole.low || window.low > whole.high)
    return usage("the depth window lies outside the picture's depths");
  return relief_from_nearness(std::move(nearness), window, options, work, orders);
}

}  // namespace

Result<models::Relief> relief_from_depth(const DepthMap& depth, const ReliefOptions& options,
                                         const Work& work, DepthOrders* orders) {
  // Nearness is the negated depth; depths that are not positive are unknown.
  Raster<float> nearness = depth.depth_m;
  for (float& z : nearness.values()) z = std::isfinite(z) && z > 0.0F ? -z : std::nanf("");
  const auto negated = [](std::optional<double> end) { return end ? std::optional(-*end) : end; };
  return checked_relief(std::move(nearness), negated(options.near), negated(options.far), options, work,
                        orders);
}

Result<models::Relief> relief_from_disparity(const DisparityMap& disparity, const ReliefOptions& options,
                                             const Work& work, DepthOrders* orders) {
  const auto depth = options.height_of == HeightOf::depth ? depth_from_disparity(disparity) : std::nullopt;
  if (depth) return relief_from_depth(*depth, options, work, orders);
  Raster<float> nearness = disparity.disparity_px;
  for (float& d : nearness.values()) d = std::isfinite(d) ? d : std::nanf("");
  return checked_relief(std::move(nearness), options.near, options.far, options, work, orders);
}

Transform<SceneFrame, models::InputFrame> scene_from_picture(const models::Relief& relief, int width,
                                                             int height) {
  Transform<SceneFrame, models::InputFrame> t;
  t.rotation = {1, 0, 0, 0, -1, 0, 0, 0, -1};
  t.scale = relief.size_x_m() / width;
  t.translation_m = {-0.5 * t.scale * (width - 1), 0.5 * t.scale * (height - 1), 0.0};
  return t;
}

}  // namespace palpable::sculpt
