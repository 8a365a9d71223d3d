// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace palpable::device {

/// A decaying vibration after an impact at speed v: f(t) = a v exp(-b t) sin(2 pi f t) (Okamura, Dennerlein &
/// Howe 1998). It is superposed on the force of the contact spring (Kuchenbecker, Fiene & Niemeyer 2006).
struct ContactTransient {
  /// a, N per m/s; >= 0.
  double force_per_speed_Ns_per_m = 0.0;
  /// f, Hz; 0: no vibration.
  double frequency_hz = 0.0;
  /// b, 1/s.
  double decay_per_s = 0.0;

  bool operator==(const ContactTransient&) const = default;
};

/// Whether all values are finite, and it ends within seconds.
inline bool is_valid(const ContactTransient& transient) noexcept {
  constexpr double kMost = 1e4;
  const auto within = [](double value, double least) { return value >= least && value <= kMost; };
  return within(transient.force_per_speed_Ns_per_m, 0.0) && within(transient.frequency_hz, 0.0) &&
         within(transient.decay_per_s, transient.frequency_hz > 0.0 ? 1.0 : 0.0);
}

}  // namespace palpable::device
