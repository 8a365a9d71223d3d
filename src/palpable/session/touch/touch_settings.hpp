// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/haptics/law/laws.hpp"
#include "palpable/haptics/safety/stability.hpp"
#include "palpable/haptics/tick/contact_transient.hpp"

namespace palpable::session {

/// The default law with a probe of 1 mm radius, which smooths about as a fingertip does without losing
/// detail.
inline haptics::LawParameters default_law() {
  haptics::LawParameters law;
  law.radius_m = 0.001;
  return law;
}

/// Whether a wall's stiffness is lowered to what the device can render stably.
enum class Limits {
  of_device,
  /// Not limited, to reproduce a paper: only on virtual or weak devices (kMostUnlimited_N).
  off
};
/// Greatest force of a device for which limits may be off.
inline constexpr double kMostUnlimited_N = 4.0;

/// Settings that may be changed during a touch.
struct TouchSettings {
  /// The law and its parameters; a value that is not set comes from the scene's materials. The device's
  /// limits may lower values; TouchSession::notices() reports that. On a device with two degrees of freedom,
  /// `rolling` replaces laws that need three.
  haptics::LawParameters law = default_law();
  /// Whether the user chose this law. Only then a notice reports that the scene is touched with another law.
  bool law_is_chosen = false;
  /// Only this law may be used, for example that of a paper: a scene that it does not support is refused.
  bool law_is_required = false;
  /// Factor of a relief's height, -4 ... 4; negative engraves, 0 is flat.
  double height_factor = 1.0;
  Limits limits = Limits::of_device;
  /// Vibration of the surface after an impact (haptics/tick/transient_player.hpp).
  haptics::TransientKind transient = haptics::TransientKind::none;
  /// Least damping that the hand adds to the device; the stiffness limit depends on it
  /// (haptics/safety/stability.hpp). 0.1 ... 40 N·s/m.
  double hand_damping_Ns_per_m = haptics::kLeastHandDamping_Ns_per_m;
};

}  // namespace palpable::session
