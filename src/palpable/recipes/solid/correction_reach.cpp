// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/recipes/solid/correction_reach.hpp"

#include "palpable/core/numbers/quantile.hpp"

#include <algorithm>

namespace palpable::recipes {

std::vector<Parameter> parameters_of(CorrectionReachOptions& o) {
  return {{"reach_quantile",
           &o.quantile,
           {0.5, 1},
           "",
           "Quantile of the points' distances from the superquadrics that is the reach"},
          {"least_reach_spacings", &o.least_spacings, {0.5, 20}, "", "Least reach, spacings of samples"},
          {"most_reach_share", &o.most_share, {0.001, 0.5}, "", "Greatest reach, share of the extent"},
          {"transition_reaches", &o.transition_reaches, {1, 10}, "", "Width of the transition, reaches"}};
}

std::vector<Parameter> without_reach(std::vector<Parameter> of_correction) {
  std::erase_if(of_correction,
                [](const Parameter& p) { return p.name == "reach_m" || p.name == "transition_m"; });
  return of_correction;
}

void set_reach(const CorrectionReachOptions& options, std::vector<double> residuals, double spacing,
               double extent, sculpt::CorrectionOptions& correction) {
  const double residual = residuals.empty() ? 0.0 : quantile_of(residuals, options.quantile);
  correction.reach_m =
      std::max(std::min(residual, options.most_share * extent), options.least_spacings * spacing);
  correction.transition_m = options.transition_reaches * correction.reach_m;
}

}  // namespace palpable::recipes
