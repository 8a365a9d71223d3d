// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sculpt/field/leaf_quadratic.hpp"

#include <algorithm>
#include <cmath>

namespace palpable::sculpt {
namespace {

using models::DistanceSample;

/// The weight of the gradient, relative to the value.
constexpr double kGradientWeight = 0.25;

/// A row of the least-squares problem for a value, or one axis of the gradient.
Quadratic value_row(Vec3 u) {
  return {1.0, u.x, u.y, u.z, u.x * u.x, u.y * u.y, u.z * u.z, u.x * u.y, u.x * u.z, u.y * u.z};
}
std::array<Quadratic, 3> gradient_rows(Vec3 u) {
  return {{{0, 1, 0, 0, 2 * u.x, 0, 0, u.y, u.z, 0},
           {0, 0, 1, 0, 0, 2 * u.y, 0, u.x, 0, u.z},
           {0, 0, 0, 1, 0, 0, 2 * u.z, 0, u.x, u.y}}};
}

/// Normal equations, solved by Cholesky's method.
class Fit {
 public:
  void add(const Quadratic& row, double value, double weight) {
    for (std::size_t i = 0; i < kQuadraticTerms; ++i) {
      const double w = weight * row[i];
      if (w == 0.0) continue;
      right_[i] += w * value;
      for (std::size_t j = 0; j <= i; ++j) matrix_[i][j] += w * row[j];
    }
  }
  Quadratic solve() {
    constexpr double kRidge = 1e-9;
    for (std::size_t i = 0; i < kQuadraticTerms; ++i) {
      matrix_[i][i] += kRidge;
      for (std::size_t j = 0; j <= i; ++j) {
        double sum = matrix_[i][j];
        for (std::size_t k = 0; k < j; ++k) sum -= matrix_[i][k] * matrix_[j][k];
        matrix_[i][j] = i == j ? std::sqrt(std::max(sum, kRidge)) : sum / matrix_[j][j];
      }
    }
    Quadratic c = right_;
    for (std::size_t i = 0; i < kQuadraticTerms; ++i) {
      for (std::size_t k = 0; k < i; ++k) c[i] -= matrix_[i][k] * c[k];
      c[i] /= matrix_[i][i];
    }
    for (std::size_t i = kQuadraticTerms; i-- > 0;) {
      for (std::size_t k = i + 1; k < kQuadraticTerms; ++k) c[i] -= matrix_[k][i] * c[k];
      c[i] /= matrix_[i][i];
    }
    return c;
  }

 private:
  std::array<Quadratic, kQuadraticTerms> matrix_{};
  Quadratic right_{};
};

/// The rows of one sample point: its value and its gradient.
std::array<Quadratic, 4> rows_at(std::size_t k) {
  const Vec3 u = fit_place(k);
  const auto rows = gradient_rows(u);
  return {value_row(u), rows[0], rows[1], rows[2]};
}
std::array<double, 4> values_at(const CellSamples& samples, std::size_t k) {
  const DistanceSample& s = samples.at[k];
  return {s.distance_m / samples.half_m, s.gradient.x, s.gradient.y, s.gradient.z};
}
constexpr std::array<double, 4> kRowWeights{1.0, kGradientWeight, kGradientWeight, kGradientWeight};

/// The fit to all places is the same linear map in every cell.
class WholeFit {
 public:
  WholeFit() {
    for (std::size_t k = 0; k < kFitPlaces; ++k)
      for (std::size_t row = 0; row < 4; ++row) {
        Fit fit;
        for (std::size_t other = 0; other < kFitPlaces; ++other) {
          const auto rows = rows_at(other);
          for (std::size_t r = 0; r < 4; ++r)
            fit.add(rows[r], other == k && r == row ? 1.0 : 0.0, kRowWeights[r]);
        }
        by_value_[4 * k + row] = fit.solve();
      }
  }
  Quadratic solve(const CellSamples& samples) const {
    Quadratic c{};
    for (std::size_t k = 0; k < kFitPlaces; ++k) {
      const auto values = values_at(samples, k);
      for (std::size_t row = 0; row < 4; ++row)
        for (std::size_t i = 0; i < kQuadraticTerms; ++i) c[i] += values[row] * by_value_[4 * k + row][i];
    }
    return c;
  }

 private:
  std::array<Quadratic, 4 * kFitPlaces> by_value_;
};

}  // namespace

Quadratic quadratic_through(const CellSamples& samples, const std::array<bool, kFitPlaces>& wanted) {
  Fit fit;
  for (std::size_t k = 0; k < kFitPlaces; ++k) {
    if (!wanted[k]) continue;
    const auto rows = rows_at(k);
    const auto values = values_at(samples, k);
    for (std::size_t row = 0; row < 4; ++row) fit.add(rows[row], values[row], kRowWeights[row]);
  }
  // Places on one face do not determine how the polynomial bends away from it. Without a preference for a
  // straight one it is arbitrary there, where another piece may give way to it: up to 40 um in a cell of 0.5
  // mm.
  constexpr double kStraight = 0.01;
  for (std::size_t bend = 4; bend < kQuadraticTerms; ++bend) {
    Quadratic row{};
    row[bend] = 1.0;
    fit.add(row, 0.0, kStraight);
  }
  return fit.solve();
}
Quadratic quadratic_through(const CellSamples& samples) {
  static const WholeFit whole;
  return whole.solve(samples);
}

}  // namespace palpable::sculpt
