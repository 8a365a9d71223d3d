// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/hearing/steered_response.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

namespace palpable::hearing {
namespace {

/// Between the lags by a cubic (Catmull & Rom 1974); `lag` is within most_lag - 2.
double correlation_at(const PairCorrelation& pair, int most_lag, double lag) {
  const double place = lag + most_lag;
  const auto below = static_cast<std::size_t>(place);
  const double t = place - static_cast<double>(below);
  const float* at = pair.at_lag.data() + below;
  const double before = double{at[-1]}, a = double{at[0]}, b = double{at[1]}, after = double{at[2]};
  return a + 0.5 * t *
                 (b - before +
                  t * (2.0 * before - 5.0 * a + 4.0 * b - after + t * (3.0 * (a - b) + after - before)));
}

/// Two unit vectors across `direction`.
std::array<Vec3, 2> across(Vec3 direction) {
  const Vec3 helper = std::abs(direction.y) < 0.9 ? Vec3{0.0, 1.0, 0.0} : Vec3{1.0, 0.0, 0.0};
  const Vec3 side = unit(cross(helper, direction));
  return {side, cross(direction, side)};
}

}  // namespace

SteeredResponse::SteeredResponse(const Microphones& microphones, const ArrayGeometry& geometry,
                                 double lag_rate_hz)
    : normal_(geometry.normal) {
  const auto& at = microphones.positions_m;
  const double lags_per_m = lag_rate_hz / microphones.speed_of_sound_m_per_s;
  // The cubic between lags needs two more on each side.
  most_lag_ = static_cast<int>(std::ceil(geometry.aperture_m * lags_per_m)) + 3;
  for (std::size_t i = 0; i < at.size(); ++i)
    for (std::size_t j = i + 1; j < at.size(); ++j) {
      pairs_.push_back({i, j, {}});
      lag_of_direction_.push_back(lags_per_m * (at[j].v - at[i].v));
    }
  make_grid(geometry);
}

void SteeredResponse::make_grid(const ArrayGeometry& geometry) {
  constexpr double kFinest_rad = 0.0175, kCoarsest_rad = 0.105;
  // The width of a correlation's peak is about a wavelength of the band's upper end (8 kHz), 43 mm.
  cell_rad_ = std::clamp(0.3 * 0.043 / geometry.aperture_m, kFinest_rad, kCoarsest_rad);
  const int rings = static_cast<int>(std::ceil(std::numbers::pi / cell_rad_));
  for (int ring = 0; ring < rings; ++ring) {
    const double elevation = std::numbers::pi * ((ring + 0.5) / rings - 0.5);
    const int places =
        std::max(1, static_cast<int>(std::lround(2.0 * std::numbers::pi * std::cos(elevation) / cell_rad_)));
    for (int place = 0; place < places; ++place) {
      const double azimuth = 2.0 * std::numbers::pi * place / places;
      const Vec3 d{std::cos(elevation) * std::sin(azimuth), -std::sin(elevation),
                   std::cos(elevation) * std::cos(azimuth)};
      if (dot(d, normal_) >= 0.0) grid_.push_back(d);
    }
  }
}

double SteeredResponse::response_at(const std::vector<PairCorrelation>& correlations, Vec3 direction) const {
  double sum = 0.0;
  for (std::size_t pair = 0; pair < correlations.size(); ++pair)
    sum += correlation_at(correlations[pair], most_lag_, dot(lag_of_direction_[pair], direction));
  return sum / static_cast<double>(correlations.size());
}

std::vector<PairCorrelation> SteeredResponse::widened(
    const std::vector<PairCorrelation>& correlations) const {
  std::vector<PairCorrelation> out = correlations;
  for (std::size_t pair = 0; pair < out.size(); ++pair) {
    // From a cell's middle to its corner.
    const double reach = std::numbers::sqrt2 * 0.5 * cell_rad_ * norm(lag_of_direction_[pair]);
    const auto radius = static_cast<std::size_t>(std::ceil(reach));
    const auto& from = correlations[pair].at_lag;
    for (std::size_t lag = 0; lag < from.size(); ++lag) {
      const std::size_t first = lag - std::min(lag, radius), last = std::min(from.size(), lag + radius + 1);
      out[pair].at_lag[lag] = *std::max_element(from.begin() + static_cast<std::ptrdiff_t>(first),
                                                from.begin() + static_cast<std::ptrdiff_t>(last));
    }
  }
  return out;
}

ResponsePeak SteeredResponse::find(const std::vector<PairCorrelation>& correlations) const {
  constexpr std::size_t kCells = 8;
  constexpr double kFinest_rad = 0.001;
  ResponsePeak best;
  best.response = -1.0;
  const std::vector<PairCorrelation> wide = widened(correlations);
  std::vector<std::pair<double, std::size_t>> cells;
  for (std::size_t cell = 0; cell < grid_.size(); ++cell) {
    best.mean_response += response_at(correlations, grid_[cell]) / static_cast<double>(grid_.size());
    cells.emplace_back(-response_at(wide, grid_[cell]), cell);
  }
  const auto end = cells.begin() + static_cast<std::ptrdiff_t>(std::min(kCells, cells.size()));
  std::partial_sort(cells.begin(), end, cells.end());
  for (auto cell = cells.begin(); cell != end; ++cell) {
    Vec3 at = grid_[cell->second];
    double response = response_at(correlations, at);
    for (double step = 0.5 * cell_rad_; step > kFinest_rad;) {
      Vec3 better = at;
      for (const Vec3 side : across(at))
        for (const double sign : {-1.0, 1.0}) {
          const Vec3 tried = unit(at + sign * step * side);
          if (dot(tried, normal_) < 0.0) continue;
          if (const double there = response_at(correlations, tried); there > response) {
            response = there;
            better = tried;
          }
        }
      if (better == at) step *= 0.5;
      at = better;
    }
    if (response > best.response) {
      best.response = response;
      best.direction = {at};
    }
  }
  return best;
}

}  // namespace palpable::hearing
