// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/haptics/law/touchable.hpp"

#include <algorithm>
#include <cmath>

namespace palpable::haptics {

/// Where the surface of a law with a contact spring is, as seen from the hand.
struct SurfaceAtHand {
  /// With a spring whose length is known.
  bool contact = false;
  /// A contact without such a spring, as that of a crest that was cut within the tick.
  bool only_force = false;
  /// How deep the hand is in it, along its normal; negative above it. 0 if there is no contact and its place
  /// is not known. m.
  double depth_m = 0.0;
  /// From the hand to the surface: along the spring in contact, else along the normal.
  Vector<SceneFrame> to_surface_m;
  /// Of the spring; 0 without contact.
  Vector<SceneFrame> spring_N;
  double stiffness_N_per_m = 0.0;
};

/// `output` is what the law returned for `hand`, and `state` is its state afterwards. Evaluates the surface
/// once more if the hand is above it. Tick path.
inline SurfaceAtHand surface_at_hand(const Touchable& touchable, const Hand& hand, const TouchState& state,
                                     const LawOutput& output) noexcept {
  SurfaceAtHand at;
  const double spring2 = squared_norm(output.spring_N.v);
  if (output.contact && spring2 > 0.0 && output.stored_J > 0.0) {
    // A spring that stores U at a force f is 2 U / f long, and has the stiffness f² / 2 U.
    at.contact = true;
    at.spring_N = output.spring_N;
    at.to_surface_m = (2.0 * output.stored_J / spring2) * output.spring_N;
    // Friction may hold the spring aslant.
    const HandOver proxy = touchable.hand_over(state);
    const double along_normal_m = proxy.touching ? dot(at.to_surface_m, proxy.normal) : 0.0;
    at.depth_m = along_normal_m > 0.0 ? along_normal_m : norm(at.to_surface_m);
    at.stiffness_N_per_m = spring2 / (2.0 * output.stored_J);
    return at;
  }
  at.only_force = output.contact;
  if (at.only_force) return at;
  if (const TangentPlane plane = touchable.tangent_plane(hand, state); plane.is_known) {
    at.depth_m = std::min(0.0, dot(plane.place - hand.position, plane.normal));
    at.to_surface_m = at.depth_m * plane.normal;
  }
  return at;
}

/// A surface on its way from where it was to where it is seen now, at the hand. Its depth there, not its
/// force, is the mean of both, so that it meets and leaves the hand when a surface that moves does. Its
/// spring stores what one spring of its depth stores, and its damper is a whole one.
struct SurfaceBetween {
  bool contact = false;
  /// The share of the mean of both laws' forces that acts: less than 1 where the hand is above one of both.
  double share = 1.0;
  /// The part of both that is in contact, by their weights in the mean, 0 ... 1: a damper belongs to it.
  double touched = 1.0;
  Vector<SceneFrame> spring_N;
  double stored_J = 0.0;
  /// How deep the hand is in it, as in SurfaceAtHand.
  double depth_m = 0.0;
  /// From the hand to it, in contact.
  Vector<SceneFrame> to_surface_m;
};

/// `moved`: the part of its way that the surface has gone, 0 ... 1. Tick path.
inline SurfaceBetween surface_between(const SurfaceAtHand& from, const SurfaceAtHand& to,
                                      double moved) noexcept {
  SurfaceBetween between;
  between.depth_m = from.depth_m + moved * (to.depth_m - from.depth_m);
  const double deep_m =
      (from.contact ? (1.0 - moved) * from.depth_m : 0.0) + (to.contact ? moved * to.depth_m : 0.0);
  const bool only_force = from.only_force || to.only_force;
  const bool has_spring = deep_m > 0.0 && (only_force || between.depth_m > 0.0);
  between.contact = has_spring || only_force;
  between.share = only_force ? 1.0 : has_spring ? std::min(1.0, between.depth_m / deep_m) : 0.0;
  if (!has_spring) return between;
  between.touched = (from.contact ? 1.0 - moved : 0.0) + (to.contact ? moved : 0.0);
  between.spring_N = between.share * (from.spring_N + moved * (to.spring_N - from.spring_N));
  const double stiffness =
      !from.contact ? to.stiffness_N_per_m
      : !to.contact ? from.stiffness_N_per_m
                    : from.stiffness_N_per_m + moved * (to.stiffness_N_per_m - from.stiffness_N_per_m);
  between.to_surface_m = (1.0 / stiffness) * between.spring_N;
  between.stored_J = 0.5 * dot(between.spring_N, between.to_surface_m);
  return between;
}

}  // namespace palpable::haptics
