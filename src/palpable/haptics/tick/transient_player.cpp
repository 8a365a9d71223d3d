// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/haptics/tick/transient_player.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace palpable::haptics {

bool can_render(const ContactTransient& transient, const device::Traits& device, double rate_hz) noexcept {
  constexpr double kTicksPerPeriod = 5.0;
  const double ticks_per_s = device.rate_hz < rate_hz ? device.rate_hz : rate_hz;
  return device.pushes_back && kTicksPerPeriod * transient.frequency_hz <= ticks_per_s;
}

void TransientPlayer::strike(const ContactTransient& transient, Vector<DeviceFrame> push_N,
                             Vector<DeviceFrame> velocity_m_per_s, const Limits& limits) noexcept {
  const double size_N = norm(push_N);
  if (!(size_N > 0.0 && transient.frequency_hz > 0.0)) return;
  const Vector<DeviceFrame> outward = (1.0 / size_N) * push_N;
  const double speed = -dot(velocity_m_per_s, outward);
  if (!(speed >= limits.least_speed_m_per_s)) return;
  const double pulsation = 2.0 * std::numbers::pi * transient.frequency_hz;
  transient_ = transient;
  outward_ = outward;
  amplitude_N_ = std::min(
      {transient.force_per_speed_Ns_per_m * speed, limits.max_N, limits.max_rate_N_per_s / pulsation});
  elapsed_s_ = 0.0;
}

Vector<DeviceFrame> TransientPlayer::step(Vector<DeviceFrame> push_N, Vector<DeviceFrame> spring_N,
                                          double dt_s) noexcept {
  if (!is_playing()) return {};
  constexpr double kEnded = 0.01;
  const double middle_s = elapsed_s_ + 0.5 * dt_s;
  elapsed_s_ += dt_s;
  const double envelope = std::exp(-transient_.decay_per_s * middle_s);
  double wanted_N =
      amplitude_N_ * envelope * std::sin(2.0 * std::numbers::pi * transient_.frequency_hz * middle_s);
  if (envelope < kEnded) amplitude_N_ = 0.0;
  wanted_N = std::max(wanted_N, -std::max(0.0, dot(push_N, outward_)));
  // The surface may have turned since it was struck.
  if (const double size_N = norm(spring_N); size_N > 0.0) {
    const Vector<DeviceFrame> now = (1.0 / size_N) * spring_N;
    const double along = dot(outward_, now);
    const double most_N = std::max(0.0, dot(push_N, now));
    if (wanted_N * along < -most_N) wanted_N = -most_N / along;
  }
  return wanted_N * outward_;
}

}  // namespace palpable::haptics
