// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// Mean radial errors and times of superquadric fits over random shapes: the table of docs/superquadrics.md.
#include "palpable/sculpt/superquadric_cases.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>

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
  return 0;
}
