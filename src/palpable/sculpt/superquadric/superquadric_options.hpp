// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/parameters.hpp"

#include <vector>

// Parameters of the fit of one superquadric. Lengths are relative to the evidence's scale: the median
// distance of the points from their median is 1. Defaults were chosen on the random shapes of
// superquadric_cases.hpp (docs/superquadrics.md).
namespace palpable::sculpt {

/// `solina`: plain Levenberg-Marquardt on the papers' cost (Solina & Bajcsy 1990), as Moustakas 2007 fits.
/// `robust`: points and lines of sight that fit no surface get low weights; several starts, axes permuted.
enum class FitMethod { robust, solina };
enum class FitDeformation { none, taper, taper_and_bend };

/// Numbers that describe a shape that may be deformed so.
int parameter_count(FitDeformation deformation);
/// The least deformation with so many.
FitDeformation deformation_of(int parameter_count);

/// The starts of the search (superquadric_starts.hpp).
struct FitStartOptions {
  /// Half axes are the half widths of this share of the points along each axis. 0.1 … 1.
  double core_share = 0.7;
  /// Both exponents of a start. 0.1 … 1.9.
  double exponent = 0.6;
  /// Standard deviation of the points and share of outliers that a start assumes. 0.001 … 10; 0.01 … 0.8.
  double noise = 0.3;
  double outliers = 0.2;
  /// The centre of a half view lies behind the points by this share of their width. 0 … 10.
  double centre_behind = 0.7;
  /// Sections whose half axes differ by at most this factor are also tried turned by 45 degrees. 1 … 10.
  double square_section = 1.5;
  /// Where the scatter along two axes differs at most by this factor, axes by fourth moments are tried too. 1
  /// … 100.
  double similar_scatter = 1.5;
  /// A switched start (another axis as z, a turned section) has this multiple of the noise, at least the
  /// least noise. 1 … 100; 0.001 … 10.
  double switched_noise_factor = 4.0;
  double least_switched_noise = 0.1;
  /// Taper of a deformed start, either way. 0 … 1.
  double taper = 0.4;
};

/// The weights of points and lines of sight: expectation and maximisation (as Liu et al. 2022).
struct FitWeightOptions {
  /// Bounds of the outliers' share. 0.001 … 0.999, ascending.
  double least_outliers = 0.01;
  double most_outliers = 0.8;
  /// Noise and outliers are estimated again if at least this share of the points belongs to the surface. 0
  /// … 1.
  double least_inlier_share = 0.02;
  /// Least standard deviation of the points. 1e-9 … 1.
  double least_noise = 1e-5;
  /// Above this noise, which is then mostly misfit, each round reduces it at least by the factor. 0 … 10;
  /// 0.01 … 1.
  double coarse_noise = 0.04;
  double coarse_noise_factor = 0.85;
  /// Density of stray lines of sight relative to the peak of the others: for their weight, and for the cost.
  /// 1e-6 … 1 each.
  double stray_sights = 0.1;
  double stray_sights_cost = 1e-3;
  /// Standard deviation of the border of free space, at least. 1e-6 … 1.
  double least_free_noise = 0.02;
};

/// The rounds of the search. Each round estimates the weights and then takes at most `steps` steps of
/// Levenberg-Marquardt; all counts 1 … 1000.
struct FitSearchOptions {
  /// Points, lines of sight and free places that the search uses; the last rounds use all points and places,
  /// and more lines.
  int points = 150;
  int sights = 36;
  int free = 100;
  int last_sights = 240;
  /// Rounds of every start, and one more if the best has more outliers than this (0 … 1) or for a half view.
  int start_rounds = 3, start_steps = 2;
  double many_outliers = 0.1;
  /// Rounds of the two best starts.
  int best_rounds = 6, best_steps = 3;
  /// How often all switched shapes of the best one are tried, 0 … 100, and their rounds.
  int switches = 4;
  int switched_rounds = 8, switched_steps = 3;
  /// Rounds of deformed shapes; the best of them, `deformed_kept`, get more.
  int deformed_rounds = 4, deformed_steps = 3;
  int deformed_kept = 4;
  int last_deformed_rounds = 12, last_deformed_steps = 4;
  /// Rounds over all points, which start with this multiple of the noise, 1 … 100.
  int last_rounds = 6, last_steps = 3;
  double last_noise_factor = 1.5;
  /// A run ends if the noise falls by less than this share (0 … 1) and the cost by less than this per point
  /// (0 … 10).
  double settled_noise = 0.03;
  double settled_cost = 1e-3;
  /// After this many rounds (0 … 1000) a run also ends if it cannot beat the best shape although each further
  /// round gained this multiple of the last gain (0 … 100).
  int hopeless_after = 3;
  double hoped_gain = 2.0;
  /// Before the most expensive rounds, a search ends that is this many times farther from the points than can
  /// be of use (FitExpectation). 1 … 1000.
  double hopeless_deviation = 2.0;
};

struct FitOptions {
  FitMethod method = FitMethod::robust;
  FitDeformation deformation = FitDeformation::none;
  /// Of FitMethod::robust.
  FitStartOptions starts = {};
  FitWeightOptions weights = {};
  FitSearchOptions search = {};
};

std::vector<Parameter> parameters_of(FitOptions& options);

/// Errors: usage, for a parameter out of its range, and for bounds that are not ascending.
Result<void> check(const FitOptions& options);

}  // namespace palpable::sculpt
