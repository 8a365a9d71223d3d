// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/session/share/shared_limits.hpp"

#include "palpable/haptics/safety/stability.hpp"
#include "palpable/haptics/tick/transient_player.hpp"
#include "palpable/models/scene/route_guide.hpp"

namespace palpable::session {

using SharedKind = device::LocalSurface::Kind;

device::LocalSurface limited_surface(const device::LocalSurface& surface, const device::Traits& device,
                                     double rate_hz, double hand_damping_Ns_per_m, double stiffening) {
  device::LocalSurface limited = surface;
  constexpr double kSoftest_N_per_m = 1e-3;
  if (surface.kind == SharedKind::plane && surface.stiffness_N_per_m < kSoftest_N_per_m)
    limited.kind = SharedKind::free;
  if (limited.kind == SharedKind::plane) {
    const auto safe = haptics::safe_contact(device, rate_hz, 1.0, stiffening * surface.stiffness_N_per_m,
                                            surface.damping_Ns_per_m, hand_damping_Ns_per_m);
    limited.stiffness_N_per_m = safe.stiffness_N_per_m / stiffening;
    limited.damping_Ns_per_m = safe.damping_Ns_per_m;
  }
  if (limited.kind == SharedKind::slope && surface.damping_Ns_per_m > 0.0)
    limited.damping_Ns_per_m =
        haptics::safe_slopes(device, rate_hz, 1.0, surface.damping_Ns_per_m, hand_damping_Ns_per_m)
            .damping_Ns_per_m;
  if (!haptics::can_render(surface.transient, device, rate_hz)) limited.transient = {};
  if (const double pull_N = norm(surface.pull_N); pull_N > models::kMaxGuideForce_N)
    limited.pull_N = (models::kMaxGuideForce_N / pull_N) * surface.pull_N;
  return limited;
}

haptics::ServoOptions shared_servo(haptics::ServoOptions servo) {
  servo.tick.ramp_down_s = kSharedRampDown_s;
  servo.tick.ramp_loads = false;
  return servo;
}

}  // namespace palpable::session
