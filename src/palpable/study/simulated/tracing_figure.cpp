// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/study/simulated/tracing_figure.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include <fmt/format.h>

namespace palpable::study {
namespace {

constexpr int kFigureWidth = 700;
constexpr int kFigureHeight = 500;
constexpr double kFigurePixel_m = 0.0002;
constexpr int kSamples = 4;
constexpr std::uint8_t kDark = 60;
constexpr std::uint8_t kLight = 220;

/// The covered share of each pixel, from kSamples x kSamples points in it.
Raster<float> coverage(const Raster<std::uint8_t>& fine) {
  Raster<float> covered(kFigureWidth, kFigureHeight, 0.0F);
  for (int y = 0; y < kFigureHeight; ++y)
    for (int x = 0; x < kFigureWidth; ++x) {
      int sum = 0;
      for (int b = 0; b < kSamples; ++b)
        for (int a = 0; a < kSamples; ++a) sum += fine(kSamples * x + a, kSamples * y + b);
      covered(x, y) = static_cast<float>(sum) / (kSamples * kSamples);
    }
  return covered;
}

Raster<float> coverage_of(const std::vector<Vec3>& outline) {
  return coverage(
      inside_of(outline, {kFigureWidth * kSamples, kFigureHeight * kSamples, kFigurePixel_m / kSamples}));
}

Raster<std::uint8_t> dark_on_light(const Raster<float>& covered) {
  Raster<std::uint8_t> picture(kFigureWidth, kFigureHeight);
  std::transform(covered.values().begin(), covered.values().end(), picture.values().begin(), [](float c) {
    return static_cast<std::uint8_t>(std::lround(kLight + double{c} * (kDark - kLight)));
  });
  return picture;
}

TracingFigure filled(std::string name, std::vector<Vec3> outline) {
  TracingFigure figure;
  figure.name = std::move(name);
  figure.picture = dark_on_light(coverage_of(outline));
  figure.pixel_m = kFigurePixel_m;
  figure.nominal = std::move(outline);
  return figure;
}

std::vector<Vec3> millimetres(std::vector<Vec3> points) {
  for (Vec3& p : points) p = 0.001 * p;
  return points;
}

/// A stroke 2 mm wide along a polyline.
TracingFigure stroke(std::string name, std::vector<Vec3> line) {
  constexpr double kHalf_m = 0.001;
  std::vector<Vec3> left;
  std::vector<Vec3> right;
  for (std::size_t k = 0; k < line.size(); ++k) {
    const Vec3 way = line[std::min(k + 1, line.size() - 1)] - line[k > 0 ? k - 1 : 0];
    const Vec3 across = (kHalf_m / norm(way)) * Vec3{-way.y, way.x, 0.0};
    left.push_back(line[k] + across);
    right.push_back(line[k] - across);
  }
  left.insert(left.end(), right.rbegin(), right.rend());
  TracingFigure figure = filled(std::move(name), std::move(left));
  figure.nominal = std::move(line);
  figure.ends = LineByLength::Ends::open;
  return figure;
}

Vec3 turned(Vec3 p, int angle_deg) {
  const double a = angle_deg * std::numbers::pi / 180.0;
  return {std::cos(a) * p.x - std::sin(a) * p.y, std::sin(a) * p.x + std::cos(a) * p.y, 0.0};
}

/// Independent Gaussian values smoothed by a Gaussian along rows and columns.
Raster<float> smoothed_noise(std::mt19937_64& random, double sigma_x, double sigma_y) {
  std::normal_distribution<float> normal;
  Raster<float> field(kFigureWidth, kFigureHeight);
  for (float& v : field.values()) v = normal(random);
  const auto smooth = [&field](double sigma, int dx, int dy) {
    const int reach = static_cast<int>(std::ceil(3.0 * sigma));
    std::vector<float> kernel;
    for (int k = -reach; k <= reach; ++k)
      kernel.push_back(static_cast<float>(std::exp(-0.5 * k * k / (sigma * sigma))));
    const Raster<float> from = field;
    for (int y = 0; y < kFigureHeight; ++y)
      for (int x = 0; x < kFigureWidth; ++x) {
        float sum = 0.0F;
        for (int k = -reach; k <= reach; ++k)
          sum +=
              kernel[static_cast<std::size_t>(k + reach)] *
              from(std::clamp(x + k * dx, 0, kFigureWidth - 1), std::clamp(y + k * dy, 0, kFigureHeight - 1));
        field(x, y) = sum;
      }
  };
  smooth(sigma_x, 1, 0);
  smooth(sigma_y, 0, 1);
  return field;
}

}  // namespace

TracingFigure rectangle_figure() {
  return filled("rectangle", millimetres({{-40, -25, 0}, {40, -25, 0}, {40, 25, 0}, {-40, 25, 0}}));
}

TracingFigure letter_h_figure() {
  return filled("letter-h", millimetres({{-25, -35, 0},
                                         {-11, -35, 0},
                                         {-11, -7, 0},
                                         {11, -7, 0},
                                         {11, -35, 0},
                                         {25, -35, 0},
                                         {25, 35, 0},
                                         {11, 35, 0},
                                         {11, 7, 0},
                                         {-11, 7, 0},
                                         {-11, 35, 0},
                                         {-25, 35, 0}}));
}

TracingFigure ultrasound_figure(std::uint64_t seed) {
  std::vector<Vec3> outline;
  constexpr int kPoints = 360;
  constexpr double kRadius_m = 0.0110;
  for (int k = 0; k < kPoints; ++k) {
    const double a = 2.0 * std::numbers::pi * k / kPoints;
    const double r = kRadius_m * (1.0 + 0.14 * std::cos(2.0 * a + 0.4) + 0.06 * std::cos(3.0 * a + 1.9) +
                                  0.02 * std::cos(5.0 * a));
    outline.push_back({r * std::cos(a), r * std::sin(a), 0.0});
  }
  TracingFigure figure = filled("ultrasound", std::move(outline));
  // Speckle is wider than high, since axial resolution is better than lateral resolution.
  constexpr double kAcross_px = 2.5, kDown_px = 1.2;
  constexpr double kInside_dB = -12.0, kAttenuation_dB = -8.0, kRange_dB = 50.0;
  const Raster<float> covered = coverage_of(figure.nominal);
  std::mt19937_64 random(seed);
  const auto real = smoothed_noise(random, kAcross_px, kDown_px);
  const auto imaginary = smoothed_noise(random, kAcross_px, kDown_px);
  double power = 0.0;
  for (std::size_t k = 0; k < real.count(); ++k) power += double{real.values()[k]} * double{real.values()[k]};
  power /= static_cast<double>(real.count());
  for (int y = 0; y < kFigureHeight; ++y)
    for (int x = 0; x < kFigureWidth; ++x) {
      const double size2 =
          (double{real(x, y)} * double{real(x, y)} + double{imaginary(x, y)} * double{imaginary(x, y)}) /
          (2.0 * power);
      const double dB = 10.0 * std::log10(size2 + 1e-6) + kInside_dB * double{covered(x, y)} +
                        kAttenuation_dB * y / kFigureHeight;
      // The mean of bright tissue is at three quarters of the range.
      const double grey = std::clamp(0.75 + dB / kRange_dB, 0.0, 1.0);
      figure.picture(x, y) = static_cast<std::uint8_t>(std::lround(255.0 * grey));
    }
  return figure;
}

TracingFigure line_figure(int angle_deg) {
  std::vector<Vec3> line;
  constexpr int kPieces = 60;
  for (int k = 0; k <= kPieces; ++k)
    line.push_back(turned({0.060 * (static_cast<double>(k) / kPieces - 0.5), 0.0, 0.0}, angle_deg));
  return stroke(fmt::format("line-{:03}", angle_deg), std::move(line));
}

TracingFigure semicircle_figure(int angle_deg) {
  std::vector<Vec3> line;
  constexpr int kPieces = 180;
  constexpr double kRadius_m = 0.030;
  for (int k = 0; k <= kPieces; ++k) {
    const double a = std::numbers::pi * k / kPieces;
    line.push_back(turned({kRadius_m * std::cos(a), kRadius_m * (std::sin(a) - 0.5), 0.0}, angle_deg));
  }
  return stroke(fmt::format("semicircle-{:03}", angle_deg), std::move(line));
}

std::vector<TracingFigure> all_tracing_figures(std::uint64_t seed) {
  std::vector<TracingFigure> all;
  for (const int angle : {0, 45, 90, 135}) all.push_back(line_figure(angle));
  for (const int angle : {0, 45, 90, 135}) all.push_back(semicircle_figure(angle));
  all.push_back(rectangle_figure());
  all.push_back(letter_h_figure());
  all.push_back(ultrasound_figure(seed));
  return all;
}

Image image_of(const TracingFigure& figure) {
  Image image;
  image.width = figure.picture.width();
  image.height = figure.picture.height();
  image.channels = 1;
  for (const std::uint8_t v : figure.picture.values())
    image.samples.push_back(static_cast<float>(v) / 255.0F);
  return image;
}

}  // namespace palpable::study
