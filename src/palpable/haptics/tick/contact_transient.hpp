// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/device/contact_transient.hpp"

#include <cstdint>
#include <optional>
#include <string_view>

namespace palpable::haptics {

/// The material whose vibration is rendered at an impact.
enum class TransientKind : std::uint8_t { none, rubber, wood, metal };

std::string_view name_of(TransientKind kind);
std::optional<TransientKind> transient_kind_from(std::string_view name);

using device::ContactTransient;

/// Frequency and decay of rubber, wood and aluminium for a stylus after Okamura, Cutkosky & Dennerlein 2001:
/// 18, 100 and 300 Hz; 60, 80 and 90 1/s. These values are quoted from memory and not checked. The amplitude
/// is chosen here: it reaches the limits of the servo (haptics/tick/transient_player.hpp) at 0.1 to 0.2 m/s.
ContactTransient transient_of(TransientKind kind);

}  // namespace palpable::haptics
