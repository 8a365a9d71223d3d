// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/haptics/law/laws.hpp"
#include "palpable/haptics/safety/stability.hpp"
#include "palpable/haptics/servo/contact_transient.hpp"

namespace palpable::session {

/// The default law, felt with a ball of 1 mm: a fingertip's own smoothing without losing its detail.
inline haptics::LawParameters default_law() {
  haptics::LawParameters law;
  law.radius_m = 0.001;
  return law;
}

/// Whether a wall's stiffness is lowered to what the device can render stably.
enum class Limits {
  of_device,
  /// As a paper has it, for comparison: on virtual devices and weak ones only (kMostUnlimited_N).
  off
};
/// The greatest force of a device on which limits may be off.
inline constexpr double kMostUnlimited_N = 4.0;

/// What a person may change while touching.
struct TouchSettings {
  /// The law and its parameters; a value that is not set comes from the scene's materials. The device's own
  /// limits lower them, and TouchSession::notices() says so. A device with two degrees of freedom feels
  /// `rolling` in place of laws that need the third.
  haptics::LawParameters law = default_law();
  /// Whether somebody asked for this law: only then is it said where a scene has to be touched with another.
  bool law_is_chosen = false;
  /// No other law will do, as where a paper's is to be felt: a scene that it is not for is refused.
  bool law_is_required = false;
  /// A relief's height is multiplied by this, -4…4; negative engraves, 0 is flat.
  double depth = 1.0;
  Limits limits = Limits::of_device;
  /// What the surface vibrates like when it is struck (haptics/servo/transient_player.hpp).
  haptics::TransientKind transient = haptics::TransientKind::none;
  /// What the hand that holds the device adds to its damping at least; the stiffness limit depends on it
  /// (haptics/safety/stability.hpp). 0.1 ... 40 N·s/m.
  double hand_damping_Ns_per_m = haptics::kLeastHandDamping_Ns_per_m;
};

}  // namespace palpable::session
