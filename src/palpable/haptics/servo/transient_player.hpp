// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/frame.hpp"
#include "palpable/device/device.hpp"
#include "palpable/haptics/servo/contact_transient.hpp"

namespace palpable::haptics {

/// Whether a device at this loop rate can render a transient: it has motors, and a period of the vibration
/// has five ticks at least, of the loop and of the device.
bool can_render(const ContactTransient& transient, const device::Traits& device, double rate_hz) noexcept;

/// Renders contact transients: short vibrations along the surface's normal that are superposed on the force
/// of a law when the hand strikes a surface (Kuchenbecker, Fiene & Niemeyer 2006). The amplitude grows with
/// the speed of the impact; at first the force pushes outwards. It never turns a push into a pull, and ends
/// with the contact. All zero = nothing to render. Tick path; no allocation.
class TransientPlayer {
 public:
  struct Limits {
    /// Of the amplitude.
    double max_N = 0.0;
    /// Of the force's growth: the amplitude times 2 pi f is no greater.
    double max_rate_N_per_s = 0.0;
    /// A hand that touches more slowly than this does not strike.
    double least_speed_m_per_s = 0.0;
  };

  /// An impact at `velocity_m_per_s` on a surface that pushes along `push_N`.
  void strike(const ContactTransient& transient, Vector<DeviceFrame> push_N,
              Vector<DeviceFrame> velocity_m_per_s, const Limits& limits) noexcept;
  void stop() noexcept { *this = {}; }

  /// What is added to the force `push_N` for the next `dt_s`: the vibration in the middle of that time.
  Vector<DeviceFrame> step(Vector<DeviceFrame> push_N, double dt_s) noexcept;
  bool is_playing() const noexcept { return amplitude_N_ > 0.0; }

 private:
  ContactTransient transient_;
  Vector<DeviceFrame> outward_;
  double amplitude_N_ = 0.0;
  double elapsed_s_ = 0.0;
};

}  // namespace palpable::haptics
