// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// From the law's force to the one that is written: its limits, one after the other.
#include "palpable/haptics/tick/tick.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace palpable::haptics {
namespace {

/// The share of a force that the rise limit may shorten in a tick because the force turns (cap_rise()): all
/// of it but in ticks that are shorter than three quarters of the period, as they follow late ones.
double most_lost(double dt_s, const TickOptions& options) {
  // max_rise_time_s is one and a half periods.
  const double periods = 1.5 * dt_s / options.max_rise_time_s;
  return periods < 0.75 ? periods : 1.0;
}

}  // namespace

Vector<DeviceFrame> TickPipeline::with_transient(Vector<DeviceFrame> force_N, double dt_s) noexcept {
  const bool touches = is_in_contact();
  const bool strikes = !std::exchange(was_in_contact_, touches) && touches;
  // During a fade or a ramp, a vibration would belong to neither surface.
  if (!touches || is_changing() || ramp_.value() < 1.0) {
    transient_.stop();
    return force_N;
  }
  if (strikes) {
    const ContactTransient* const own = now_.scene->touchable->transient();
    transient_.strike(own != nullptr ? *own : now_.scene->transient, force_N, motion_.velocity_m_per_s(),
                      {options_.max_transient_of_force * max_force_N_, options_.max_force_rate_N_per_s,
                       options_.impact_speed_m_per_s});
    counts_.transients += transient_.is_playing() ? 1 : 0;
  }
  return force_N + transient_.step(force_N, spring_N_, dt_s);
}

void TickPipeline::make_force(double dt_s) noexcept {
  const Vector<DeviceFrame> wanted_N = with_transient(law_force_N_, dt_s);
  const auto capped = cap_force(wanted_N, heat_.cap_N());
  const double risen_s = std::min(dt_s, options_.max_rise_time_s);
  const double max_rise_N = options_.max_force_rate_N_per_s * risen_s;
  const double gain = ramp_.value();
  const Vector<DeviceFrame> rest_N = wanted_N - spring_N_;
  const Vector<DeviceFrame> v = motion_.velocity_m_per_s();
  const double lost = most_lost(dt_s, options_);
  const auto risen = rise_.limit(capped.force_N, rest_N, max_rise_N, v, lost);
  uncontrolled_N_ = uncontrolled_rise_.limit(capped.force_N, rest_N, max_rise_N, v, lost).force_N;
  written_N_ = risen.force_N;
  if (has_torque_) make_torque(risen_s);
  limit_returns(risen_s);
  if (gain > 0.0) control_energy(dt_s);
  if (rise_.is_weaker()) counts_.withheld_max_J = std::max(counts_.withheld_max_J, rise_.withheld_J());
  if (capped.limited) flags_ |= flag::kForceCapped;
  if (risen.limited || rise_.share() < ramp_.value()) flags_ |= flag::kRiseLimited;
  if (gain < 1.0) flags_ |= flag::kRamping;
  if (is_paused()) flags_ |= flag::kPaused;
  scene_changes_ = fading() && !same_surface_ && !goes_on_;
  shortened_ = scene_changes_ || torque_capped_ || (gain < 1.0 && !is_accounted());
}

void TickPipeline::make_torque(double risen_s) noexcept {
  const auto capped = cap_force(law_torque_Nm_, device_.traits().max_torque_Nm);
  const double max_rise_Nm = options_.max_torque_rate_Nm_per_s * risen_s;
  const auto limit = [&](RiseLimit& rise, Vector<DeviceFrame> before_Nm) {
    const Vector<DeviceFrame> wanted_Nm = rise.not_growing(rise.share() * capped.force_N, before_Nm).force_N;
    const auto risen = cap_rise(wanted_Nm, before_Nm, max_rise_Nm, rotation_.velocity_rad_per_s());
    // What is held back of a torque is held back of the same spring.
    if (risen.limited) rise.note_limited();
    return risen;
  };
  uncontrolled_Nm_ = limit(uncontrolled_rise_, uncontrolled_Nm_).force_N;
  const auto risen = limit(rise_, written_Nm_);
  written_Nm_ = risen.force_N;
  torque_capped_ = capped.limited;
  if (capped.limited) flags_ |= flag::kForceCapped;
  if (risen.limited) flags_ |= flag::kRiseLimited;
}

/// The last word: no step before it is trusted. A force that is not finite is none. The rounding of the steps
/// before is not corrected, so that their result stays the same to the last bit.
void TickPipeline::bound(double dt_s) noexcept {
  constexpr double kRounding = 1.0 + 1e-9;
  if (!is_finite(written_N_) || !is_finite(written_Nm_)) {
    flags_ |= flag::kNotFinite;
    drop_force();
    return;
  }
  const double risen_s = std::min(dt_s, options_.max_rise_time_s);
  const Sent& before = sent_[newest_];
  const auto within = [&](Vector<DeviceFrame> wanted, Vector<DeviceFrame> last, double most,
                          double rate_per_s) {
    return bounded(cap_rise(wanted, last, kRounding * rate_per_s * risen_s).force_N, kRounding * most);
  };
  written_N_ = within(written_N_, before.written_N, heat_.cap_N(), options_.max_force_rate_N_per_s);
  written_Nm_ = within(written_Nm_, before.written_Nm, device_.traits().max_torque_Nm,
                       options_.max_torque_rate_Nm_per_s);
}

}  // namespace palpable::haptics
