// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/device/device.hpp"

#include <string>

namespace palpable::haptics {

/// Which condition limits a virtual wall's stiffness. For a sensor whose period P is longer than the loop's
/// T, and which is not in step with it, the force of a reading is held for P, and the reading is T / 2 old
/// before: then 2d·T + P + T takes the place of (2d + 1)·T.
enum class StiffnessBound {
  /// No known condition: a device without motors, or one that states no properties.
  none,
  /// The wall's virtual damper must dissipate the energy that the held spring force generates: (2d + 1)·K·T/2
  /// < B.
  held_spring,
  /// Colgate & Schenkel 1997, extended by d samples of delay: (2d + 1)·K·T/2 + |B| < b, where b is the
  /// damping of device and hand.
  passivity,
  /// Abbott & Okamura 2005: one step of the position sensor must not exceed what Coulomb friction f_c holds:
  /// K < 2·f_c/step.
  quantisation
};

/// A virtual wall that generates no energy on a device, and the condition that limits it.
struct SafeContact {
  double stiffness_N_per_m = 0.0;
  double damping_Ns_per_m = 0.0;
  /// The condition that lowered the stiffness; `none` if the desired stiffness is used.
  StiffnessBound bound = StiffnessBound::none;
  /// The greatest safe stiffness at this damping; infinite where no condition limits it.
  double max_stiffness_N_per_m = 0.0;

  bool operator==(const SafeContact&) const = default;
};

/// Least damping that a hand adds to the device that it holds. This is an assumption. The literature gives
/// about 2 to 40 N·s/m: Hajian & Howe 1997 for a fingertip, Speich, Shao & Goldfarb 2005 and Fu & Cavusoglu
/// 2012 for a stylus, van Beek et al. 2015 for the arm. All but the last are quoted from memory and not
/// checked. The value here lies below that range.
inline constexpr double kLeastHandDamping_Ns_per_m = 1.5;

/// The virtual wall nearest to the desired one that is safe on the device at `rate_hz` (> 0). First the
/// damping is raised to what the stiffness needs, to at most 0.55 of the damping of device and hand; there
/// both conditions nearly meet. Then the stiffness is lowered below each limit: to 66 % of what the virtual
/// damper can dissipate (its velocity is delayed and quantised), and to 90 % of the other limits. A property
/// that the device does not state limits nothing, except damping, which counts as 0. `scale` is metres in the
/// scene per metre at the device: a scene that is shown smaller is stiffer at the hand. Stiffness > 0 and
/// damping >= 0 are scene quantities; `hand_damping_Ns_per_m` is at the device.
SafeContact safe_contact(const device::Traits& device, double rate_hz, double scale, double stiffness_N_per_m,
                         double damping_Ns_per_m, double hand_damping_Ns_per_m = kLeastHandDamping_Ns_per_m);

/// What loop and device can render of a weight on slopes (`rolling`), in scene quantities. A bend of the
/// surface acts as a spring along it: in a valley it holds the hand, on a ridge it pushes it away.
struct SafeSlopes {
  double max_stiffness_N_per_m = 0.0;
  /// A capped force is no longer the slope's.
  double max_force_N = 0.0;
  /// At most the desired damping, and at most what device and hand allow.
  double damping_Ns_per_m = 0.0;
};

/// Half of what a wall's stiffness may be at this damping (> 0): the force is that of the place where the
/// hand is predicted to be, which is less certain than where it is. Arguments as in safe_contact().
SafeSlopes safe_slopes(const device::Traits& device, double rate_hz, double scale, double damping_Ns_per_m,
                       double hand_damping_Ns_per_m = kLeastHandDamping_Ns_per_m);

/// Why the stiffness was lowered, as a clause for the user: "a stiffer wall would let the hand feel the steps
/// of the device's sensor". Empty for `none`.
std::string reason(StiffnessBound bound);

}  // namespace palpable::haptics
