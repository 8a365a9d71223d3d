// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/haptics/proxy/field_path.hpp"
#include "palpable/haptics/proxy/field_place.hpp"
#include "palpable/haptics/proxy/surface_proxy.hpp"

#include <algorithm>
#include <cmath>

namespace palpable::haptics {

/// The slide of a proxy along a solid's surface towards the hand in one tick, under a friction cone. Each
/// step must bring it nearer to the hand, and must not pass through a wall. Tick path.
template <models::DistanceSurface Surface>
class FieldSlide {
 public:
  /// At this distance from its final position the proxy rests: 0.5 mN at 500 N/m.
  static constexpr double kTolerance_m = 1e-6;

  /// `longest_m`: the longest step.
  FieldSlide(const DilatedSolid<Surface>& solid, Friction friction, Vec3 hand_m, double longest_m) noexcept
      : solid_(solid), friction_(friction), hand_m_(hand_m), longest_m_(longest_m) {}

  /// Slides a proxy that is in contact; false if the hand is on the free side. `evaluations` is reduced by
  /// those used.
  bool slide(FieldProxy& proxy, int& evaluations) const noexcept {
    double share = proxy.step_share > 0.0 ? proxy.step_share : 1.0;
    bool moved = false;
    proxy.blocked = false;
    bool grips = true;
    const double coefficient = proxy.slipping ? friction_.sliding : friction_.at_rest;
    for (;;) {
      const Vec3 d = hand_m_ - proxy.place_m;
      const double lifted = dot(d, proxy.normal);
      if (lifted > 0.0) return false;
      if (evaluations <= 0) break;
      const Vec3 along = d - lifted * proxy.normal;
      const double along_m = norm(along);
      const double held_m = grips ? -lifted * (moved ? friction_.sliding : coefficient) : 0.0;
      if (along_m <= held_m + kTolerance_m) {
        if (along_m > kTolerance_m && held_m > 0.0 && has_slipped_off(proxy)) {
          grips = false;
          continue;
        }
        proxy.blocked = false;
        break;
      }
      // Newton's step: the step in the tangent plane, corrected by the curvature.
      const double bent = std::clamp(1.0 + proxy.bend_per_m * lifted, kLeastBent, kMostBent);
      const double step_m = share * std::min((along_m - held_m) / bent, longest_m_);
      const Step step = stepped(proxy, (step_m / along_m) * along, evaluations);
      // With friction, a proxy that is led beyond its place ahead of the hand stays there and pushes the hand
      // on.
      if (dot(hand_m_ - step.place_m, along) < 0.0 && bent < 1.0 && held_m > 0.0) {
        proxy.bend_per_m = 0.0;
        continue;
      }
      if (!step.is_valid || squared_norm(hand_m_ - step.place_m) >= squared_norm(d)) {
        // At a sharp edge the next face may see the hand, although no step on it is nearer.
        if (step.is_valid && dot(hand_m_ - step.place_m, step.normal) > 0.0 &&
            norm(hand_m_ - step.place_m) <= norm(d) + kOn_m && has_slipped_off(proxy)) {
          proxy.place_m = step.place_m;
          proxy.normal = step.normal;
          return false;
        }
        proxy.blocked = true;
        share *= 0.25;
        if (step_m < kShortest_m) {
          share = 1.0;
          break;
        }
        continue;
      }
      proxy.blocked = false;
      share = std::min(1.0, 4.0 * share);
      moved = true;
      proxy.bend_per_m = dot(step.normal - proxy.normal, along) / (along_m * step_m);
      proxy.place_m = step.place_m;
      proxy.normal = step.normal;
    }
    proxy.step_share = share;
    proxy.slipping = moved;
    return true;
  }

  /// Whether a place in the air, with the distance's gradient there, is not on the far side of a wall whose
  /// near face has a normal.
  static bool is_beside(Vec3 gradient, Vec3 normal) noexcept { return dot(gradient, normal) > kFarFace; }

 private:
  static constexpr double kOn_m = DilatedSolid<Surface>::kOn_m;
  /// Limits of the factor by which curvature changes a step.
  static constexpr double kLeastBent = 0.4;
  static constexpr double kMostBent = 2.5;
  /// Shorter steps are not tried.
  static constexpr double kShortest_m = 1e-7;
  /// Cosine between the proxy's normal and that of the far face of a wall.
  static constexpr double kFarFace = -0.5;
  /// Cosine between the normals of a step's ends, below which there may be a wall between them.
  static constexpr double kTurned = 0.7;
  /// Looks for a wall across a step.
  static constexpr int kAcross = 12;

  struct Step {
    Vec3 place_m;
    Vec3 normal;
    /// It ended on the surface, and passed through no wall.
    bool is_valid = false;
  };

  Step stepped(const FieldProxy& proxy, Vec3 step, int& evaluations) const noexcept {
    const Vec3 aimed = proxy.place_m + step;
    Step next{aimed, proxy.normal, false};
    int one = std::min(evaluations, 3) - 1;
    evaluations -= one + 1;
    const models::DistanceSample at_aimed = solid_.sample(aimed);
    const bool settled = solid_.settle_from(at_aimed, next.place_m, next.normal, one);
    evaluations += one;
    if (!settled) return next;
    // The correction led out of the solid in the direction of movement: the step ended behind the middle of a
    // wall.
    const Vec3 out = next.place_m - aimed;
    if (std::min(dot(out, next.normal) - kOn_m, dot(out, step)) > 0.0) return next;
    // What mostly holds comes first: a processor predicts it.
    next.is_valid =
        dot(next.normal, proxy.normal) > kTurned || at_aimed.distance_m <= 0.0 || !passes_wall(proxy, aimed);
    return next;
  }

  /// Whether the straight way from the proxy to a place in the air leads through the solid.
  [[gnu::noinline]] bool passes_wall(const FieldProxy& proxy, Vec3 aimed) const noexcept {
    const FieldPath<Surface> path(solid_, proxy.place_m, aimed);
    int looks = kAcross;
    return path.follow({0.0, 0.0, proxy.normal}, looks).reach == FieldPath<Surface>::Reach::entry;
  }

  /// Whether the hand left the solid beside the proxy, as from a thin crest: friction must not hold it there,
  /// in the air. A hand on the far side of a thin wall is not beside the proxy.
  bool has_slipped_off(const FieldProxy& proxy) const noexcept {
    if (solid_.is_known_inside(hand_m_)) return false;
    const models::DistanceSample s = solid_.sample_at_hand(hand_m_);
    return s.distance_m > 0.0 && is_beside(s.gradient, proxy.normal);
  }

  const DilatedSolid<Surface>& solid_;
  Friction friction_;
  Vec3 hand_m_;
  double longest_m_;
};

}  // namespace palpable::haptics
