// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sculpt/superquadric/superquadric_fit.hpp"

#include "palpable/sculpt/superquadric/superquadric_cases.hpp"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace palpable::sculpt {
namespace {

using Seen = FitCaseOptions::Seen;

struct Errors {
  double median = 0.0;
  double p90 = 0.0;
};

Errors errors_of(const FitCaseOptions& options, int cases, const FitOptions& fit = {}) {
  std::vector<double> errors;
  for (int k = 0; k < cases; ++k) {
    const FitCase c = make_fit_case(static_cast<unsigned>(k + 1), options);
    const auto fitted = fit_superquadric(c.points, c.view, fit);
    EXPECT_TRUE(fitted.has_value());
    errors.push_back(mean_radial_error(fitted->shape, c.truth));
  }
  std::sort(errors.begin(), errors.end());
  return {errors[errors.size() / 2], errors[errors.size() * 9 / 10]};
}

TEST(SuperquadricResiduals, HaveTheDerivativesOfFiniteDifferences) {
  for (const int count : {kPlainParameters, kTaperParameters, kBendParameters}) {
    FitCaseOptions options;
    options.deformation = count == kBendParameters    ? FitDeformation::taper_and_bend
                          : count == kTaperParameters ? FitDeformation::taper
                                                      : FitDeformation::none;
    const FitCase c = make_fit_case(5, options);
    std::array<double, 9> reference{};
    Parameters at = parameters_of(c.truth, reference);
    at[3] = 0.2, at[4] = -0.3, at[5] = 0.1;
    const ResidualsAt here(at, reference, count);
    for (std::size_t i = 0; i < 5; ++i) {
      const Vec3 p = c.points[i];
      const Residual radial = here.radial_with_derivatives(p);
      const Residual solina = here.solina_with_derivatives(p);
      EXPECT_NEAR(radial.value, here.radial(p), 1e-9);
      EXPECT_NEAR(solina.value, here.solina(p), 1e-9);
      for (std::size_t k = 0; k < static_cast<std::size_t>(count); ++k) {
        Parameters more = at, less = at;
        more[k] += 1e-5;
        less[k] -= 1e-5;
        const ResidualsAt after(more, reference, count), before(less, reference, count);
        EXPECT_NEAR(radial.by[k], (after.radial(p) - before.radial(p)) / 2e-5, 1e-3) << count << ' ' << k;
        EXPECT_NEAR(solina.by[k], (after.solina(p) - before.solina(p)) / 2e-5, 1e-2) << count << ' ' << k;
      }
    }
  }
}

TEST(SuperquadricFit, FindsAWholeCloudsShape) {
  const Errors e = errors_of({}, 8);
  EXPECT_LE(e.median, 0.0015);
  EXPECT_LE(e.p90, 0.0025);
}

TEST(SuperquadricFit, FindsItAmongFortyPercentOfOutliers) {
  FitCaseOptions options;
  options.outlier_share = 0.4;
  EXPECT_LE(errors_of(options, 7).median, 0.002);
}

TEST(SuperquadricFit, FindsAHalfSeenShapeByItsOutline) {
  for (const double outliers : {0.0, 0.4}) {
    FitCaseOptions options;
    options.seen = Seen::half;
    options.outlier_share = outliers;
    const Errors e = errors_of(options, 5);
    EXPECT_LE(e.median, 0.01) << outliers;
    EXPECT_LE(e.p90, 0.04) << outliers;
  }
}

TEST(SuperquadricFit, FindsTaperAndBend) {
  FitCaseOptions options;
  options.deformation = FitDeformation::taper;
  EXPECT_LE(errors_of(options, 4, {FitMethod::robust, FitDeformation::taper}).median, 0.003);
  options.deformation = FitDeformation::taper_and_bend;
  EXPECT_LE(errors_of(options, 4, {FitMethod::robust, FitDeformation::taper_and_bend}).median, 0.01);
}

TEST(SuperquadricFit, PlainLeastSquaresFollowsOutliersAway) {
  FitCaseOptions options;
  const FitOptions solina{FitMethod::solina, FitDeformation::none};
  EXPECT_LE(errors_of(options, 6, solina).median, 0.03);
  options.outlier_share = 0.4;
  EXPECT_GE(errors_of(options, 6, solina).median, 0.1);
}

TEST(SuperquadricFit, KeepsTheScaleAndPlaceOfItsPoints) {
  FitCase c = make_fit_case(3, {});
  for (Vec3& p : c.points) p = 0.001 * p + Vec3{50.0, -20.0, 3.0};
  const auto fitted = fit_superquadric(c.points, c.view);
  ASSERT_TRUE(fitted.has_value());
  EXPECT_NEAR(fitted->noise_m, 1e-5, 3e-6);
  EXPECT_LT(norm(fitted->shape.scene_from_shape.translation_m -
                 (0.001 * c.truth.scene_from_shape.translation_m + Vec3{50.0, -20.0, 3.0})),
            5e-6);
}

TEST(SuperquadricFit, ReturnsToAShapeThatItIsToldToStartNear) {
  const FitCase c = make_fit_case(3, {});
  FitExpectation expected;
  expected.start = c.truth;
  expected.start->size_m *= 1.1;
  const auto near = fit_superquadric(c.points, c.view, {}, {}, expected);
  ASSERT_TRUE(near.has_value());
  EXPECT_LT(norm(near->shape.size_m - c.truth.size_m), 0.02 * norm(c.truth.size_m));
  EXPECT_LT(norm(near->shape.scene_from_shape.translation_m - c.truth.scene_from_shape.translation_m),
            0.02 * norm(c.truth.size_m));
}

TEST(SuperquadricFit, EndsItsSearchWhereNoShapeCanBeOfUse) {
  FitCaseOptions noisy;
  noisy.outlier_share = 0.4;
  const FitCase c = make_fit_case(3, noisy);
  const auto searched = fit_superquadric(c.points, c.view);
  FitExpectation expected;
  expected.most_deviation_m = 1e6;
  const auto hopeful = fit_superquadric(c.points, c.view, {}, {}, expected);
  expected.most_deviation_m = 1e-9;
  const auto hopeless = fit_superquadric(c.points, c.view, {}, {}, expected);
  ASSERT_TRUE(searched && hopeful && hopeless);
  EXPECT_EQ(hopeful->error_m, searched->error_m);
  EXPECT_NE(hopeless->error_m, searched->error_m);
}

TEST(SuperquadricFit, ObeysItsParametersAndRefusesThemOutOfRange) {
  const FitCase c = make_fit_case(3, {});
  FitOptions options;
  for (const Parameter& p : parameters_of(options)) {
    ASSERT_TRUE(set_parameter(p, p.get())) << p.name;
    EXPECT_FALSE(set_parameter(p, p.range.most + 1.0)) << p.name;
  }
  options.starts.exponent = 1.3;
  options.search.switches = 0;
  options.search.settled_noise = options.search.settled_cost = 0.0;
  const auto changed = fit_superquadric(c.points, c.view, options),
             usual = fit_superquadric(c.points, c.view);
  ASSERT_TRUE(changed && usual);
  EXPECT_NE(changed->shape.e1, usual->shape.e1);
  options.weights.least_outliers = 0.9;
  const auto refused = fit_superquadric(c.points, c.view, options);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::usage);
}

TEST(SuperquadricFit, RefusesPointsThatDetermineNoSolid) {
  std::vector<Vec3> flat;
  flat.reserve(100);
  for (int row = 0; row < 10; ++row)
    for (int column = 0; column < 10; ++column) flat.push_back({0.1 * column, 0.1 * row, 0.0});
  EXPECT_FALSE(fit_superquadric(flat, {}).has_value());
  EXPECT_FALSE(fit_superquadric(std::vector<Vec3>(50, Vec3{1, 2, 3}), {}).has_value());
  EXPECT_FALSE(fit_superquadric(std::vector<Vec3>(5, Vec3{1, 2, 3}), {}).has_value());
  flat[3].x = std::nan("");
  EXPECT_FALSE(fit_superquadric(flat, {}).has_value());
}

}  // namespace
}  // namespace palpable::sculpt
