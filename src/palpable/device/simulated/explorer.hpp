// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/vec3.hpp"

#include <cstdint>
#include <random>

namespace palpable::device {

struct ExplorerOptions {
  enum class Script {
    /// Stays at the goal it is given (set_goal).
    hold,
    /// A dense curve over the whole workspace, again and again.
    scan,
    /// Unhurried strokes between places drawn at random.
    random
  };
  Script script = Script::scan;
  Vec3 workspace_m{0.10, 0.10, 0.05};
  /// Of a stroke along the surface.
  double speed_m_per_s = 0.06;
  /// What the hand aims to press with.
  double press_N = 0.8;
  /// False: moves in the plane only.
  bool deep = true;
  std::uint64_t seed = 1;
};

/// What a person's intention does while exploring a surface they cannot see: come down until something is
/// felt, stroke along it for some seconds with a steady pressure, lift off, go on elsewhere. Where nothing is
/// felt down to the floor, it rises and comes down nearer to the middle of the workspace, where scenes lie.
/// Gives the place where the hand wants to be; the arm's impedance (simulated_hand.hpp) pulls the hand there.
/// Deterministic in its options and in what it feels. Device frame; one thread; never allocates.
class Explorer {
 public:
  explicit Explorer(const ExplorerOptions& options);

  void set_goal(Vec3 goal_m) noexcept { goal_m_ = goal_m; }
  /// The goal `dt_s` later, while the hand at `hand_m` feels `force_N`.
  Vec3 step(Vec3 hand_m, Vec3 force_N, double dt_s) noexcept;

 private:
  enum class Phase : std::uint8_t { approach, stroke, lift, travel };
  void stroke_along(double dt_s, Vec3 force_N) noexcept;
  void follow_curve(double step_m) noexcept;
  void note_contact(Vec3 force_N, double dt_s) noexcept;
  void choose_nearer_middle() noexcept;
  void travel(double dt_s) noexcept;
  void begin(Phase phase) noexcept;
  double uniform(double least, double most) noexcept;

  ExplorerOptions options_;
  std::mt19937_64 random_;
  Vec3 goal_m_;
  Vec3 target_m_;
  Phase phase_ = Phase::approach;
  double phase_s_ = 0.0;
  double stroke_s_ = 0.0;
  double along_m_ = 0.0;
  /// How long this stroke has gone along the floor without feeling anything.
  double empty_s_ = 0.0;
  /// The part of the workspace about its middle where the hand comes down next; 1 after a contact.
  double visited_part_ = 1.0;
};

}  // namespace palpable::device
