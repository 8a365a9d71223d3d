// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/text/ink_line.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include <opencv2/imgproc.hpp>

namespace palpable::vision {
namespace {

double quantile_of(std::vector<double>& values, double q) {
  const auto at = static_cast<std::ptrdiff_t>(q * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + at, values.end());
  return values[static_cast<std::size_t>(at)];
}

/// Fits v = c0 + c1 u + c2 u² + c3 u³ by least squares; the third degree only if `bends`.
std::array<double, 4> curve_of(const std::vector<cv::Point2d>& points, bool bends) {
  const double scale =
      std::max(1.0, std::abs(std::max_element(points.begin(), points.end(), [](auto& a, auto& b) {
                               return std::abs(a.x) < std::abs(b.x);
                             })->x));
  cv::Matx44d m = cv::Matx44d::zeros();
  cv::Vec4d r(0, 0, 0, 0);
  for (const cv::Point2d& p : points) {
    const double u = p.x / scale;
    const cv::Vec4d f(1.0, u, u * u, bends ? u * u * u : 0.0);
    m += f * f.t();
    r += p.y * f;
  }
  cv::Vec4d c;
  if (!cv::solve(m, r, c, cv::DECOMP_SVD)) return {};
  return {c[0], c[1] / scale, c[2] / (scale * scale), c[3] / (scale * scale * scale)};
}

}  // namespace

cv::Point2d direction_of(const std::vector<cv::Point>& pixels) {
  const auto n = static_cast<double>(pixels.size());
  double x = 0, y = 0, xx = 0, xy = 0, yy = 0;
  for (const cv::Point p : pixels) {
    x += p.x;
    y += p.y;
    xx += static_cast<double>(p.x) * p.x;
    xy += static_cast<double>(p.x) * p.y;
    yy += static_cast<double>(p.y) * p.y;
  }
  const double a = xx / n - x / n * x / n;
  const double b = xy / n - x / n * y / n;
  const double c = yy / n - y / n * y / n;
  const double angle = 0.5 * std::atan2(2.0 * b, a - c);
  return {std::cos(angle), std::sin(angle)};
}

void fit_line(InkLine& ink, const TextLineOptions& options) {
  ink.box = cv::boundingRect(ink.pixels);
  const cv::Point2d along = direction_of(ink.pixels);
  const cv::Point2d across(-along.y, along.x);
  cv::Point2d origin(0, 0);
  for (const cv::Point p : ink.pixels) origin += cv::Point2d(p);
  origin *= 1.0 / static_cast<double>(ink.pixels.size());
  std::vector<cv::Point2d> points;
  std::vector<double> us;
  std::vector<double> vs;
  for (const cv::Point p : ink.pixels) {
    const cv::Point2d d = cv::Point2d(p) - origin;
    points.emplace_back(d.dot(along), d.dot(across));
    us.push_back(points.back().x);
    vs.push_back(points.back().y);
  }
  const double length = quantile_of(us, 1.0) - quantile_of(us, 0.0);
  const double least = options.height_outliers, most = 1.0 - options.height_outliers;
  const double thickness = quantile_of(vs, most) - quantile_of(vs, least);
  const std::array<double, 4> c = curve_of(points, length > options.bending_length * thickness);
  const auto middle = [&c](double u) { return c[0] + u * (c[1] + u * (c[2] + u * c[3])); };
  std::vector<double> residuals;
  residuals.reserve(points.size());
  for (const cv::Point2d& p : points) residuals.push_back(p.y - middle(p.x));
  const double low = quantile_of(residuals, least);
  const double high = quantile_of(residuals, most);
  ink.line.height_px = high - low + 1.0;
  ink.line.centre.clear();
  const double first = quantile_of(us, 0.0);
  const int steps = std::max(1, static_cast<int>(length));
  for (int i = 0; i <= steps; ++i) {
    const double u = first + length * i / steps;
    const cv::Point2d p = origin + u * along + (middle(u) + 0.5 * (low + high)) * across;
    ink.line.centre.push_back({p.x, p.y});
  }
}

InkLine line_of(const std::vector<const Ink*>& pieces, const TextLineOptions& options) {
  InkLine out;
  out.line.letters = static_cast<int>(pieces.size());
  cv::Vec3d colour(0, 0, 0);
  for (const Ink* ink : pieces) {
    colour += ink->colour;
    out.pixels.insert(out.pixels.end(), ink->pixels.begin(), ink->pixels.end());
  }
  colour *= 1.0 / static_cast<double>(pieces.size());
  out.line.colour = {cv::saturate_cast<std::uint8_t>(colour[0]), cv::saturate_cast<std::uint8_t>(colour[1]),
                     cv::saturate_cast<std::uint8_t>(colour[2])};
  fit_line(out, options);
  return out;
}

}  // namespace palpable::vision
