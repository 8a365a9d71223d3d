// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sculpt/superquadric/superquadric_options.hpp"

#include "palpable/sculpt/superquadric/superquadric_residuals.hpp"

#include <utility>

namespace palpable::sculpt {
namespace {

std::vector<Parameter> start_parameters(FitStartOptions& o) {
  return {
      {"core_share", &o.core_share, {0.1, 1.0}, "", "share of the points within a start's half axes"},
      {"exponent", &o.exponent, {0.1, 1.9}, "", "exponents of a start"},
      {"noise", &o.noise, {0.001, 10.0}, "", "standard deviation that a start assumes"},
      {"outliers", &o.outliers, {0.01, 0.8}, "", "share of outliers that a start assumes"},
      {"centre_behind", &o.centre_behind, {0.0, 10.0}, "", "how far a half view's centre lies behind"},
      {"square_section", &o.square_section, {1.0, 10.0}, "", "half axes that differ by less may be turned"},
      {"similar_scatter",
       &o.similar_scatter,
       {1.0, 100.0},
       "",
       "factor of scatter along axes below which fourth moments give axes too"},
      {"switched_noise_factor", &o.switched_noise_factor, {1.0, 100.0}, "", "noise of a switched start"},
      {"least_switched_noise", &o.least_switched_noise, {0.001, 10.0}, "", "least noise of such a start"},
      {"taper", &o.taper, {0.0, 1.0}, "", "taper of a deformed start"}};
}

std::vector<Parameter> weight_parameters(FitWeightOptions& o) {
  return {{"least_outliers", &o.least_outliers, {0.001, 0.999}, "", "least share of outliers"},
          {"most_outliers", &o.most_outliers, {0.001, 0.999}, "", "greatest share of outliers"},
          {"least_inlier_share", &o.least_inlier_share, {0.0, 1.0}, "", "inliers that an estimate needs"},
          {"least_noise", &o.least_noise, {1e-9, 1.0}, "", "least standard deviation"},
          {"coarse_noise", &o.coarse_noise, {0.0, 10.0}, "", "noise that is mostly misfit"},
          {"coarse_noise_factor", &o.coarse_noise_factor, {0.01, 1.0}, "", "how fast it is reduced"},
          {"stray_sights", &o.stray_sights, {1e-6, 1.0}, "", "density of stray lines of sight"},
          {"stray_sights_cost", &o.stray_sights_cost, {1e-6, 1.0}, "", "the same for the cost"},
          {"least_free_noise", &o.least_free_noise, {1e-6, 1.0}, "", "noise of free space's border"}};
}

std::vector<Parameter> search_parameters(FitSearchOptions& o) {
  std::vector<Parameter> parameters{
      {"many_outliers", &o.many_outliers, {0.0, 1.0}, "", "share of outliers that needs another round"},
      {"switches", &o.switches, {0, 100}, "", "how often switched shapes are tried"},
      {"last_noise_factor", &o.last_noise_factor, {1.0, 100.0}, "", "noise before the last rounds"},
      {"settled_noise", &o.settled_noise, {0.0, 1.0}, "", "relative fall of the noise that ends a run"},
      {"settled_cost", &o.settled_cost, {0.0, 10.0}, "per point", "fall of the cost that ends a run"},
      {"hopeless_after", &o.hopeless_after, {0, 1000}, "", "rounds before a run is given up"},
      {"hopeless_deviation", &o.hopeless_deviation, {1.0, 1000.0}, "", "deviation that ends a search"},
      {"hoped_gain", &o.hoped_gain, {0.0, 100.0}, "", "hoped gain of a round over the last one's"}};
  const auto count = [&](const char* name, int& value, const char* meaning) {
    parameters.push_back({name, &value, {1, 1000}, "", meaning});
  };
  count("points", o.points, "points that the search uses");
  count("free", o.free, "free places that the search uses");
  count("sights", o.sights, "lines of sight that the search uses");
  count("last_sights", o.last_sights, "lines of sight that the last rounds use");
  count("start_rounds", o.start_rounds, "rounds of each start");
  count("start_steps", o.start_steps, "steps in each of them");
  count("best_rounds", o.best_rounds, "rounds of the two best starts");
  count("best_steps", o.best_steps, "steps in each of them");
  count("switched_rounds", o.switched_rounds, "rounds of a switched shape");
  count("switched_steps", o.switched_steps, "steps in each of them");
  count("deformed_rounds", o.deformed_rounds, "rounds of each deformed shape");
  count("deformed_steps", o.deformed_steps, "steps in each of them");
  count("deformed_kept", o.deformed_kept, "deformed shapes that get more rounds");
  count("last_deformed_rounds", o.last_deformed_rounds, "rounds of these");
  count("last_deformed_steps", o.last_deformed_steps, "steps in each of them");
  count("last_rounds", o.last_rounds, "rounds over all points");
  count("last_steps", o.last_steps, "steps in each of them");
  return parameters;
}

}  // namespace

int parameter_count(FitDeformation deformation) {
  switch (deformation) {
    case FitDeformation::none:
      return kPlainParameters;
    case FitDeformation::taper:
      return kTaperParameters;
    case FitDeformation::taper_and_bend:
      break;
  }
  return kBendParameters;
}

FitDeformation deformation_of(int count) {
  if (count <= kPlainParameters) return FitDeformation::none;
  return count <= kTaperParameters ? FitDeformation::taper : FitDeformation::taper_and_bend;
}

std::vector<Parameter> parameters_of(FitOptions& o) {
  std::vector<Parameter> parameters;
  append_parameters(parameters, "starts", start_parameters(o.starts));
  append_parameters(parameters, "weights", weight_parameters(o.weights));
  append_parameters(parameters, "search", search_parameters(o.search));
  return parameters;
}

Result<void> check(const FitOptions& options) {
  if (auto valid = check_ranges(options); !valid) return valid;
  if (options.weights.least_outliers > options.weights.most_outliers)
    return Error{ErrorCode::usage, "the first must not exceed the second",
                 "weights.least_outliers, weights.most_outliers"};
  return {};
}

}  // namespace palpable::sculpt
