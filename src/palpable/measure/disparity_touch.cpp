// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/measure/disparity_touch.hpp"

#include "palpable/core/vec3.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace palpable::measure {
namespace {

constexpr double kLongerSide_mm = 100.0;
constexpr double kHeight_mm = 15.0;
constexpr double kStep_mm = 0.25;
constexpr int kReach = 2;

/// Both maps as heights in millimetres; NaN where either is unknown or the mask is not white.
struct Reliefs {
  Raster<float> result_mm;
  Raster<float> truth_mm;
  double pixel_mm = 0.0;
};

Result<Reliefs> reliefs_of(const Raster<float>& result_px, const Raster<float>& truth_px,
                           const Raster<std::uint8_t>& mask) {
  const auto same = [&](int width, int height) {
    return truth_px.width() == width && truth_px.height() == height;
  };
  if (!same(result_px.width(), result_px.height()) || (!mask.empty() && !same(mask.width(), mask.height())))
    return invalid_input("the result, the truth and the mask must have the same size");
  constexpr float kUnknown = std::numeric_limits<float>::quiet_NaN();
  Reliefs out{Raster<float>(truth_px.width(), truth_px.height(), kUnknown),
              Raster<float>(truth_px.width(), truth_px.height(), kUnknown),
              kLongerSide_mm / std::max(truth_px.width(), truth_px.height())};
  float low = std::numeric_limits<float>::infinity(), high = -low;
  const auto counts = [&](std::size_t i) {
    return std::isfinite(truth_px.values()[i]) && (mask.empty() || mask.values()[i] == 255);
  };
  for (std::size_t i = 0; i < truth_px.count(); ++i) {
    if (!counts(i)) continue;
    low = std::min(low, truth_px.values()[i]);
    high = std::max(high, truth_px.values()[i]);
  }
  if (!(high > low)) return invalid_input("the truth has no range of disparities to make a relief of");
  const float mm_per_px = static_cast<float>(kHeight_mm) / (high - low);
  for (std::size_t i = 0; i < truth_px.count(); ++i) {
    if (!counts(i) || !std::isfinite(result_px.values()[i])) continue;
    out.truth_mm.values()[i] = mm_per_px * truth_px.values()[i];
    out.result_mm.values()[i] = mm_per_px * result_px.values()[i];
  }
  return out;
}

/// The normal of the plane fitted to the 5 x 5 heights about a pixel; false if one is unknown.
bool normal_at(const Raster<float>& height_mm, double pixel_mm, int x, int y, Vec3& normal) {
  double across = 0.0, down = 0.0, squares = 0.0;
  for (int v = -kReach; v <= kReach; ++v)
    for (int u = -kReach; u <= kReach; ++u) {
      const double z = static_cast<double>(height_mm(x + u, y + v));
      if (!std::isfinite(z)) return false;
      across += u * z;
      down += v * z;
      squares += u * u;
    }
  normal = unit({-across / (squares * pixel_mm), down / (squares * pixel_mm), 1.0});
  return true;
}

/// Whether the truth has no step in the window.
bool is_smooth(const Raster<float>& truth_mm, int x, int y) {
  float low = truth_mm(x, y), high = low;
  for (int v = -kReach; v <= kReach; ++v)
    for (int u = -kReach; u <= kReach; ++u) {
      low = std::min(low, truth_mm(x + u, y + v));
      high = std::max(high, truth_mm(x + u, y + v));
    }
  // A rise of less than one step per pixel is a slope.
  return static_cast<double>(high - low) <= 2 * kReach * kStep_mm;
}

double mean_normal_error_deg(const Reliefs& reliefs) {
  double sum = 0.0, count = 0.0;
  Vec3 felt, true_normal;
  for (int y = kReach; y + kReach < reliefs.truth_mm.height(); ++y)
    for (int x = kReach; x + kReach < reliefs.truth_mm.width(); ++x) {
      if (!normal_at(reliefs.truth_mm, reliefs.pixel_mm, x, y, true_normal) ||
          !is_smooth(reliefs.truth_mm, x, y) || !normal_at(reliefs.result_mm, reliefs.pixel_mm, x, y, felt))
        continue;
      sum += std::acos(std::clamp(dot(felt, true_normal), -1.0, 1.0));
      count += 1.0;
    }
  return count > 0.0 ? 180.0 / std::numbers::pi * sum / count : std::numeric_limits<double>::quiet_NaN();
}

struct Steps {
  double spurious = 0.0;
  double passed = 0.0;
};

void pass(const Reliefs& reliefs, int x, int y, int x2, int y2, Steps& steps) {
  const auto rise = [&](const Raster<float>& z) {
    return static_cast<double>(z(x2, y2)) - static_cast<double>(z(x, y));
  };
  const double felt = rise(reliefs.result_mm), there = rise(reliefs.truth_mm);
  if (!std::isfinite(felt)) return;
  steps.passed += 1.0;
  if (std::abs(there) <= kStep_mm && std::abs(felt - there) > kStep_mm) steps.spurious += 1.0;
}

}  // namespace

Result<DisparityTouch> touch_of_disparity(const Raster<float>& result_px, const Raster<float>& truth_px,
                                          const Raster<std::uint8_t>& mask) {
  const auto reliefs = reliefs_of(result_px, truth_px, mask);
  if (!reliefs) return reliefs.error();
  Steps steps;
  for (int y = 0; y < truth_px.height(); ++y)
    for (int x = 0; x < truth_px.width(); ++x) {
      if (x + 1 < truth_px.width()) pass(*reliefs, x, y, x + 1, y, steps);
      if (y + 1 < truth_px.height()) pass(*reliefs, x, y, x, y + 1, steps);
    }
  DisparityTouch out;
  out.normal_error_deg = mean_normal_error_deg(*reliefs);
  out.path_cm = steps.passed * reliefs->pixel_mm / 10.0;
  out.spurious_steps_per_cm =
      out.path_cm > 0.0 ? steps.spurious / out.path_cm : std::numeric_limits<double>::quiet_NaN();
  return out;
}

}  // namespace palpable::measure
