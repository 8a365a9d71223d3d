// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/sculpt/superquadric/superquadric_options.hpp"
#include "palpable/sculpt/superquadric/superquadric_residuals.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

#include <Eigen/Core>

// Inside sculpt's sources only.
namespace palpable::sculpt {

/// Residuals for Ceres' small dense solver. The weights, and the points where lines of sight touch, are fixed
/// while it runs.
struct WeightedResiduals {
  using Scalar = double;
  enum { NUM_RESIDUALS = Eigen::Dynamic, NUM_PARAMETERS = Eigen::Dynamic };

  const Columns& places;
  const std::vector<double>& weights;
  const std::array<double, 9>& reference;
  const Parameters& rest;
  int count;
  FitMethod method;

  int NumResiduals() const { return static_cast<int>(places.count()); }
  int NumParameters() const { return count; }

  bool operator()(const double* at, double* residuals, double* jacobian) const {
    Parameters parameters = rest;
    std::copy_n(at, count, parameters.begin());
    const ResidualsAt here(parameters, reference, count);
    if (method == FitMethod::robust) {
      here.radial_rows_of(places, weights, residuals, jacobian);
      return true;
    }
    const std::size_t rows = places.count();
    for (std::size_t i = 0; i < rows; ++i) {
      const Residual r = here.solina_with_derivatives(places.at(i));
      residuals[i] = r.value;
      if (jacobian == nullptr) continue;
      for (std::size_t k = 0; k < static_cast<std::size_t>(count); ++k) jacobian[k * rows + i] = r.by[k];
    }
    return true;
  }
};

}  // namespace palpable::sculpt
