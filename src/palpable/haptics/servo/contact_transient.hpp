// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

namespace palpable::haptics {

/// The material that a surface vibrates like when it is struck.
enum class TransientKind : std::uint8_t { none, rubber, wood, metal };

std::string_view name_of(TransientKind kind);
std::optional<TransientKind> transient_kind_from(std::string_view name);

/// The force f(t) = a v exp(-b t) sin(2 pi f t) after an impact at the speed v (Okamura, Dennerlein & Howe
/// 1998; as a force that is superposed on the contact spring's, Kuchenbecker, Fiene & Niemeyer 2006).
struct ContactTransient {
  /// a, N per m/s.
  double force_per_speed_Ns_per_m = 0.0;
  /// f; 0: none.
  double frequency_hz = 0.0;
  /// b, 1/s.
  double decay_per_s = 0.0;
};

/// Frequency and decay of rubber, wood and aluminium as Okamura, Cutkosky & Dennerlein 2001 give them for a
/// stylus (18, 100 and 300 Hz; 60, 80 and 90 1/s; recalled, to be looked up). The amplitude is ours: it
/// reaches the bounds of the servo (haptics/servo/transient_player.hpp) at 0.1 to 0.2 m/s.
ContactTransient transient_of(TransientKind kind);

}  // namespace palpable::haptics
