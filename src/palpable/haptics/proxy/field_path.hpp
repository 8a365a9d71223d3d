// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/haptics/proxy/dilated_solid.hpp"

#include <algorithm>
#include <array>
#include <cstddef>

namespace palpable::haptics {

/// A straight path beside or through a solid, judged by looks at its distance. A stretch between two looks is
/// clear if the distances at its ends exceed its length (sphere tracing). Closer to the surface, stretches of
/// half a cell are judged by the distance's changes along the path too: where it is convex, as before a face,
/// an edge or a tip, it is nowhere lower than where the tangents at the two ends meet, and a look there
/// decides. Only where it is neither convex nor concave, the stretch is halved. So a sharp edge or thin plate
/// is found, however short its cut is. In a dense field, which has kinks at every face between its cells,
/// such a stretch is judged exactly (models::first_dip()). Tick path.
template <models::DistanceSurface Surface>
class FieldPath {
 public:
  /// Cuts that are nowhere deeper may be missed, except at the path's end.
  static constexpr double kIgnored_m = 1e-6;
  /// Looks at a path of any length: at most.
  static constexpr int kMostLooks = 160;

  /// A look at a place of the path.
  struct Look {
    /// How far along the path.
    double at_m = 0.0;
    /// A lower bound of the distance; exact within the field's box.
    double distance_m = 0.0;
    /// The distance's gradient; 0 = not known.
    Vec3 gradient;
  };
  enum class Reach { end, entry, unfinished };
  /// How far a path was followed: `clear` is the last look outside the solid, `inside` one in it, at most
  /// half a cell behind, if there is an entry.
  struct Followed {
    Reach reach = Reach::end;
    Look clear;
    Look inside;
  };

  FieldPath(const DilatedSolid<Surface>& solid, Vec3 from, Vec3 to) noexcept
      : solid_(solid), from_(from), to_(to), length_m_(norm(to - from)) {
    if (length_m_ > 0.0) along_ = (to - from) / length_m_;
    shortest_m_ = std::max(0.5 * solid.cell_m(), length_m_ * kShortest);
  }

  double length_m() const noexcept { return length_m_; }
  /// A unit vector.
  Vec3 along() const noexcept { return along_; }
  Vec3 at(double at_m) const noexcept { return at_m < length_m_ ? from_ + at_m * along_ : to_; }
  Look look(double at_m) const noexcept {
    const Vec3 place = at(at_m);
    const models::DistanceSample s = solid_.sample(place);
    return {at_m, solid_.certain_m(place, s.distance_m), s.gradient};
  }
  /// Follows the path from a look outside the solid until it enters it. `looks` is reduced by those taken.
  Followed follow(Look from, int& looks) const noexcept {
    Followed followed{Reach::end, from, {}};
    Look& clear = followed.clear;
    // Behind this place the path is known to be clear up to its end, which is tried first.
    double until_m = length_m_;
    Look end;
    for (double piece_m = length_m_; clear.at_m < until_m;
         piece_m = std::max(std::min(0.99 * kSafe * clear.distance_m, 0.5 * piece_m), shortest_m_)) {
      if (looks <= 0) {
        followed.reach = Reach::unfinished;
        return followed;
      }
      --looks;
      const Look next = look(std::min(until_m, clear.at_m + piece_m));
      const bool is_out = next.distance_m >= 0.0;
      if (next.at_m == length_m_ && is_out) {
        until_m = length_m_ - kSafe * next.distance_m;
        end = next;
      }
      if (is_out && kSafe * (clear.distance_m + next.distance_m) > next.at_m - clear.at_m) {
        clear = next;
        // The next piece is as long as the distance allows.
        piece_m = 2.0 * length_m_;
      } else if (piece_m <= shortest_m_) {
        followed.inside = next;
        if (clear.gradient == Vec3{}) clear = look(clear.at_m);
        if (!is_out || is_cut(clear, next, followed.inside, looks)) {
          followed.reach = Reach::entry;
          return followed;
        }
        clear = next;
      }
    }
    if (end.at_m > clear.at_m) clear = end;
    return followed;
  }

  /// The first look outside the solid after one inside it; at the path's end, if there is none or `looks` do
  /// not suffice. `deepest_m`: raised to the greatest depth seen.
  Look leave(Look inside, double& deepest_m, int& looks) const noexcept {
    while (inside.distance_m < 0.0 && inside.at_m < length_m_ && looks > 0) {
      deepest_m = std::max(deepest_m, -inside.distance_m);
      const double piece_m = std::max(-kSafe * inside.distance_m, kLeaving * shortest_m_);
      --looks;
      inside = look(std::min(length_m_, inside.at_m + piece_m));
    }
    if (inside.distance_m < 0.0) inside.at_m = length_m_;
    return inside;
  }

  /// Where the path meets the surface between a look outside and one inside.
  double entry_m(const Followed& followed) const noexcept {
    const Look& a = followed.clear;
    const Look& b = followed.inside;
    const double slope = dot(a.gradient, along_);
    const double stretch_m = b.at_m - a.at_m;
    // A path that begins on the surface leaves it first: there the rise replaces the distance.
    const double clear_m = a.distance_m > 0.0 ? a.distance_m : std::max(0.0, slope * stretch_m);
    const double chord_m = stretch_m * clear_m / (clear_m - b.distance_m);
    // The chord of a thin plate may end beyond its middle; the tangent does not.
    const double tangent_m = slope < 0.0 ? -clear_m / slope : stretch_m;
    return a.at_m + std::min(chord_m, tangent_m);
  }

 private:
  static constexpr double kSafe = DilatedSolid<Surface>::kSafe;
  /// The shortest stretch is half a cell, and at least this share of the path.
  static constexpr double kShortest = 1.0 / 100.0;
  /// Looks for the way out of a solid are at least this many shortest stretches apart.
  static constexpr double kLeaving = 0.25;
  /// Stretches that wait while a part of them is examined.
  static constexpr std::size_t kWaiting = 10;

  /// Whether the path enters the solid between two looks outside; then `inside` is a look in it, and `clear`
  /// moves up to the last one before it.
  bool is_cut(Look& clear, const Look& end, Look& inside, int& looks) const noexcept {
    if constexpr (DilatedSolid<Surface>::kHasExactLines)
      if (solid_.contains(at(clear.at_m)) && solid_.contains(at(end.at_m)))
        return is_cut_exactly(clear, end, inside, looks);
    std::array<Look, kWaiting> waiting;
    std::size_t count = 1;
    waiting[0] = end;
    while (count > 0) {
      const double at_m = lowest_m(clear, waiting[count - 1]);
      if (at_m < 0.0 || count == kWaiting || looks <= 0) {
        clear = waiting[--count];
        continue;
      }
      --looks;
      waiting[count] = look(at_m);
      if (waiting[count].distance_m < -kIgnored_m) {
        inside = waiting[count];
        return true;
      }
      ++count;
    }
    return false;
  }

  /// is_cut() in a field whose distance along a line is known exactly.
  bool is_cut_exactly(Look& clear, const Look& end, Look& inside, int& looks) const noexcept {
    const auto dip = solid_.first_dip(at(clear.at_m), at(end.at_m), -kIgnored_m);
    if (!dip) {
      clear = end;
      return false;
    }
    looks -= 2;
    const double stretch_m = end.at_m - clear.at_m;
    inside = look(clear.at_m + dip->lowest * stretch_m);
    clear = look(clear.at_m + dip->begins * stretch_m);
    return true;
  }

  /// Where the path between two looks outside may be inside the solid; -1 if it is not.
  double lowest_m(const Look& a, const Look& b) const noexcept {
    const double stretch_m = b.at_m - a.at_m;
    if (kSafe * (a.distance_m + b.distance_m + 2.0 * kIgnored_m) > stretch_m) return -1.0;
    const double slope_a = dot(a.gradient, along_);
    const double slope_b = dot(b.gradient, along_);
    // How far each end is above the tangent at the other.
    const double b_above_m = b.distance_m - a.distance_m - slope_a * stretch_m;
    const double a_above_m = a.distance_m - b.distance_m + slope_b * stretch_m;
    if (b_above_m <= kIgnored_m && a_above_m <= kIgnored_m) return -1.0;
    if (b_above_m < -kIgnored_m || a_above_m < -kIgnored_m) return a.at_m + 0.5 * stretch_m;
    if (slope_a >= 0.0 || slope_b <= 0.0) return -1.0;
    const double meet_m = a_above_m / (slope_b - slope_a);
    if (a.distance_m + slope_a * meet_m >= -kIgnored_m) return -1.0;
    return a.at_m + std::clamp(meet_m, 0.05 * stretch_m, 0.95 * stretch_m);
  }

  const DilatedSolid<Surface>& solid_;
  Vec3 from_;
  Vec3 to_;
  Vec3 along_;
  double length_m_;
  double shortest_m_;
};

}  // namespace palpable::haptics
