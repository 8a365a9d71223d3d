// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/device/two_diy/pantograph.hpp"

#include <array>
#include <cstdint>
#include <string_view>

namespace palpable::device {

/// The motor and the encoder of one inner link.
struct TwoDiyJoint {
  /// 1 or 2, on the board.
  std::uint8_t port = 1;
  /// Of motor and encoder: 0 = clockwise, 1 = counter-clockwise.
  std::uint8_t direction = 0;
  /// The angle at the home position, degrees, and the encoder's counts per turn.
  float home_deg = 0.0F;
  float counts_per_turn = 0.0F;
};

/// A version of the 2DIY, as its maker's library describes it. No hardware has confirmed the figures.
struct TwoDiyVariant {
  /// As in an address: "v3".
  std::string_view name;
  Pantograph linkage;
  /// The workspace in the pantograph's plane, metres: a rectangle inside the links' reach, and its full size.
  InPlane centre;
  InPlane size;
  /// Of the first and of the second motor.
  std::array<TwoDiyJoint, 2> joints;
  /// Torques are multiplied by it before they are sent.
  double torque_gain = 1.0;
};

inline constexpr std::array kTwoDiyVariants{
    TwoDiyVariant{.name = "v3",
                  .linkage = {.inner_m = 0.07, .outer_m = 0.09, .base_m = 0.038},
                  .centre = {0.019, 0.10},
                  .size = {0.09, 0.08},
                  .joints = {TwoDiyJoint{2, 1, 97.23F, 5299.7F}, TwoDiyJoint{1, 1, 82.77F, 5219.3F}}},
    TwoDiyVariant{.name = "v1",
                  .linkage = {.inner_m = 0.07, .outer_m = 0.09, .base_m = 0.0},
                  .centre = {0.0, 0.09},
                  .size = {0.12, 0.09},
                  .joints = {TwoDiyJoint{2, 1, 241.0F, 10752.0F}, TwoDiyJoint{1, 0, -61.0F, 10752.0F}}},
    TwoDiyVariant{.name = "2018",
                  .linkage = {.inner_m = 0.05, .outer_m = 0.07, .base_m = 0.02},
                  .centre = {0.01, 0.065},
                  .size = {0.09, 0.06},
                  .joints = {TwoDiyJoint{1, 0, 180.0F, 13824.0F}, TwoDiyJoint{2, 0, 0.0F, 13824.0F}},
                  .torque_gain = 0.1}};

/// The greatest torque of a motor, N m: beyond it the board saturates.
inline constexpr double kTwoDiyMaxTorque_Nm = 0.123;

}  // namespace palpable::device
