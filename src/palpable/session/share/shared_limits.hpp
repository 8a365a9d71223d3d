// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/device/device.hpp"
#include "palpable/device/local_surface.hpp"
#include "palpable/haptics/servo/servo_options.hpp"

namespace palpable::session {

/// Time in which the force of a shared device ramps to zero, once its surface is too old.
inline constexpr double kSharedRampDown_s = 0.008;

/// A surface as this device can render it: its stiffness and damping limited as those of a scene would be
/// (safe_contact(), safe_slopes()), without a vibration that this loop and device cannot render
/// (can_render()), and with a pull that is no stronger than that of a guide. `stiffening`: of its texture
/// (haptics::texture_stiffening()).
device::LocalSurface limited_surface(const device::LocalSurface& surface, const device::Traits& device,
                                     double rate_hz, double hand_damping_Ns_per_m, double stiffening = 1.0);

/// The tick's options of a loop that renders the surfaces of another computer.
haptics::ServoOptions shared_servo(haptics::ServoOptions servo);

}  // namespace palpable::session
