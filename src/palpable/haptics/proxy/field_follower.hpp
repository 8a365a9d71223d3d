// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/haptics/proxy/field_path.hpp"
#include "palpable/haptics/proxy/field_place.hpp"
#include "palpable/haptics/proxy/field_slide.hpp"
#include "palpable/haptics/proxy/hand_over.hpp"

#include <algorithm>
#include <cmath>

namespace palpable::haptics {

/// Moves a FieldProxy around one solid.
/// In free air, the hand's whole path of the tick is checked (FieldPath), so a first contact is found in the
/// tick in which it happens, also where the hand cuts an edge or a plate and is in the air again at its end.
/// In contact, the proxy moves along the surface in steps of at most a cell or a quarter of the hand's path
/// (FieldSlide).
template <models::DistanceSurface Surface>
class FieldFollower {
 public:
  FieldFollower(const DilatedSolid<Surface>& solid, Friction friction) noexcept
      : solid_(solid), friction_(friction) {}

  /// Moves the proxy by one tick; `hand_m` is the hand's position, finite.
  void follow(Vec3 hand_m, FieldProxy& proxy) const noexcept {
    if (proxy.phase == FieldProxy::Phase::fresh) begin(hand_m, proxy);
    const Before before{proxy.place_m, proxy.normal, proxy.hand_m, proxy.holds_the_hand()};
    const double cell_m = solid_.cell_m();
    const double moved_m = norm(hand_m - proxy.hand_m);
    proxy.hand_m = hand_m;
    proxy.crossed_m = 0.0;
    Tick tick;
    tick.hand_m = hand_m;
    tick.longest_m = std::max(cell_m, kLongestStep * moved_m);
    tick.evaluations =
        kEvaluations + static_cast<int>(std::min(kPerCell * moved_m / cell_m, 1.0 * kMaxEvaluations));
    if (!reaches_hand(before, proxy, tick)) return;
    // The proxy is free, at the hand. Did the hand cut the solid on its way? If it was inside the solid,
    // after it left that.
    if (before.touching || tick.met) note_crossing(before, proxy, tick);
  }

  /// A proxy that was in contact moves to the nearest point of this solid's surface, if it is near, and keeps
  /// its friction state. A free one keeps its position, unless it is inside this solid.
  void take_over(const HandOver& from, FieldProxy& proxy) const noexcept {
    begin(from.place.v, proxy);
    proxy.hand_m = from.hand.v;
    proxy.slipping = from.slipping;
    if (from.touching && !proxy.holds_the_hand()) settle(proxy);
  }

 private:
  using Path = FieldPath<Surface>;
  using Look = typename Path::Look;
  using Slide = FieldSlide<Surface>;
  /// Surface evaluations per tick: for a resting hand, additional ones per cell of movement, and the maximum.
  static constexpr int kEvaluations = 3;
  static constexpr double kPerCell = 1.25;
  static constexpr int kMaxEvaluations = 64;
  /// Longest step as a share of the hand's path in the tick: a wall of that thickness is not stepped over.
  static constexpr double kLongestStep = 0.25;
  /// Cosine between the normals of places half a cell apart on one face.
  static constexpr double kSameFace = 0.9;
  /// A contact within this distance of a place is at this place.
  static constexpr double kReturned_m = 1e-5;
  static constexpr double kSafe = DilatedSolid<Surface>::kSafe;

  /// The proxy after the previous tick.
  struct Before {
    Vec3 place_m;
    Vec3 normal;
    Vec3 hand_m;
    bool touching = false;
  };
  /// What the parts of a tick share.
  struct Tick {
    Vec3 hand_m;
    double longest_m = 0.0;
    int evaluations = 0;
    bool met = false;
    /// Where the surface let the proxy go, last in this tick, and its normal there.
    Vec3 left_m;
    Vec3 left_normal;
  };

  /// Starts a touch. If the hand is inside the solid, the proxy is placed on the nearest surface point.
  void begin(Vec3 hand_m, FieldProxy& proxy) const noexcept {
    const models::DistanceSample s = solid_.sample(hand_m);
    set_free(hand_m, s, proxy);
    proxy.hand_m = hand_m;
    if (s.distance_m < 0.0) settle(proxy);
  }

  void set_free(Vec3 place_m, const models::DistanceSample& s, FieldProxy& proxy) const noexcept {
    proxy.place_m = place_m;
    proxy.phase = FieldProxy::Phase::free;
    proxy.clearance_m = std::max(0.0, solid_.certain_m(place_m, s.distance_m));
    proxy.normal = s.gradient;
  }

  /// Puts a free proxy in contact at the surface point nearest to it, if it is near.
  void settle(FieldProxy& proxy) const noexcept {
    int evaluations = DilatedSolid<Surface>::kSettling;
    proxy.normal = {};
    if (solid_.settle(proxy.place_m, proxy.normal, evaluations)) proxy.phase = FieldProxy::Phase::touching;
  }

  /// The surface lets the proxy go.
  static void release(FieldProxy& proxy, Tick& tick) noexcept {
    tick.left_m = proxy.place_m;
    tick.left_normal = proxy.normal;
    proxy.phase = FieldProxy::Phase::free;
    proxy.clearance_m = 0.0;
  }

  /// Moves the proxy towards the hand, as far as the surface lets it; true if it is free and at the hand
  /// then.
  bool reaches_hand(const Before& before, FieldProxy& proxy, Tick& tick) const noexcept {
    const Slide slide(solid_, friction_, tick.hand_m, tick.longest_m);
    bool met = false;
    for (;;) {
      if (!proxy.holds_the_hand()) {
        met = flies_into(tick.hand_m, proxy, tick.evaluations);
        tick.met = tick.met || met;
        if (!met) break;
      }
      if (slide.slide(proxy, tick.evaluations)) break;
      // The proxy alternates between the faces of a crease in every attempt.
      if (met && tick.evaluations <= 0) {
        hold_in_crease(tick.hand_m, proxy);
        break;
      }
      release(proxy, tick);
    }
    if (!proxy.holds_the_hand() && proxy.place_m != tick.hand_m) hold(tick.hand_m, before, proxy);
    if (proxy.holds_the_hand()) let_go_in_air(before, proxy, tick);
    return !proxy.holds_the_hand() && proxy.place_m == tick.hand_m;
  }

  /// Called if the path to the hand needs more evaluations than a tick has. If the hand is inside, or was in
  /// contact and is not yet known to be free, the proxy moves to the surface point nearest to its present
  /// position, so it passes through nothing.
  void hold(Vec3 hand_m, const Before& before, FieldProxy& proxy) const noexcept {
    if (before.touching || solid_.sample(hand_m).distance_m < 0.0) settle(proxy);
  }

  /// In a crease the spring's direction is the normal.
  void hold_in_crease(Vec3 hand_m, FieldProxy& proxy) const noexcept {
    const Vec3 out = proxy.place_m - hand_m;
    const double length_m = norm(out);
    if (length_m > Slide::kTolerance_m && solid_.sample(hand_m).distance_m < 0.0)
      proxy.normal = out / length_m;
  }

  /// Lets a proxy go whose hand is in the air, if nothing of the solid is between both: a hand that was deep
  /// inside and came out elsewhere, while the proxy, which slides by a bounded way in a tick, is still on its
  /// way there; or one that the proxy saw from its place before the tick, and slid away from.
  void let_go_in_air(const Before& before, FieldProxy& proxy, Tick& tick) const noexcept {
    if (solid_.is_known_inside(tick.hand_m)) return;
    const models::DistanceSample s = solid_.sample_at_hand(tick.hand_m);
    if (s.distance_m <= 0.0) return;
    const Look hand{0.0, solid_.certain_m(tick.hand_m, s.distance_m), s.gradient};
    const bool is_seen = sees(tick.hand_m, hand, proxy.place_m, proxy.normal) ||
                         (before.touching && sees(tick.hand_m, hand, before.place_m, before.normal));
    if (!is_seen) return;
    release(proxy, tick);
    set_free(tick.hand_m, s, proxy);
  }

  /// Whether nothing is between a hand in the air, with the first look from there, and a place on the
  /// surface.
  bool sees(Vec3 hand_m, const Look& from_hand, Vec3 place_m, Vec3 normal) const noexcept {
    const Path path(solid_, hand_m, place_m);
    int looks = Path::kMostLooks;
    const typename Path::Followed followed = path.follow(from_hand, looks);
    if (followed.reach != Path::Reach::entry) return followed.reach == Path::Reach::end;
    // Half a cell from the proxy the hand's way passes at most an edge between two faces, unless it comes
    // from the far side of a plate.
    return followed.clear.at_m > path.length_m() - 0.5 * solid_.cell_m() &&
           (Slide::is_beside(followed.clear.gradient, normal) || only_grazes(path, followed.clear.at_m));
  }

  /// Whether a path is nowhere deeper than rounding between a place of it and its end, at most half a cell:
  /// at tips and creases the faces' normals tell nothing.
  bool only_grazes(const Path& path, double from_m) const noexcept {
    constexpr int kPlaces = 8;
    constexpr double kDeepest_m = 1e-6;
    for (int k = 1; k < kPlaces; ++k) {
      const double at_m = from_m + (1.0 * k / kPlaces) * (path.length_m() - from_m);
      if (solid_.sample(path.at(at_m)).distance_m < -kDeepest_m) return false;
    }
    return true;
  }

  /// Moves a free proxy straight to a place. True if it meets the surface: then it stays at the first
  /// contact. Otherwise it is at the place, or, after a jump, as far along the path as a tick's looks allow.
  bool flies_into(Vec3 to_m, FieldProxy& proxy, int& evaluations) const noexcept {
    const Path path(solid_, proxy.place_m, to_m);
    if (path.length_m() < kSafe * proxy.clearance_m) {
      proxy.place_m = to_m;
      proxy.clearance_m -= path.length_m() / kSafe;
      proxy.normal = {};
      return false;
    }
    int looks = Path::kMostLooks;
    const typename Path::Followed followed = path.follow({0.0, proxy.clearance_m, proxy.normal}, looks);
    evaluations -= Path::kMostLooks - looks;
    if (followed.reach == Path::Reach::entry) {
      meet(path, followed, proxy);
      return true;
    }
    proxy.place_m = path.at(followed.clear.at_m);
    proxy.clearance_m = followed.clear.distance_m;
    proxy.normal = followed.clear.gradient;
    return false;
  }

  /// Puts a proxy in contact where its path enters the solid.
  void meet(const Path& path, const typename Path::Followed& followed, FieldProxy& proxy) const noexcept {
    proxy.place_m = path.at(path.entry_m(followed));
    int evaluations = 3;
    solid_.settle(proxy.place_m, proxy.normal, evaluations);
    // In a crease the point found may belong to the other face; the face that was entered must stop the hand.
    // A look inside may be behind the middle of a plate.
    Vec3 entered = unit(followed.inside.gradient);
    if (dot(entered, path.along()) >= 0.0) entered = unit(followed.clear.gradient);
    if (dot(proxy.normal, entered) < kSameFace) proxy.normal = entered;
    proxy.phase = FieldProxy::Phase::touching;
    proxy.slipping = false;
    proxy.step_share = 0.0;
    proxy.bend_per_m = 0.0;
  }

  /// For a proxy that is free, at a hand in the air whose path in this tick may have cut the solid: the
  /// contact of the cut. A proxy that was in contact goes back to where the hand entered, and may be held.
  [[gnu::noinline]] void note_crossing(const Before& before, FieldProxy& proxy, Tick& tick) const noexcept {
    const Path path(solid_, before.touching ? before.hand_m : before.place_m, tick.hand_m);
    int looks = Path::kMostLooks;
    double depth_m = 0.0;
    Look start = path.look(0.0);
    if (start.distance_m < 0.0) start = path.leave(start, depth_m, looks);
    const typename Path::Followed followed = path.follow(start, looks);
    if (followed.reach != Path::Reach::entry) return;
    Vec3 at_m = path.at(path.entry_m(followed));
    depth_m = 0.0;
    path.leave(followed.inside, depth_m, looks);
    if (before.touching) {
      // A hand that comes back through a wall to its proxy was held until then, where the proxy is.
      const Vec3 left_m = tick.left_m;
      if (!returns_to(at_m, path, followed, proxy, tick)) at_m = left_m;
      if (!reaches_hand(before, proxy, tick)) return;
    }
    proxy.crossed_at_m = at_m;
    proxy.crossed_m = std::min(depth_m, norm(at_m - tick.hand_m));
  }

  /// Leads the proxy from where it left the surface in this tick to the place where the hand cut it again;
  /// false if it meets the surface before.
  bool returns_to(Vec3 entry_m, const Path& path, const typename Path::Followed& followed, FieldProxy& proxy,
                  Tick& tick) const noexcept {
    proxy.place_m = tick.left_m;
    proxy.normal = tick.left_normal;
    proxy.phase = FieldProxy::Phase::free;
    proxy.clearance_m = 0.0;
    if (flies_into(entry_m, proxy, tick.evaluations)) return norm(proxy.place_m - entry_m) < kReturned_m;
    if (proxy.place_m == entry_m) meet(path, followed, proxy);
    return true;
  }

  const DilatedSolid<Surface>& solid_;
  Friction friction_;
};

}  // namespace palpable::haptics
