// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/session/check/recorded_forces.hpp"

#include "palpable/haptics/safety/limits.hpp"
#include "palpable/haptics/tick/rotation.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace palpable::session {
namespace {

namespace flag = haptics::flag;

/// Rounding error of a force that was rotated into the scene frame and back.
constexpr double kRounding_N = 1e-9;

/// Times are sums of whole nanoseconds, stored in seconds.
constexpr double kRounding_s = 1e-8;

double max_allowed_N(const RecordedSession& session) {
  const double device_N =
      session.traits ? session.traits->max_force_N : std::numeric_limits<double>::infinity();
  return std::min(device_N, session.tick.max_force_N);
}

double slowest_hz(const RecordedSession& session) {
  // A device without a rate of its own states none (NaN).
  return session.traits && session.traits->rate_hz > 0.0 ? std::min(session.rate_hz, session.traits->rate_hz)
                                                         : session.rate_hz;
}

}  // namespace

RecordedForces::RecordedForces(const RecordedSession& session, Findings& findings)
    : session_(session),
      findings_(findings),
      max_allowed_N_(max_allowed_N(session)),
      is_replay_(session.device_url.starts_with("replay:")),
      slowest_hz_(slowest_hz(session)),
      work_(session.traits.value_or(device::Traits{}), session.tick) {}

void RecordedForces::take(const device::TouchSample& tick, const RecordedTouch* touch) {
  check_time(tick);
  ++ticks_;
  contact_ticks_ += tick.has(flag::kContact) ? 1 : 0;
  duration_s_ += tick.dt_s;
  const Transform<SceneFrame, DeviceFrame> place =
      touch != nullptr ? touch->scene_from_device : Transform<SceneFrame, DeviceFrame>{};
  const Vector<DeviceFrame> force_N = rotate_force(place.inverse(), tick.written_force_N);
  check_force(tick, force_N);
  check_work(tick, touch, force_N);
}

bool RecordedForces::agrees(const device::TouchSample& tick) const {
  const double between_ticks_s = tick.t_s - before_s_;
  // Least length of a tick that follows a late one (ServoLoop).
  const double shortest_s = 0.1 / slowest_hz_;
  if (tick.dt_s <= 1.001 * shortest_s && between_ticks_s <= tick.dt_s) return true;
  // What a replay repeats has the times of its recording; only where it has nothing to repeat, it is stale.
  if (is_replay_ && (tick.status == device::Status::stale || before_status_ == device::Status::stale))
    return true;
  return std::abs(between_ticks_s - tick.dt_s) <= kRounding_s;
}

void RecordedForces::check_time(const device::TouchSample& tick) {
  if (tick.probe != 0)
    findings_.add(FindingKind::damage, tick, 0.0, "a tick of the hand has the number of another probe");
  if (ticks_ > 0 && tick.tick < next_tick_) {
    findings_.add(FindingKind::damage, tick, 0.0, "its ticks are not in their order");
    knows_before_ = false;
    work_.forget_place();
  } else if (ticks_ > 0 && tick.tick > next_tick_) {
    findings_.add(FindingKind::lost_ticks, tick, static_cast<double>(tick.tick - next_tick_));
    knows_before_ = false;
    work_.forget_place();
  } else if (ticks_ > 0 && !agrees(tick)) {
    findings_.add(FindingKind::damage, tick, 0.0, "the times of its ticks contradict their periods");
  }
  next_tick_ = tick.tick + 1;
  before_s_ = tick.t_s;
  before_status_ = tick.status;
  periods_.record_ns(1e9 * tick.dt_s);
  const double missed = std::floor(tick.dt_s * session_.rate_hz) - 1.0;
  if (ticks_ == 0 || !(missed >= 1.0)) return;
  missed_ += static_cast<std::uint64_t>(missed);
  findings_.add(FindingKind::missed, tick, missed);
}

void RecordedForces::check_held(const device::TouchSample& tick) {
  // Without motors nothing is cut, and nothing is felt.
  if (!knows_before_ || (session_.traits && !session_.traits->pushes_back)) return;
  const double held_N = norm(before_N_);
  if (held_N > 0.0 && !tick.has(flag::kStalled) && tick.dt_s - 1.0 / slowest_hz_ > kLongestHold_s)
    findings_.add(FindingKind::held_force, tick, held_N, {}, tick.dt_s);
}

void RecordedForces::check_force(const device::TouchSample& tick, Vector<DeviceFrame> force_N) {
  check_held(tick);
  if (!is_finite(force_N)) {
    findings_.add(FindingKind::not_finite, tick, 0.0);
    knows_before_ = false;
    return;
  }
  const double size_N = norm(force_N);
  max_force_N_ = std::max(max_force_N_, size_N);
  if (size_N > max_allowed_N_ + kRounding_N)
    findings_.add(FindingKind::force_cap, tick, size_N - max_allowed_N_);
  if (tick.has(flag::kStalled)) before_N_ = {};
  if (knows_before_ || tick.tick == 0) {
    max_step_N_ = std::max(max_step_N_, norm(force_N - before_N_));
    const double rise_N = session_.tick.max_force_rate_N_per_s *
                          std::min(tick.dt_s, session_.traits ? session_.tick.max_rise_time_s
                                                              : std::numeric_limits<double>::infinity());
    // The growth beyond the rise limit.
    const auto limited = haptics::cap_rise(force_N, before_N_, rise_N);
    const double beyond_N = norm(force_N - limited.force_N);
    if (limited.limited && beyond_N > kRounding_N) findings_.add(FindingKind::force_step, tick, beyond_N);
  }
  before_N_ = force_N;
  knows_before_ = true;
}

void RecordedForces::check_work(const device::TouchSample& tick, const RecordedTouch* touch,
                                Vector<DeviceFrame> force_N) {
  haptics::ShownWork::Tick shown;
  shown.position = tick.device_position;
  shown.is_valid = tick.status == device::Status::ok && !tick.has(flag::kNoReading);
  shown.dt_s = tick.dt_s;
  shown.written_N = is_finite(force_N) ? force_N : Vector<DeviceFrame>{};
  shown.flags = tick.flags;
  // Neither for other laws, nor with a guide, whose reserve gives energy, nor beside the work of a torque
  // does that of the force prove anything.
  const haptics::LawDescription* law = touch != nullptr ? &haptics::description_of(touch->law.law) : nullptr;
  shown.is_contact_law =
      law != nullptr && law->is_contact && !touch->guide && !(session_.traits && session_.traits->has_torque);
  // As the law's own EnergyModel.
  shown.has_spring = law != nullptr && law->conservative && !(touch->law.force_shading.value_or(0.0) > 0.0);
  // With a new touch the balance begins anew after the work of the jump.
  const double before_J = work_.made_max_J();
  work_.take(shown);
  const double made_J = work_.made_max_J() > before_J ? work_.made_max_J() : work_.made_J();
  if (shown.is_contact_law && made_J > kEnergyMade_J) findings_.add(FindingKind::energy_made, tick, made_J);
}

bool is_in_free_air(const haptics::HapticScene& scene, const device::TouchSample& before,
                    const device::TouchSample& tick) {
  const auto is_clear = [&](Vec3 place) {
    haptics::TouchState state;
    haptics::Hand hand{{place}, {}, tick.dt_s};
    hand.rotation = haptics::rotation_in_scene(scene.scene_from_device, tick.device_rotation);
    return !scene.touchable->evaluate(hand, state).contact;
  };
  const auto is_way_clear = [&](Vec3 from, Vec3 to) {
    // Most ways that are not clear are found out by a few places; the top of a crest may be cut in a few
    // micrometres of depth only.
    constexpr double kMostPlaces = 4000.0;
    for (const double spacing_m : {1e-4, 4e-6}) {
      const double steps = std::clamp(std::ceil(norm(to - from) / spacing_m), 1.0, kMostPlaces);
      for (double k = 0.0; k <= steps; ++k)
        if (!is_clear(from + (k / steps) * (to - from))) return false;
    }
    return true;
  };
  const Vec3 hand = tick.position.v;
  if (!is_clear(hand) || !is_way_clear(before.position.v, hand)) return false;
  return !tick.has(flag::kHasProxy) || is_way_clear(hand, tick.proxy.v);
}

}  // namespace palpable::session
