// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/device/device.hpp"

#include <string>

namespace palpable::haptics {

/// What bounds a wall's stiffness.
enum class StiffnessBound {
  /// Nothing that is known: a device without motors, or one that says nothing of itself.
  none,
  /// The wall's own damper must take out what the held spring makes: (2d + 1)·K·T/2 < B.
  held_spring,
  /// Colgate & Schenkel 1997 with d samples of delay: (2d + 1)·K·T/2 + |B| < b, the damping of device and
  /// hand.
  passivity,
  /// Abbott & Okamura 2005: the sensor's step must be less than friction can hold, K < 2·f_c/step.
  quantisation
};

/// A wall that does not make energy on a device, and what bounds it.
struct SafeContact {
  double stiffness_N_per_m = 0.0;
  double damping_Ns_per_m = 0.0;
  /// For the stiffness; none if it is the one asked for.
  StiffnessBound bound = StiffnessBound::none;
  /// The greatest stiffness at this damping; infinite where nothing bounds it.
  double max_stiffness_N_per_m = 0.0;

  bool operator==(const SafeContact&) const = default;
};

/// What a hand that holds the device adds to its damping at least: an assumption. The literature gives about
/// 2 to 40 N·s/m, recalled except the last and to be looked up (Hajian & Howe 1997 for a fingertip, Speich,
/// Shao & Goldfarb 2005 and Fu & Cavusoglu 2012 for a stylus, van Beek et al. 2015 for the arm); the least is
/// taken from below those.
inline constexpr double kLeastHandDamping_Ns_per_m = 1.5;

/// The wall nearest to the one asked for that is safe on the device at `rate_hz`. The damping is raised to
/// what the stiffness needs, but to no more than 0.55 of what device and hand have, where both bounds nearly
/// meet; then the stiffness is lowered below each bound: to 65 % of what the held spring's damper could pay
/// for (its velocity is delayed and quantised), to nine tenths of the others. What the device does not
/// state bounds nothing, except its damping, which counts as 0. `scale` is the metres of scene to a metre of
/// device: a scene shown smaller is stiffer in the hand. Stiffness > 0, damping >= 0, both in the scene.
SafeContact safe_contact(const device::Traits& device, double rate_hz, double scale, double stiffness_N_per_m,
                         double damping_Ns_per_m, double hand_damping_Ns_per_m = kLeastHandDamping_Ns_per_m);

/// Why the stiffness was lowered, for the person: "the loop's rate and delay", … Empty for none.
std::string reason(StiffnessBound bound);

}  // namespace palpable::haptics
