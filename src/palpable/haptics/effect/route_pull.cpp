// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/haptics/effect/route_pull.hpp"

#include "palpable/core/check.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace palpable::haptics {
namespace {

using Place = std::array<double, 2>;

/// A place on a line: how far along it, and how far from the place that was asked for.
struct OnLine {
  double along_m = 0.0;
  double distance_m = std::numeric_limits<double>::infinity();
};

OnLine nearest_on_line(const std::vector<Place>& line, Place p) {
  OnLine best;
  double along = 0.0;
  for (std::size_t i = 1; i < line.size(); ++i) {
    const double dx = line[i][0] - line[i - 1][0], dy = line[i][1] - line[i - 1][1];
    const double length = std::hypot(dx, dy);
    if (!(length > 0.0)) continue;
    const double t = std::clamp(
        ((p[0] - line[i - 1][0]) * dx + (p[1] - line[i - 1][1]) * dy) / (length * length), 0.0, 1.0);
    const double distance = std::hypot(line[i - 1][0] + t * dx - p[0], line[i - 1][1] + t * dy - p[1]);
    // The later one of equally near places: the pull leads on.
    if (distance <= best.distance_m) best = {along + t * length, distance};
    along += length;
  }
  return best;
}

Place place_along_line(const std::vector<Place>& line, double along_m) {
  for (std::size_t i = 1; i < line.size(); ++i) {
    const double dx = line[i][0] - line[i - 1][0], dy = line[i][1] - line[i - 1][1];
    const double length = std::hypot(dx, dy);
    if (along_m <= length && length > 0.0)
      return {line[i - 1][0] + along_m / length * dx, line[i - 1][1] + along_m / length * dy};
    along_m -= length;
  }
  return line.back();
}

}  // namespace

RoutePull::RoutePull(const models::RouteGuide& guide, Vec3 half_size_m) {
  PALPABLE_CHECK(models::is_valid(guide));
  constexpr double kReserveOfWay = 2.0, kMostSamples = 250.0, kLeastSpacing_m = 0.0004;
  reserve_J_ = kReserveOfWay * guide.force_N * models::length_m(guide);
  const auto range = [&](std::size_t axis) {
    const auto [low, high] =
        std::minmax_element(guide.line_m.begin(), guide.line_m.end(),
                            [axis](const Place& a, const Place& b) { return a[axis] < b[axis]; });
    const double half_m = axis == 0 ? half_size_m.x : half_size_m.y;
    return Place{std::max((*low)[axis] - guide.reach_m, -half_m),
                 std::min((*high)[axis] + guide.reach_m, half_m)};
  };
  const Place x = range(0), y = range(1);
  if (!(x[1] > x[0] && y[1] > y[0])) return;
  left_m_ = x[0];
  bottom_m_ = y[0];
  spacing_m_ = std::max(kLeastSpacing_m, std::max(x[1] - x[0], y[1] - y[0]) / kMostSamples);
  columns_ = static_cast<std::size_t>(std::ceil((x[1] - x[0]) / spacing_m_)) + 2;
  rows_ = static_cast<std::size_t>(std::ceil((y[1] - y[0]) / spacing_m_)) + 2;
  forces_.resize(columns_ * rows_);
  for (std::size_t row = 0; row < rows_; ++row)
    for (std::size_t column = 0; column < columns_; ++column) {
      const Place p{left_m_ + static_cast<double>(column) * spacing_m_,
                    bottom_m_ + static_cast<double>(row) * spacing_m_};
      const OnLine on = nearest_on_line(guide.line_m, p);
      if (on.distance_m >= guide.reach_m) continue;
      const Place to = place_along_line(guide.line_m, on.along_m + guide.ahead_m);
      const double dx = to[0] - p[0], dy = to[1] - p[1], distance = std::hypot(dx, dy);
      if (!(distance > 0.0)) continue;
      const double beside = std::clamp(2.0 * (1.0 - on.distance_m / guide.reach_m), 0.0, 1.0);
      const double size_N = guide.force_N * beside * std::min(1.0, distance / guide.ahead_m);
      forces_[row * columns_ + column] = {static_cast<float>(size_N * dx / distance),
                                          static_cast<float>(size_N * dy / distance)};
    }
}

Vec3 RoutePull::force_N(Vec3 place_m) const noexcept {
  const double u = (place_m.x - left_m_) / spacing_m_, v = (place_m.y - bottom_m_) / spacing_m_;
  if (columns_ < 2 || rows_ < 2) return {};
  if (!(u >= 0.0 && v >= 0.0 && u < static_cast<double>(columns_ - 1) && v < static_cast<double>(rows_ - 1)))
    return {};
  const auto column = static_cast<std::size_t>(u), row = static_cast<std::size_t>(v);
  const double s = u - static_cast<double>(column), t = v - static_cast<double>(row);
  const Sample* const below = &forces_[row * columns_ + column];
  const Sample* const above = below + columns_;
  const auto blend = [s, t](double a, double b, double c, double d) {
    return (1.0 - t) * ((1.0 - s) * a + s * b) + t * ((1.0 - s) * c + s * d);
  };
  return {blend(below[0].x, below[1].x, above[0].x, above[1].x),
          blend(below[0].y, below[1].y, above[0].y, above[1].y), 0.0};
}

void RoutePull::add(const Hand& hand, PullTouch& state, LawOutput& output) const noexcept {
  add_pull(hand, output.contact ? force_N(hand.position.v) : Vec3{}, reserve_J_, state, output);
}

void add_pull(const Hand& hand, Vec3 wanted_N, double reserve_J, PullTouch& state,
              LawOutput& output) noexcept {
  constexpr double kEase_s = 0.05, kRefill = 0.5, kWeakerFrom = 0.1;
  if (reserve_J != state.reserve_J) state.spent_J = 0.0;
  // Without a force before there was no work, wherever the hand was.
  if (reserve_J == state.reserve_J && !(state.force_N == Vec3{})) {
    const double work_J = dot(state.force_N, hand.position.v - state.place_m);
    state.spent_J = std::max(0.0, state.spent_J + (work_J > 0.0 ? work_J : kRefill * work_J));
  }
  state.reserve_J = reserve_J;
  state.force_N = {};
  output.guide_reserve_J = reserve_J;
  if (!output.contact) {
    state.share = 0.0;
    return;
  }
  state.share += hand.dt_s / (hand.dt_s + kEase_s) * (1.0 - state.share);
  if (!(reserve_J > 0.0)) return;
  const double left = std::clamp((reserve_J - state.spent_J) / (kWeakerFrom * reserve_J), 0.0, 1.0);
  state.force_N = state.share * left * wanted_N;
  state.place_m = hand.position.v;
  output.guide_N.v = state.force_N;
  output.force_N.v += state.force_N;
}

}  // namespace palpable::haptics
