// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sculpt/relief/detail.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

namespace palpable::sculpt {
namespace {

constexpr std::array<std::string_view, kDetailOperators.size()> kNames{
    "relief", "linear", "logarithm", "cube-root", "normal", "chiu", "ashikhmin", "bilateral", "histogram"};

cv::Mat as_mat(const Raster<float>& raster) {
  cv::Mat m(raster.height(), raster.width(), CV_32F);
  std::copy(raster.values().begin(), raster.values().end(), m.begin<float>());
  return m;
}

/// Scaled linearly to 0 … height.
Raster<float> stretched(const cv::Mat& values, double height_m) {
  double low = 0.0;
  double high = 0.0;
  cv::minMaxLoc(values, &low, &high);
  const double scale = high > low ? height_m / (high - low) : 0.0;
  Raster<float> out(values.cols, values.rows);
  for (int y = 0; y < out.height(); ++y)
    for (int x = 0; x < out.width(); ++x)
      out(x, y) = static_cast<float>((double{values.at<float>(y, x)} - low) * scale);
  return out;
}

template <class Curve>
cv::Mat curved(cv::Mat values, Curve curve) {
  for (int y = 0; y < values.rows; ++y)
    for (int x = 0; x < values.cols; ++x)
      values.at<float>(y, x) = static_cast<float>(curve(double{values.at<float>(y, x)}));
  return values;
}

cv::Mat blurred(const cv::Mat& values, double sigma) {
  cv::Mat out;
  cv::GaussianBlur(values, out, {}, sigma, sigma, cv::BORDER_REPLICATE);
  return out;
}

/// A length in pixels, given as a share of the picture's longer side.
double share_of(const cv::Mat& values, double share) { return share * std::max(values.cols, values.rows); }

/// The nearness minus a share of its local mean, so that a uniform level is compressed by `compression`.
cv::Mat chiu(const cv::Mat& nearness, double compression, const ChiuOptions& options) {
  const cv::Mat mean = blurred(nearness, std::max(1.0, share_of(nearness, options.mean_scale)));
  return nearness - mean * (1.0 - 1.0 / compression);
}

/// The local adaptation level of a pixel: its mean over the largest window whose mean differs little from
/// that of the window of twice the size.
cv::Mat adapted_level(const cv::Mat& nearness, const AshikhminOptions& options) {
  const auto contrast = static_cast<float>(options.contrast);
  cv::Mat level = nearness.clone();
  cv::Mat settled = cv::Mat::zeros(nearness.size(), CV_8U);
  for (double sigma = 1.0; sigma <= options.greatest_window_px; sigma *= options.window_factor) {
    const cv::Mat mean = blurred(nearness, sigma);
    const cv::Mat wider = blurred(nearness, 2.0 * sigma);
    for (int y = 0; y < nearness.rows; ++y)
      for (int x = 0; x < nearness.cols; ++x) {
        auto& done = settled.at<std::uint8_t>(y, x);
        if (done != 0) continue;
        if (std::abs(mean.at<float>(y, x) - wider.at<float>(y, x)) > contrast)
          done = 1;
        else
          level.at<float>(y, x) = mean.at<float>(y, x);
      }
  }
  return level;
}

cv::Mat ashikhmin(const cv::Mat& nearness, double compression, const AshikhminOptions& options) {
  const cv::Mat level = adapted_level(nearness, options);
  return level / compression + (nearness - level);
}

/// Durand & Dorsey's base under a curve that gives near parts more height than far ones.
cv::Mat bilateral(const cv::Mat& nearness, double compression, const BilateralOptions& options) {
  cv::Mat base;
  const double sigma = std::max(1.0, share_of(nearness, options.spatial_scale));
  cv::bilateralFilter(nearness, base, static_cast<int>(std::ceil(3.0 * sigma)) | 1, options.range, sigma,
                      cv::BORDER_REPLICATE);
  const cv::Mat detail = nearness - base;
  return curved(base,
                [&](double b) { return std::pow(std::max(b, 0.0), options.base_exponent) / compression; }) +
         detail;
}

/// The rank of each height among all heights, mixed with the height itself.
cv::Mat histogram(const cv::Mat& nearness, const HistogramOptions& options) {
  const auto bins = static_cast<std::size_t>(options.bins);
  const double per_bin = options.bins;
  std::vector<double> rank(bins + 1, 0.0);
  for (int y = 0; y < nearness.rows; ++y)
    for (int x = 0; x < nearness.cols; ++x) {
      const double v = std::clamp(double{nearness.at<float>(y, x)}, 0.0, 1.0);
      rank[1 + std::min(bins - 1, static_cast<std::size_t>(v * per_bin))] += 1.0;
    }
  const auto count = static_cast<double>(nearness.total());
  for (std::size_t k = 1; k <= bins; ++k) rank[k] = rank[k - 1] + rank[k] / count;
  return curved(nearness.clone(), [&](double v) {
    const double place = std::clamp(v, 0.0, 1.0) * per_bin;
    const auto k = std::min(bins - 1, static_cast<std::size_t>(place));
    const double equal = rank[k] + (place - static_cast<double>(k)) * (rank[k + 1] - rank[k]);
    return (1.0 - options.linear_share) * equal + options.linear_share * v;
  });
}

}  // namespace

std::string_view name_of(DetailOperator detail) {
  const auto* found = std::find(kDetailOperators.begin(), kDetailOperators.end(), detail);
  return found != kDetailOperators.end() ? kNames[static_cast<std::size_t>(found - kDetailOperators.begin())]
                                         : std::string_view{};
}

std::optional<DetailOperator> detail_operator_from(std::string_view name) {
  const auto* found = std::find(kNames.begin(), kNames.end(), name);
  if (found == kNames.end()) return std::nullopt;
  return kDetailOperators[static_cast<std::size_t>(found - kNames.begin())];
}

Result<Raster<float>> map_detail(const Raster<float>& nearness, DetailOperator detail,
                                 const DetailTarget& target, const DetailOptions& options, const Work& work) {
  if (const auto valid = check_ranges(options); !valid) return valid.error();
  if (detail == DetailOperator::relief) return gradient_domain_relief(nearness, target, options.relief, work);
  if (work.cancelled()) return Work::interrupted();
  const cv::Mat n = as_mat(nearness);
  const double c = target.compression;
  const auto finished = [&target](const cv::Mat& values) { return stretched(values, target.height_m); };
  switch (detail) {
    case DetailOperator::logarithm:
      return finished(curved(n, [c](double v) { return std::log1p((c - 1.0) * v); }));
    case DetailOperator::cube_root:
      return finished(curved(n, [](double v) { return std::cbrt(v); }));
    case DetailOperator::normal: {
      const double mean = std::max(1e-6, cv::mean(n)[0]);
      return finished(curved(n, [mean](double v) { return v / (v + mean); }));
    }
    case DetailOperator::chiu:
      return finished(chiu(n, c, options.chiu));
    case DetailOperator::ashikhmin:
      return finished(ashikhmin(n, c, options.ashikhmin));
    case DetailOperator::bilateral:
      return finished(bilateral(n, c, options.bilateral));
    case DetailOperator::histogram:
      return finished(histogram(n, options.histogram));
    case DetailOperator::linear:
    case DetailOperator::relief:
      break;
  }
  return finished(n);
}

}  // namespace palpable::sculpt
