// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/contours/contour_channels.hpp"
#include "palpable/vision/contours/edge_response.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>
#include <utility>
#include <vector>

#include <opencv2/imgproc.hpp>

namespace palpable::vision {
namespace {

cv::Mat as_mat(const Raster<float>& r) {
  return {r.height(), r.width(), CV_32F, const_cast<float*>(r.data())};
}

/// The rotation that aligns a direction with the rows of a square that contains the whole picture.
struct Turn {
  cv::Mat to_square;
  int side = 0;
};

Turn turn_by(double degrees, int width, int height) {
  Turn t;
  t.side = static_cast<int>(std::ceil(std::hypot(width, height))) + 2;
  t.to_square = cv::getRotationMatrix2D({0.5F * static_cast<float>(width), 0.5F * static_cast<float>(height)},
                                        degrees, 1.0);
  t.to_square.at<double>(0, 2) += 0.5 * (t.side - width);
  t.to_square.at<double>(1, 2) += 0.5 * (t.side - height);
  return t;
}

/// Adds ((mean below - mean above) / spread)^2 of the boxes that meet at each pixel's row.
void add_difference(const cv::Mat& turned, const cv::Mat& turned_squared, double height_px,
                    const BestContourOptions& options, cv::Mat& sum) {
  const int rows = std::max(2, static_cast<int>(std::lround(height_px)));
  const int columns = static_cast<int>(std::lround(options.box_aspect * height_px)) | 1;
  cv::Mat mean;
  cv::Mat square;
  const cv::Point top(columns / 2, 0);
  cv::boxFilter(turned, mean, CV_32F, {columns, rows}, top, true, cv::BORDER_REFLECT);
  cv::boxFilter(turned_squared, square, CV_32F, {columns, rows}, top, true, cv::BORDER_REFLECT);
  for (int y = rows; y + 1 < turned.rows; ++y) {
    const auto* m1 = mean.ptr<float>(y + 1);
    const auto* m2 = mean.ptr<float>(y - rows);
    const auto* s1 = square.ptr<float>(y + 1);
    const auto* s2 = square.ptr<float>(y - rows);
    auto* out = sum.ptr<float>(y);
    for (int x = 0; x < turned.cols; ++x) {
      const float spread = std::max(0.0F, s1[x] - m1[x] * m1[x]) + std::max(0.0F, s2[x] - m2[x] * m2[x]) +
                           options.least_spread * options.least_spread;
      const float difference = m1[x] - m2[x];
      out[x] += difference * difference / spread;
    }
  }
}

/// The response to an edge along one direction at each pixel, 0 ... 1: the product over the boxes' heights,
/// so that an edge must be present at all sizes.
cv::Mat response_along(const std::vector<WeightedChannel>& channels, double degrees,
                       const BestContourOptions& options) {
  const cv::Size size(channels[0].values.width(), channels[0].values.height());
  const Turn turn = turn_by(degrees, size.width, size.height);
  std::vector<std::pair<cv::Mat, cv::Mat>> turned;
  for (const WeightedChannel& channel : channels) {
    cv::Mat t;
    cv::warpAffine(as_mat(channel.values) * channel.weight, t, turn.to_square, {turn.side, turn.side},
                   cv::INTER_LINEAR, cv::BORDER_REFLECT);
    turned.emplace_back(t, t.mul(t));
  }
  cv::Mat logarithms = cv::Mat::zeros(turn.side, turn.side, CV_32F);
  for (const double height : options.box_heights) {
    cv::Mat sum = cv::Mat::zeros(turn.side, turn.side, CV_32F);
    for (const auto& [values, squares] : turned)
      add_difference(values, squares, height * std::hypot(size.width, size.height), options, sum);
    cv::sqrt(sum, sum);
    sum = sum / (sum + options.half_difference) + options.least_response;
    cv::log(sum, sum);
    logarithms += sum;
  }
  cv::exp(logarithms, logarithms);
  cv::Mat back;
  cv::warpAffine(logarithms, back, turn.to_square, size, cv::INTER_LINEAR | cv::WARP_INVERSE_MAP);
  cv::GaussianBlur(back, back, {}, options.smooth_px, options.smooth_px, cv::BORDER_REFLECT);
  return back;
}

/// A pixel's greatest response, and its direction (radians) by a parabola through the neighbouring responses.
std::pair<float, double> strongest(std::span<const float> responses) {
  const auto directions = static_cast<int>(responses.size());
  const auto k = static_cast<int>(std::max_element(responses.begin(), responses.end()) - responses.begin());
  const auto at = [&](int i) { return responses[static_cast<std::size_t>((i + directions) % directions)]; };
  const float before = at(k - 1);
  const float here = at(k);
  const float after = at(k + 1);
  const float bend = before - 2.0F * here + after;
  const float shift = bend < 0.0F ? std::clamp(0.5F * (before - after) / bend, -0.5F, 0.5F) : 0.0F;
  return {here, std::numbers::pi * (double{shift} + k) / directions};
}

/// The least strength of a boundary, since boxes respond everywhere in grain.
float least_boundary(const BestContourOptions& options) {
  const float response =
      options.boundary_difference / (options.boundary_difference + options.half_difference);
  float product = 1.0F;
  for (std::size_t k = 0; k < options.box_heights.size(); ++k) product *= response;
  return product;
}

}  // namespace

EdgeResponse best_edges(const Image& image, const ContourOptions& all, const Work& work) {
  const BestContourOptions& options = all.best;
  const auto channels = edge_channels(image, all.channels, work);
  std::vector<cv::Mat> responses(static_cast<std::size_t>(options.directions));
  Work quiet = work;
  quiet.progress = {};
  parallel_for(quiet, options.directions, 1, [&](int begin, int end) {
    for (int k = begin; k < end && !work.cancelled(); ++k)
      responses[static_cast<std::size_t>(k)] =
          response_along(channels, 180.0 * k / options.directions, options);
  });
  if (work.cancelled()) return {};
  EdgeResponse out = standard_edges(image, all, quiet);
  const float clear = std::clamp(
      (out.fine_trust - options.grain_trust) / (options.clear_trust - options.grain_trust), 0.0F, 1.0F);
  const float least = options.least_response;
  out.least_threshold = (1.0F - clear) * least_boundary(options);
  parallel_for(quiet, image.height, 16, [&](int begin, int end) {
    std::vector<float> here(responses.size());
    for (int y = begin; y < end; ++y)
      for (int x = 0; x < image.width; ++x) {
        for (std::size_t k = 0; k < here.size(); ++k) here[k] = responses[k].at<float>(y, x);
        const auto [strength, angle] = strongest(here);
        float& s = out.strength(x, y);
        s = std::exp((1.0F - clear) * std::log(strength + least) + clear * std::log(s + least)) - least;
        if (clear > options.direction_share) continue;
        out.tangent_x(x, y) = static_cast<float>(std::cos(angle));
        out.tangent_y(x, y) = static_cast<float>(std::sin(angle));
      }
  });
  work.report(1.0, "finding boundaries");
  return out;
}

}  // namespace palpable::vision
