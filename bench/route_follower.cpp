// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "route_follower.hpp"

#include "palpable/core/geometry/map_place.hpp"
#include "palpable/describe/place_words.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

namespace palpable::bench {
namespace {

using describe::Place;

constexpr double kFullTurn = 2.0 * std::numbers::pi;
constexpr double kQuarter = 0.5 * std::numbers::pi;

Place moved(Place p, double bearing, double by_m) {
  return {p.x_m + by_m * std::sin(bearing), p.y_m + by_m * std::cos(bearing)};
}

double turn(double from, double to) { return std::abs(std::remainder(to - from, kFullTurn)); }

class Follower {
 public:
  Follower(const models::Scene& scene, Place start, const FollowerOptions& options)
      : scene_(scene), surface_(*models::relief_of(scene)), options_(options), at_(start) {
    // The groove that the hand begins in is its measure of depth; land is felt around it. Between merged
    // grooves the surface is less than half as deep.
    constexpr double kGroovePart = 0.65;
    double land = -1e9;
    for (int k = 0; k < kRing; ++k)
      for (const double reach : {1.0, 2.0, 3.0})
        land = std::max(land, height(moved(start, kFullTurn * k / kRing, reach * options.reach_m)));
    in_groove_below_ = land + kGroovePart * (height(start) - land);
  }

  Place follow(const std::vector<SpokenLeg>& legs) {
    if (legs.empty()) return at_;
    heading_ = begin_heading(legs.front());
    for (std::size_t k = 0; k < legs.size(); ++k) {
      const bool last = k + 1 == legs.size();
      if (!walk(legs[k], last ? nullptr : &legs[k + 1])) break;
    }
    return at_;
  }

 private:
  static constexpr int kRing = 72, kMostSteps = 2000, kStepsOfChord = 6;
  /// Where the name of the next street is felt, the middle of the junction is about this far behind.
  static constexpr double kBehindJunction_m = 0.0015;

  double height(Place p) const { return surface_.sample(p.x_m, p.y_m).z_m; }
  bool is_groove(Place p) const {
    return std::abs(p.x_m) < 0.5 * surface_.size_x_m() && std::abs(p.y_m) < 0.5 * surface_.size_y_m() &&
           height(p) < in_groove_below_;
  }
  std::string name(Place p) const { return describe::name_at(scene_, p); }
  bool is_called(Place p, const std::string& street) const { return name(p) == street; }

  /// Whether a finger can slide there in the groove.
  bool is_open(double bearing, double reach_m) const {
    for (double d = options_.step_m; d <= reach_m; d += options_.step_m)
      if (!is_groove(moved(at_, bearing, d))) return false;
    return true;
  }

  /// The open direction nearest to a wanted one, if possible in a street of this name.
  std::optional<double> open_direction(double wanted, const std::string* street, double most_turn,
                                       double reach_m) const {
    std::optional<double> best;
    double least = most_turn;
    for (int k = 0; k < kRing; ++k) {
      const double bearing = kFullTurn * k / kRing;
      if (turn(wanted, bearing) >= least || !is_open(bearing, reach_m)) continue;
      if (street != nullptr && !is_called(moved(at_, bearing, reach_m), *street)) continue;
      least = turn(wanted, bearing);
      best = bearing;
    }
    if (!best) return best;
    // The middle of the open sector.
    double left = *best, right = *best;
    const double step = kFullTurn / kRing;
    const auto fits = [&](double b) {
      return is_open(b, reach_m) && (street == nullptr || is_called(moved(at_, b, reach_m), *street));
    };
    while (*best - left < kQuarter && fits(left - step)) left -= step;
    while (right - *best < kQuarter && fits(right + step)) right += step;
    return 0.5 * (left + right);
  }

  double begin_heading(const SpokenLeg& leg) const {
    for (const double reach : {options_.reach_m, 0.5 * options_.reach_m})
      if (const auto open = open_direction(leg.direction, nullptr, kQuarter, reach)) return *open;
    return leg.direction;
  }

  /// One step along the groove; false at its end.
  bool step(const std::string& street) {
    auto next = open_direction(heading_, &street, 0.45 * std::numbers::pi, options_.reach_m);
    for (const double reach : {options_.reach_m, 0.5 * options_.reach_m, 2.0 * options_.step_m})
      if (!next) next = open_direction(heading_, nullptr, 0.6 * std::numbers::pi, reach);
    if (!next) return false;
    heading_ = *next;
    at_ = moved(at_, heading_, options_.step_m);
    settle();
    return true;
  }

  /// Sideways into the deepest place nearby, as a finger does in a groove.
  void settle() {
    const double side = heading_ + kQuarter;
    double best = 0.0, lowest = height(at_);
    for (double off = -0.001; off <= 0.001; off += 0.00025)
      if (const double z = height(moved(at_, side, off)); z < lowest - 1e-6) lowest = z, best = off;
    at_ = moved(at_, side, 0.5 * best);
  }

  /// Turns into the next street if it is within reach, in the direction that was spoken.
  bool turn_into(const SpokenLeg& next) {
    for (const double reach : {1.0, 0.75, 1.25, 1.5}) {
      const auto open =
          open_direction(next.direction, &next.name, 0.4 * std::numbers::pi, reach * options_.reach_m);
      if (!open) continue;
      at_ = moved(at_, *open, reach * options_.reach_m);
      travelled_ = kBehindJunction_m;
      heading_ = *open;
      settle();
      return true;
    }
    return false;
  }

  bool hears_end(const SpokenLeg& leg) const {
    return leg.is_last && std::hypot(at_.x_m - leg.end.x_m, at_.y_m - leg.end.y_m) <= options_.end_m;
  }

  /// Goes along a leg until the next street or the end is found; back and forth where it is not. False if it
  /// is not found at all.
  bool walk(const SpokenLeg& leg, const SpokenLeg* next) {
    constexpr double kLonger = 1.15;
    constexpr int kMostReturns = 2;
    const double early = std::min(0.006 + 0.1 * leg.length_m, leg.length_m);
    double gone = travelled_, most = kLonger * leg.length_m + options_.overshoot_m;
    travelled_ = 0.0;
    int returns = 0;
    Place mark = at_;
    for (int k = 0; k < kMostSteps; ++k) {
      if (hears_end(leg)) return true;
      if (next != nullptr && (returns > 0 || gone >= leg.length_m - early) && turn_into(*next)) return true;
      const bool went = gone < most && step(leg.name);
      // Over several steps, so that trembling does not count.
      if ((k + 1) % kStepsOfChord == 0) {
        gone += std::hypot(at_.x_m - mark.x_m, at_.y_m - mark.y_m);
        mark = at_;
      }
      if (went) continue;
      if (returns == kMostReturns) return false;
      // Too far: back along the same groove, and look on the way; the second time beyond the leg's beginning.
      ++returns;
      heading_ += std::numbers::pi;
      most = gone + 2.0 * options_.overshoot_m + returns * leg.length_m;
      gone = 0.0;
    }
    return false;
  }

  const models::Scene& scene_;
  const models::Relief& surface_;
  FollowerOptions options_;
  double in_groove_below_ = 0.0;
  Place at_;
  double heading_ = 0.0;
  /// What of the present leg was gone while the hand turned into it.
  double travelled_ = 0.0;
};

}  // namespace

std::vector<SpokenLeg> spoken_legs(const describe::MapGuide& guide, const models::StreetRoute& route) {
  const double metres_per_px = guide.map().metres_per_px;
  std::vector<SpokenLeg> legs;
  for (const models::RouteLeg& leg : route.legs) {
    const double eighth = 0.125 * kFullTurn;
    double length_px = leg.length_px;
    if (metres_per_px > 0.0) {
      // As describe::MapGuide::distance_words() rounds it.
      const double metres = leg.length_px * metres_per_px, step = metres < 100.0 ? 5.0 : 10.0;
      length_px = std::max(step, step * std::round(metres / step)) / metres_per_px;
    }
    legs.push_back({leg.name.empty() ? std::string(kind_words(leg.kind)) : leg.name,
                    eighth * std::round(leg.first_bearing / eighth), guide.metres_on_device(length_px),
                    guide.place_of(route.line.back()), legs.size() + 1 == route.legs.size()});
  }
  return legs;
}

Place follow_route(const models::Scene& scene, Place start, const std::vector<SpokenLeg>& legs,
                   const FollowerOptions& options) {
  return Follower(scene, start, options).follow(legs);
}

}  // namespace palpable::bench
