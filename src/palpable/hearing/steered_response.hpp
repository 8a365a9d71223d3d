// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/hearing/array_shape.hpp"

#include <cstddef>
#include <vector>

namespace palpable::hearing {

/// A pair of microphones and its correlation: the lags -most_lag to most_lag, samples of the lags' own rate.
/// A sound that reaches `first` later than `second` by a lag has its peak there.
struct PairCorrelation {
  std::size_t first = 0, second = 0;
  std::vector<float> at_lag;
};

/// The direction whose delays fit the correlations of all pairs best.
struct ResponsePeak {
  /// Unit vector towards the sound.
  Vector<CameraFrame> direction;
  /// The mean correlation over the pairs, there and over all directions that were searched.
  double response = 0.0;
  double mean_response = 0.0;
};

/// The steered response power of DiBiase (2000): the sum, over the pairs of microphones, of their correlation
/// at the delay that a far sound from a direction has. Searched from coarse to fine: first on a grid of
/// directions, where each pair gives its greatest correlation within a cell of the grid, as Cobos et al.
/// (2011) do, so that no narrow peak is missed between its points; then around the best cells.
class SteeredResponse {
 public:
  /// `geometry` is that of `microphones`.
  SteeredResponse(const Microphones& microphones, const ArrayGeometry& geometry, double lag_rate_hz);

  /// All pairs, without correlations; most_lag covers every direction.
  const std::vector<PairCorrelation>& pairs() const { return pairs_; }
  int most_lag() const { return most_lag_; }

  /// `correlations`: pairs(), filled.
  ResponsePeak find(const std::vector<PairCorrelation>& correlations) const;

 private:
  double response_at(const std::vector<PairCorrelation>& correlations, Vec3 direction) const;
  std::vector<PairCorrelation> widened(const std::vector<PairCorrelation>& correlations) const;
  void make_grid(const ArrayGeometry& geometry);

  Vec3 normal_;
  double cell_rad_ = 0.0;
  int most_lag_ = 0;
  std::vector<PairCorrelation> pairs_;
  /// For each pair: the lag, in samples, is this times the unit vector towards the sound.
  std::vector<Vec3> lag_of_direction_;
  std::vector<Vec3> grid_;
};

}  // namespace palpable::hearing
