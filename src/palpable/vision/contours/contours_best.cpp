// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/contours/contours_standard.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include <opencv2/imgproc.hpp>

namespace palpable::vision {
namespace {

/// Directions of the pair of boxes over half a turn.
constexpr int kDirections = 8;
/// Heights of a box, as shares of the picture's diagonal; a box is so many times as wide (along the edge) as
/// high.
constexpr std::array<double, 3> kBoxHeights{0.007, 0.014, 0.028};
constexpr double kBoxAspect = 2.0;
/// Spread that every box has at least: differences in evenly toned ground count by their size, those in grain
/// and speckle by how far they stand out from it.
constexpr float kLeastSpread = 0.1F;
/// Difference over spread that makes strength one half.
constexpr float kHalf = 1.0F;
/// Where the finest scale is trusted less than the first, the boxes alone decide; from the second on, the
/// standard method does.
constexpr float kGrain = 0.58F;
constexpr float kClear = 0.70F;
/// Boxes answer everywhere in grain; a difference of one and a half times the spread at every height is a
/// boundary.
constexpr float kAnswer = 1.5F / (1.5F + kHalf);
constexpr float kBoundary = kAnswer * kAnswer * kAnswer;
/// Strengths below this are nothing: it keeps logarithms finite.
constexpr float kFloor = 1e-3F;
/// Each direction's answers are smoothed by this, so that a line is one ridge.
constexpr double kSmooth_px = 1.0;

cv::Mat as_mat(const Raster<float>& r) {
  return {r.height(), r.width(), CV_32F, const_cast<float*>(r.data())};
}

/// The turn that lays a direction along the rows of a square in which the whole picture has room.
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
                    float least_spread, cv::Mat& sum) {
  const int rows = std::max(2, static_cast<int>(std::lround(height_px)));
  const int columns = static_cast<int>(std::lround(kBoxAspect * height_px)) | 1;
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
                           least_spread * least_spread;
      const float difference = m1[x] - m2[x];
      out[x] += difference * difference / spread;
    }
  }
}

/// How strongly an edge along one direction shows at each pixel, 0 ... 1: the product over the boxes'
/// heights, so that it has to show in the small and in the large.
cv::Mat answers_along(const std::vector<WeightedChannel>& channels, double degrees) {
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
  for (const double height : kBoxHeights) {
    cv::Mat sum = cv::Mat::zeros(turn.side, turn.side, CV_32F);
    for (const auto& [values, squares] : turned)
      add_difference(values, squares, height * std::hypot(size.width, size.height), kLeastSpread, sum);
    cv::sqrt(sum, sum);
    sum = sum / (sum + kHalf) + 1e-3F;
    cv::log(sum, sum);
    logarithms += sum;
  }
  cv::exp(logarithms, logarithms);
  cv::Mat back;
  cv::warpAffine(logarithms, back, turn.to_square, size, cv::INTER_LINEAR | cv::WARP_INVERSE_MAP);
  cv::GaussianBlur(back, back, {}, kSmooth_px, kSmooth_px, cv::BORDER_REFLECT);
  return back;
}

/// The greatest of a pixel's answers, and its direction (radians) by a parabola through it and its
/// neighbours.
std::pair<float, double> strongest(const std::array<float, kDirections>& answers) {
  const auto k = static_cast<int>(std::max_element(answers.begin(), answers.end()) - answers.begin());
  const auto at = [&answers](int i) {
    return answers[static_cast<std::size_t>((i + kDirections) % kDirections)];
  };
  const float before = at(k - 1);
  const float here = at(k);
  const float after = at(k + 1);
  const float bend = before - 2.0F * here + after;
  const float shift = bend < 0.0F ? std::clamp(0.5F * (before - after) / bend, -0.5F, 0.5F) : 0.0F;
  return {here, std::numbers::pi * (double{shift} + k) / kDirections};
}

}  // namespace

EdgeMap best_edges(const Image& image, const Work& work) {
  const auto channels = edge_channels(image, work);
  std::array<cv::Mat, kDirections> answers;
  Work quiet = work;
  quiet.progress = {};
  parallel_for(quiet, kDirections, 1, [&](int begin, int end) {
    for (int k = begin; k < end && !work.cancelled(); ++k)
      answers[static_cast<std::size_t>(k)] = answers_along(channels, 180.0 * k / kDirections);
  });
  if (work.cancelled()) return {};
  EdgeMap out = standard_edges(image, quiet);
  const float clear = std::clamp((out.fine_trust - kGrain) / (kClear - kGrain), 0.0F, 1.0F);
  out.faintest = (1.0F - clear) * kBoundary;
  parallel_for(quiet, image.height, 16, [&](int begin, int end) {
    for (int y = begin; y < end; ++y)
      for (int x = 0; x < image.width; ++x) {
        std::array<float, kDirections> here;
        for (std::size_t k = 0; k < here.size(); ++k) here[k] = answers[k].at<float>(y, x);
        const auto [strength, angle] = strongest(here);
        float& s = out.strength(x, y);
        s = std::exp((1.0F - clear) * std::log(strength + kFloor) + clear * std::log(s + kFloor)) - kFloor;
        if (clear > 0.5F) continue;
        out.tangent_x(x, y) = static_cast<float>(std::cos(angle));
        out.tangent_y(x, y) = static_cast<float>(std::sin(angle));
      }
  });
  work.report(1.0, "finding boundaries");
  return out;
}

}  // namespace palpable::vision
