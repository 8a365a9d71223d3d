// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/frame.hpp"
#include "palpable/device/device.hpp"
#include "palpable/haptics/tick/contact_transient.hpp"

namespace palpable::haptics {

/// Whether a device can render a transient at this loop rate: it has motors, and a period of the vibration
/// has at least five ticks of the loop and of the device.
bool can_render(const ContactTransient& transient, const device::Traits& device, double rate_hz) noexcept;

/// Renders contact transients: short vibrations along the surface normal that are superposed on the law's
/// force when the hand hits a surface (Kuchenbecker, Fiene & Niemeyer 2006). The amplitude is proportional to
/// the impact speed; the first half-wave pushes outwards. The sum is never a pull, and the vibration ends
/// with the contact. A default-constructed object renders nothing. Tick path; no allocation.
class TransientPlayer {
 public:
  struct Limits {
    /// Of the amplitude, N.
    double max_N = 0.0;
    /// Of the growth of the force: amplitude times 2 pi f is at most this.
    double max_rate_N_per_s = 0.0;
    /// A contact at a lower speed is not an impact.
    double least_speed_m_per_s = 0.0;
  };

  /// Starts a vibration: an impact at `velocity_m_per_s` on a surface that pushes along `push_N`.
  void strike(const ContactTransient& transient, Vector<DeviceFrame> push_N,
              Vector<DeviceFrame> velocity_m_per_s, const Limits& limits) noexcept;
  void stop() noexcept { *this = {}; }

  /// The force to add to `push_N` during the next `dt_s`: the vibration at the middle of that time, as far as
  /// the sum pulls neither against the surface that was struck nor against `spring_N`, the spring's part of
  /// the push now (0: unknown).
  Vector<DeviceFrame> step(Vector<DeviceFrame> push_N, Vector<DeviceFrame> spring_N, double dt_s) noexcept;
  bool is_playing() const noexcept { return amplitude_N_ > 0.0; }

 private:
  ContactTransient transient_;
  Vector<DeviceFrame> outward_;
  double amplitude_N_ = 0.0;
  double elapsed_s_ = 0.0;
};

}  // namespace palpable::haptics
