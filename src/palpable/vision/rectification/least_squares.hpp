// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <utility>
#include <vector>

#include <opencv2/core.hpp>

// Inside vision's sources only.
namespace palpable::vision {

inline double squares_of(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double v : values) sum += v * v;
  return sum;
}

/// Levenberg-Marquardt from `at` with numerical derivatives. `residuals` gives the same number of values for
/// every argument.
template <int Count, class Residuals>
cv::Vec<double, Count> least_squares(const Residuals& residuals, cv::Vec<double, Count> at) {
  using Values = cv::Vec<double, Count>;
  constexpr double kStep = 1e-6;
  std::vector<double> now = residuals(at);
  double damping = 1e-3;
  for (int i = 0; i < 60 && damping < 1e9; ++i) {
    std::vector<Values> rows(now.size());
    for (int k = 0; k < Count; ++k) {
      Values stepped = at;
      stepped[k] += kStep;
      const std::vector<double> then = residuals(stepped);
      for (std::size_t r = 0; r < now.size(); ++r) rows[r][k] = (then[r] - now[r]) / kStep;
    }
    cv::Matx<double, Count, Count> normal = cv::Matx<double, Count, Count>::zeros();
    Values right = Values::all(0.0);
    for (std::size_t r = 0; r < now.size(); ++r) {
      normal += rows[r] * rows[r].t();
      right -= now[r] * rows[r];
    }
    for (int k = 0; k < Count; ++k) normal(k, k) *= 1.0 + damping;
    const Values candidate = at + Values(normal.solve(right, cv::DECOMP_SVD));
    std::vector<double> then = residuals(candidate);
    const double gain = squares_of(now) - squares_of(then);
    damping = gain > 0.0 ? std::max(1e-9, damping / 4.0) : damping * 8.0;
    if (!(gain > 0.0)) continue;
    at = candidate;
    now = std::move(then);
    if (gain < 1e-6 * squares_of(now)) break;
  }
  return at;
}

}  // namespace palpable::vision
