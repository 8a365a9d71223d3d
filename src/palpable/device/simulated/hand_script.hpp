// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/vec3.hpp"
#include "palpable/device/open_options.hpp"

#include <cstddef>
#include <cstdint>
#include <random>

namespace palpable::device {

struct HandScriptOptions {
  enum class Kind {
    /// Stays at the goal that set_goal() gives.
    hold,
    /// Follows `strokes` in turn, each there and back for some seconds; without them a dense curve over the
    /// whole workspace, repeatedly.
    scan,
    /// Slow strokes between random points; it does not use `strokes`.
    random
  };
  Kind kind = Kind::scan;
  Vec3 workspace_m{0.10, 0.10, 0.05};
  /// Speed of a stroke along the surface.
  double speed_m_per_s = 0.06;
  /// Intended contact force.
  double press_N = 0.8;
  /// False: moves only in the plane.
  bool deep = true;
  std::uint64_t seed = 1;
  /// The seed chooses the first one. Used if `deep`.
  SurfaceStrokes strokes;
};

/// A model of a person who explores a surface without seeing it: moves down until there is contact, strokes
/// along the surface for some seconds with constant force, lifts off and continues elsewhere. If there is no
/// contact down to the floor, the hand rises and moves down nearer to the centre of the workspace, where
/// scenes are; a hand with `strokes` begins above one, and continues with the next one where it has no
/// contact. The result is the desired position; the arm's impedance (simulated_hand.hpp) pulls the hand
/// towards it. Deterministic for given options and forces. Device frame; one thread; never allocates.
class HandScript {
 public:
  explicit HandScript(const HandScriptOptions& options);

  void set_goal(Vec3 goal_m) noexcept { goal_m_ = goal_m; }
  /// The desired position after `dt_s`, if the hand at `hand_m` feels `force_N`.
  Vec3 step(Vec3 hand_m, Vec3 force_N, double dt_s) noexcept;

 private:
  enum class Phase : std::uint8_t { approach, stroke, lift, travel };
  void stroke_along(double dt_s, Vec3 force_N) noexcept;
  void follow_curve(double step_m) noexcept;
  void follow_stroke(double step_m) noexcept;
  void choose_stroke(std::size_t stroke) noexcept;
  bool has_strokes() const noexcept;
  void choose_elsewhere() noexcept;
  void note_contact(Vec3 force_N, double dt_s) noexcept;
  void choose_nearer_middle() noexcept;
  void travel(double dt_s) noexcept;
  void begin(Phase phase) noexcept;
  double uniform(double least, double most) noexcept;

  HandScriptOptions options_;
  std::mt19937_64 random_;
  Vec3 goal_m_;
  Vec3 target_m_;
  Phase phase_ = Phase::approach;
  double phase_s_ = 0.0;
  double stroke_s_ = 0.0;
  double along_m_ = 0.0;
  /// The stroke that it follows, the next of its points, and the place reached on it.
  std::size_t stroke_ = 0;
  std::size_t next_point_ = 0;
  bool is_returning_ = false;
  Vec3 on_stroke_m_;
  /// Height at which the hand crosses over to another stroke.
  double crossing_m_ = 0.0;
  /// Time for which this stroke has moved along the floor, or off the surface of `strokes`, without contact.
  double empty_s_ = 0.0;
  /// The part of the workspace around its centre in which the hand moves down next; 1 after a contact.
  double visited_part_ = 1.0;
};

}  // namespace palpable::device
