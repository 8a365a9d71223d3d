// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// Mean radial errors and times of superquadric fits over random shapes: the table of docs/superquadrics.md.
#include "palpable/sculpt/superquadric/superquadric_cases.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <optional>
#include <vector>

namespace {

using namespace palpable;
using namespace palpable::sculpt;

double at_share(std::vector<double> values, double share) {
  std::sort(values.begin(), values.end());
  return values[static_cast<std::size_t>(share * static_cast<double>(values.size()))];
}

void measure(const char* name, const FitCaseOptions& options, const FitOptions& fit, int cases) {
  std::vector<double> errors, times_ms, relative;
  for (int k = 0; k < cases; ++k) {
    const FitCase c = make_fit_case(static_cast<unsigned>(k + 1), options);
    // Processor time: a fit runs on one thread.
    const std::clock_t begin = std::clock();
    const auto fitted = fit_superquadric(c.points, c.view, fit);
    const double time_ms = 1e3 * static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
    if (!fitted) continue;
    times_ms.push_back(time_ms);
    errors.push_back(mean_radial_error(fitted->shape, c.truth));
    const double size = std::cbrt(c.truth.size_m.x * c.truth.size_m.y * c.truth.size_m.z);
    relative.push_back(errors.back() / size);
  }
  std::printf("%-32s %.4f / %.4f   %.2f / %.2f ms   %.2f / %.2f %% of the size\n", name,
              at_share(errors, 0.5), at_share(errors, 0.9), at_share(times_ms, 0.5), at_share(times_ms, 0.9),
              100.0 * at_share(relative, 0.5), 100.0 * at_share(relative, 0.9));
}

/// Errors of fitted taper and bend. A shape whose z axis is reversed, or whose x and y are exchanged, has
/// another taper for the same surface, so both are compared in the axes of the true shape.
struct ParameterErrors {
  double taper = 0.0;
  /// Bend: curvature times half length.
  double bend = 0.0;
};
std::optional<ParameterErrors> parameter_errors(const models::Superquadric& fitted,
                                                const models::Superquadric& truth) {
  const auto axis = [&](Vec3 v) {
    return truth.scene_from_shape.inverse().rotate(fitted.scene_from_shape.rotate(v));
  };
  const Vec3 x = axis({1.0, 0.0, 0.0}), y = axis({0.0, 1.0, 0.0}), z = axis({0.0, 0.0, 1.0});
  // Fits with another z axis are different parametrisations and do not count.
  if (std::abs(z.z) < 0.9) return std::nullopt;
  const double end = z.z > 0.0 ? 1.0 : -1.0;
  const bool straight = std::abs(x.x) > std::abs(x.y);
  const double taper_x = end * (straight ? fitted.taper_x : fitted.taper_y),
               taper_y = end * (straight ? fitted.taper_y : fitted.taper_x);
  const Vec3 fitted_bend =
      fitted.bend_per_m * (std::cos(fitted.bend_angle_rad) * x + std::sin(fitted.bend_angle_rad) * y);
  const Vec3 true_bend =
      truth.bend_per_m * Vec3{std::cos(truth.bend_angle_rad), std::sin(truth.bend_angle_rad), 0.0};
  return ParameterErrors{std::max(std::abs(taper_x - truth.taper_x), std::abs(taper_y - truth.taper_y)),
                         truth.size_m.z * norm(fitted_bend - true_bend)};
}

void measure_parameters(const char* name, const FitCaseOptions& options, const FitOptions& fit, int cases) {
  std::vector<double> taper, bend;
  for (int k = 0; k < cases; ++k) {
    const FitCase c = make_fit_case(static_cast<unsigned>(k + 1), options);
    const auto fitted = fit_superquadric(c.points, c.view, fit);
    if (!fitted) continue;
    const auto errors = parameter_errors(fitted->shape, c.truth);
    if (!errors) continue;
    taper.push_back(errors->taper);
    bend.push_back(errors->bend);
  }
  if (taper.empty()) return;
  std::printf(
      "%-32s taper off by %.4f / %.4f, bend over its length by %.4f / %.4f (%zu of %d with the same z "
      "axis)\n",
      name, at_share(taper, 0.5), at_share(taper, 0.9), at_share(bend, 0.5), at_share(bend, 0.9),
      taper.size(), cases);
}

}  // namespace

int main() {
  constexpr int kCases = 40;
  using Seen = FitCaseOptions::Seen;
  std::printf("median / 90th percentile of %d shapes: mean radial error, time\n", kCases);
  for (const Seen seen : {Seen::whole, Seen::half})
    for (const double outliers : {0.0, 0.2, 0.4}) {
      FitCaseOptions options;
      options.seen = seen;
      options.outlier_share = outliers;
      char name[64];
      std::snprintf(name, sizeof(name), "%s, %.0f %% outliers", seen == Seen::whole ? "whole" : "half view",
                    100.0 * outliers);
      measure(name, options, {}, kCases);
    }
  FitCaseOptions options;
  measure("whole, solina", options, {FitMethod::solina, FitDeformation::none}, kCases);
  options.outlier_share = 0.4;
  measure("whole, 40 % outliers, solina", options, {FitMethod::solina, FitDeformation::none}, kCases);
  options.outlier_share = 0.0;
  options.deformation = FitDeformation::taper;
  measure("whole, tapered", options, {FitMethod::robust, FitDeformation::taper}, kCases);
  options.deformation = FitDeformation::taper_and_bend;
  measure("whole, tapered and bent", options, {FitMethod::robust, FitDeformation::taper_and_bend}, kCases);
  measure_parameters("whole, tapered and bent", options, {FitMethod::robust, FitDeformation::taper_and_bend},
                     kCases);
  options.deformation = FitDeformation::taper;
  measure_parameters("whole, tapered", options, {FitMethod::robust, FitDeformation::taper}, kCases);
  return 0;
}
