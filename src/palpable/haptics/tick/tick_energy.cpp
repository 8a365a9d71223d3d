// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// The energy of a tick: what the springs store, what of it the hand gave, and what was made.
#include "palpable/haptics/tick/tick.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace palpable::haptics {

TickPipeline::Forces TickPipeline::as_written(const Sent& sent) noexcept {
  return {sent.written_N - sent.guide_N, sent.written_Nm};
}

TickPipeline::Forces TickPipeline::as_uncontrolled(const Sent& sent) noexcept {
  return {sent.uncontrolled_N - sent.guide_N, sent.uncontrolled_Nm};
}

bool TickPipeline::has_spring() const noexcept {
  return now_.energy == EnergyModel::spring && (!fading() || coming_.energy == EnergyModel::spring);
}

bool TickPipeline::is_accounted() const noexcept {
  // Without motors nothing comes back to a hand.
  return has_spring() && device_.traits().pushes_back;
}

TickPipeline::Potential TickPipeline::potential(double faded) const noexcept {
  const auto stored = [this](const Side& side, Vector<SceneFrame> spring_N, double stored_J) {
    return Potential{device_force_N(side, spring_N), stored_J / side.scene->scene_from_device.scale, {}};
  };
  const auto of = [&](const Side& side) { return stored(side, side.output.spring_N, side.output.stored_J); };
  Potential p = of(now_);
  if (moves_) {
    const SurfaceBetween between = surface_between(from_, to_, faded);
    p = stored(now_, between.spring_N, between.stored_J);
  } else if (fading() && now_.energy == coming_.energy) {
    // A blend of two forces with potentials is the force of their energies' blend.
    const Potential next = of(coming_);
    p.spring_N += faded * (next.spring_N - p.spring_N);
    p.stored_J += faded * (next.stored_J - p.stored_J);
  }
  // Potentials of different kinds are not blended: the new one counts from the end of the change on.
  const bool is_new = fading() && now_.energy != coming_.energy && faded >= 1.0;
  if (is_new) p = of(coming_);
  p.uncapped_N = p.spring_N;
  // If a spring exceeds the force cap, the hand only works against the capped force. A spring that stores U
  // at a force f then stores U (2r - r^2) up to the cap r f.
  const EnergyModel energy = is_new ? coming_.energy : now_.energy;
  if (const double size_N = norm(p.spring_N); energy == EnergyModel::spring && size_N > heat_.cap_N()) {
    const double ratio = heat_.cap_N() / size_N;
    p.stored_J *= ratio * (2.0 - ratio);
    p.spring_N = ratio * p.spring_N;
  }
  // The law uses the reading, but within the sensor's step the hand is elsewhere; the spring force is the
  // gradient in between. (The damper is not corrected: its jumps with the sensor's steps would appear as
  // energy.)
  p.stored_J -= dot(p.spring_N, fine_.place() - position_);
  return p;
}

Vector<DeviceFrame> TickPipeline::way_of_surface() const noexcept {
  return (faded_ - faded_before_) * (now_.device_from_scene * (to_.to_surface_m - from_.to_surface_m));
}

double TickPipeline::loading_s(const Potential& p, double dt_s) const noexcept {
  const double spring_N = norm(p.spring_N);
  if (!is_accounted() || !(spring_N > 0.0) || !(p.stored_J > 0.0)) return dt_s;
  // A spring that stores U at a force f is 2 U / f deep.
  const double lift_s = std::min(2.0 * p.stored_J / (spring_N * kLift_m_per_s), kLongestLift_s);
  return dt_s * std::min(1.0, ramp_.up_s() / lift_s);
}

void TickPipeline::account_spring(double dt_s, bool wanted) noexcept {
  // The ramp is only used for hands that are in contact when their touch begins.
  if (wanted && is_free()) ramp_.finish();
  // After a stall the ramp starts as usual: it did not rise while no tick was executed.
  const double risen_s = std::min(dt_s, options_.max_rise_time_s);
  const Potential p = potential(faded_);
  stored_J_ = p.stored_J;
  spring_N_ = p.uncapped_N;
  RiseLimit::Input in;
  in.loads = loads_ && wanted && options_.ramp_loads;
  in.gain = ramp_.step(wanted, wanted ? (in.loads ? loading_s(p, risen_s) : risen_s) : dt_s);
  // A stall leaves a spring that was loaded before it.
  loads_ = in.gain < 1.0 && (loads_ || in.gain <= 0.0);
  in.gain_rise = risen_s / ramp_.up_s();
  in.spring_N = p.spring_N;
  in.stored_J = is_accounted() ? p.stored_J : std::numeric_limits<double>::quiet_NaN();
  in.changed_J = changed_J_ = fading() ? p.stored_J - potential(faded_before_).stored_J : 0.0;
  in.moves = goes_on_;
  // What the surface's dampers and friction brought since the previous reading.
  in.damped_J = damped_J_ = dot(held().damper_N, surface_moved_m_);
  const double spring_N = norm(p.spring_N);
  in.unsure_J = unsure_J(p.spring_N);
  if (spring_N > 0.0) in.moved_out_m = dot(p.spring_N, moved_) / spring_N;
  if ((flags_ & flag::kStalled) != 0) {
    account_stall(in, dt_s);
    return;
  }
  const auto account = [&](RiseLimit& rise, double received_J, Forces (*sent_as)(const Sent&)) {
    in.received_J = received_J;
    in.coming_J = rise.is_weaker() ? on_the_way_J(sent_as, risen_s) : 0.0;
    rise.account(in);
  };
  account(rise_, received_.written_J, as_written);
  account(uncontrolled_rise_, received_.uncontrolled_J, as_uncontrolled);
}

/// Of the written force what is not the spring's, while the surface moves.
Vector<DeviceFrame> TickPipeline::damper_N() const noexcept {
  if (surface_m_per_s_ == Vector<DeviceFrame>{}) return {};
  if (rise_.is_weaker())
    return written_N_ - guide_N_ - rise_.share() * cap_force(spring_N_, heat_.cap_N()).force_N;
  const double law_N = norm(law_force_N_);
  if (!(law_N > 0.0)) return {};
  return std::min(1.0, norm(written_N_) / law_N) * (law_force_N_ - guide_N_ - spring_N_);
}

void TickPipeline::count_received() noexcept {
  const Sent& acted = held();
  received_ = {dot(acted.written_N, moved_) + dot(acted.written_Nm, rotated_),
               dot(acted.uncontrolled_N, moved_) + dot(acted.uncontrolled_Nm, rotated_)};
}

void TickPipeline::account_stall(RiseLimit::Input in, double dt_s) noexcept {
  // How the hand moved until the watchdog cut the force is not known. It may have come back since, so the
  // spring returns the energy only that it would also hold after a movement out at the last velocity, with
  // the acceleration of the device's own mass.
  const double held_s = std::min(dt_s, options_.stall_s);
  const double mass_kg = device_.traits().mass_kg;
  const auto account = [&](RiseLimit& rise, Vector<DeviceFrame> force_N, Vector<DeviceFrame> torque_Nm) {
    const double shown_J = std::max(0.0, held_s / dt_s * (dot(force_N, moved_) + dot(torque_Nm, rotated_)));
    const double accelerated_m = mass_kg > 0.0 ? 0.5 * held_s * held_s * norm(force_N) / mass_kg : 0.0;
    const double possible_J =
        held_s * dot(force_N, dropped_velocity_m_per_s_) + accelerated_m * norm(force_N);
    const double before_J = rise.input_energy_J();
    in.received_J = std::max(shown_J, possible_J);
    rise.account(in);
    return std::max(shown_J, before_J - rise.input_energy_J());
  };
  received_ = {account(rise_, dropped_.written_N, dropped_.written_Nm),
               account(uncontrolled_rise_, dropped_.uncontrolled_N, dropped_.uncontrolled_Nm)};
}

double TickPipeline::given_J(const RiseLimit& rise) const noexcept {
  // Near the surface the spring's slope within the sensor's step may be a little below zero.
  return is_accounted() && rise.is_weaker() ? rise.input_energy_J() : stored_J_;
}

void TickPipeline::count_scene_change() noexcept {
  if ((flags_ & flag::kFading) == 0) {
    counts_.scene_change_J += rise_.brought_J();
    return;
  }
  // What a change brings. On the same surface that is what its parameters add to the spring; otherwise the
  // work during it, and what the springs store more than before it.
  const double given = given_J(rise_);
  const bool continues = same_surface_ || goes_on_;
  change_work_J_ += continues ? changed_J(rise_) : received_.written_J;
  const double more_J = continues || !std::isfinite(given) ? 0.0 : given - stored_before_change_J_;
  const double most_J = std::max(change_brought_J_, change_work_J_ + more_J);
  counts_.scene_change_J += most_J - change_brought_J_;
  change_brought_J_ = most_J;
}

double TickPipeline::changed_J(const RiseLimit& rise) const noexcept {
  const double added_J = is_accounted() ? rise.added_J() : changed_J_;
  const bool adds = (same_surface_ || goes_on_) && std::isfinite(added_J);
  return (adds ? added_J : 0.0) + rise.brought_J() + damped_J_;
}

void TickPipeline::observe() noexcept {
  const bool contact = is_in_contact();
  const bool stalled = (flags_ & flag::kStalled) != 0;
  PassivityObserver::Step step;
  step.held_force_N = held().written_N;
  step.moved_m = moved_;
  step.surface_moved_m = surface_moved_m_;
  step.rotation_J = stalled ? received_.written_J : dot(held().written_Nm, rotated_);
  step.guide_N = held().guide_N;
  step.dt_s = passed_s_;
  step.delay = delay_;
  step.is_spring = now_.energy == EnergyModel::spring;
  step.contact = contact || (fading() && !moves_ && coming_.output.contact);
  step.damping_Ns_per_m = contact ? now_.scene->touchable->damping_Ns_per_m() : 0.0;
  step.shortened = shortened_;
  step.scene_changes = scene_changes_;
  step.weakened = held().weakened;
  count_scene_change();
  // The springs of two scenes cannot be compared: during a change only their work is counted.
  const bool new_account =
      (flags_ & flag::kNewTouch) != 0 || ((flags_ & flag::kFading) != 0 && !same_surface_ && !goes_on_);
  if (new_account) {
    using Beginning = PassivityObserver::Beginning;
    // A potential that is defined everywhere may be high where the touch begins: no beginning without energy.
    // Nor is one without force in which the ramp has loaded the spring already.
    const bool from_no_force = (flags_ & flag::kNewTouch) != 0 && now_.energy != EnergyModel::weight &&
                               device_.traits().pushes_back && !(rise_.brought_J() > 0.0);
    const Beginning beginning = from_no_force ? Beginning::from_no_force : Beginning::in_contact;
    observer_.begin(given_J(rise_), beginning);
    without_controller_.begin(given_J(uncontrolled_rise_), beginning);
    return;
  }
  step.stored_J = given_J(rise_);
  step.changed_J = changed_J(rise_);
  rise_.take_back(observer_.update(step));
  step.stored_J = given_J(uncontrolled_rise_);
  step.changed_J = changed_J(uncontrolled_rise_);
  step.weakened = false;
  step.held_force_N = held().uncontrolled_N;
  step.rotation_J = stalled ? received_.uncontrolled_J : dot(held().uncontrolled_Nm, rotated_);
  uncontrolled_rise_.take_back(without_controller_.update(step));
}

void TickPipeline::count_shown_work() noexcept {
  ShownWork::Tick shown;
  shown.position = sample_.device_position;
  shown.is_valid = sample_.status == device::Status::ok && !sample_.has(flag::kNoReading);
  shown.dt_s = sample_.dt_s;
  shown.written_N = written_N_;
  shown.guide_N = guide_N_;
  shown.flags = sample_.flags;
  shown.is_contact_law =
      !has_torque_ && (now_.energy == EnergyModel::spring || now_.energy == EnergyModel::none);
  shown.has_spring = now_.energy == EnergyModel::spring;
  shown_.take(shown);
  constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
  counts_.work_made_max_J = shown_.counts() ? shown_.made_max_J() : kUnknown;
  counts_.work_since_zero_force_max_J = shown_.counts() ? shown_.since_zero_max_J() : kUnknown;
}

void TickPipeline::account_returns() noexcept {
  const double stored_J = is_accounted() ? stored_J_ : std::numeric_limits<double>::infinity();
  // A guide's own reserve bounds what its pull gives.
  const double guide_J = (flags_ & flag::kStalled) != 0 ? 0.0 : dot(held().guide_N, moved_);
  returns_.account(received_.written_J - guide_J, stored_J);
  uncontrolled_returns_.account(received_.uncontrolled_J - guide_J, stored_J);
  // What a change of scene or of parameters brings is not the law's. A spring that is ramped up under a hand
  // returns what the rise limit says.
  if (is_changing() || ramp_.value() < 1.0) {
    returns_.raise_to(stored_J_);
    uncontrolled_returns_.raise_to(stored_J_);
  }
  // The last force of a contact may act after the hand has left it.
  if (std::exchange(returns_end_, false)) begin_returns();
  if (!is_free()) return;
  for (std::size_t age = 0; age + 1 < delay_; ++age) {
    const Sent& sent = sent_[(newest_ + sent_.size() - age) % sent_.size()];
    if (sent.written_N != Vector<DeviceFrame>{} || sent.uncontrolled_N != Vector<DeviceFrame>{}) return;
  }
  returns_end_ = delay_ > 0;
  if (!returns_end_) begin_returns();
}

void TickPipeline::begin_returns() noexcept {
  returns_.begin();
  uncontrolled_returns_.begin();
}

double TickPipeline::without_step(double share, const Forces& wanted, const Forces& before,
                                  double dt_s) const noexcept {
  const auto least = [](Vec3 of, Vec3 from, double most_step) {
    const double square = squared_norm(of);
    if (!(square > 0.0)) return 0.0;
    // The least share of a force whose step from the one before is at most this, or as long as the law's own.
    const double most = std::max(most_step * most_step, squared_norm(of - from));
    const double along = dot(of, from);
    const double root = std::sqrt(std::max(0.0, along * along - square * (squared_norm(from) - most)));
    // Where the law makes a long step itself, that share may be 1: at most so much less than the law wants.
    const double less = 1.0 - most_step / std::sqrt(square);
    return std::clamp(std::min((along - root) / square, less), 0.0, 1.0);
  };
  return std::max({share, least(wanted.force_N.v, before.force_N.v, options_.max_force_rate_N_per_s * dt_s),
                   least(wanted.torque_Nm.v, before.torque_Nm.v, options_.max_torque_rate_Nm_per_s * dt_s)});
}

double TickPipeline::unsure_J(Vector<DeviceFrame> force_N) const noexcept {
  // The place is known to half a step, and the way in a tick, by two readings, to a whole one.
  const Vec3 f = force_N.v;
  return 3.0 * fine_.half_step_m() * (std::abs(f.x) + std::abs(f.y) + std::abs(f.z));
}

double TickPipeline::on_the_way_J(Forces (*sent_as)(const Sent&), double dt_s) const noexcept {
  const Vector<DeviceFrame> v = velocity_m_per_s();
  const Vector<DeviceFrame> gains = gains_m_per_s();
  const Vector<DeviceFrame> w = rotation_.velocity_rad_per_s();
  double coming_J = 0.0;
  for (std::size_t age = 0; age < delay_; ++age) {
    const Forces sent = sent_as(sent_[(newest_ + sent_.size() - age) % sent_.size()]);
    coming_J += dt_s * std::max(0.0, dot(sent.force_N, v) + std::max(0.0, dot(sent.force_N, gains)) +
                                         dot(sent.torque_Nm, w));
  }
  return coming_J;
}

double TickPipeline::returned_share(const ReturnLimit& limit, const Forces& wanted,
                                    Forces (*sent_as)(const Sent&), double dt_s) const noexcept {
  const Vector<DeviceFrame> v = velocity_m_per_s();
  const Vector<DeviceFrame> w = rotation_.velocity_rad_per_s();
  ReturnLimit::Sending sending;
  sending.power_W =
      dot(wanted.force_N, v) + std::max(0.0, dot(wanted.force_N, gains_m_per_s())) + dot(wanted.torque_Nm, w);
  if (sending.power_W <= 0.0) return 1.0;
  sending.on_the_way_J = on_the_way_J(sent_as, dt_s);
  sending.unsure_J = std::max(unsure_J(wanted.force_N), unsure_J(sent_as(held()).force_N));
  sending.force_N = norm(wanted.force_N);
  // The next force acts when the device has given its next reading.
  sending.dt_s = readings_.ticks() * dt_s;
  sending.mass_kg = device_.traits().mass_kg;
  return without_step(limit.share(sending), wanted, sent_as(sent_[newest_]), dt_s);
}

void TickPipeline::limit_returns(double dt_s) noexcept {
  if (options_.returns == Returns::free || !is_accounted() || is_changing()) return;
  const auto reduce = [&](const ReturnLimit& limit, RiseLimit& rise, Vector<DeviceFrame>& force_N,
                          Vector<DeviceFrame>& torque_Nm, Forces (*sent_as)(const Sent&)) {
    const double share = returned_share(limit, {force_N - guide_N_, torque_Nm}, sent_as, dt_s);
    if (share >= 1.0) return;
    force_N = guide_N_ + share * (force_N - guide_N_);
    torque_Nm = share * torque_Nm;
    rise.weakened_to(force_N);
  };
  reduce(returns_, rise_, written_N_, written_Nm_, as_written);
  reduce(uncontrolled_returns_, uncontrolled_rise_, uncontrolled_N_, uncontrolled_Nm_, as_uncontrolled);
}

Vector<DeviceFrame> TickPipeline::velocity_m_per_s() const noexcept {
  return fine_.flickers() ? (1.0 / passed_s_) * moved_ : motion_.velocity_m_per_s();
}

Vector<DeviceFrame> TickPipeline::gains_m_per_s() const noexcept {
  return fine_.flickers() ? Vector<DeviceFrame>{} : motion_.gains_m_per_s();
}

Vector<DeviceFrame> TickPipeline::sure_velocity_m_per_s(double dt_s) const noexcept {
  // The reading of a hand at rest may go to and fro by a step: over the longest window that is up to this
  // velocity, with a margin for windows that are a little shorter.
  constexpr double kMargin = 1.5;
  const double unsure = kMargin * 2.0 * fine_.half_step_m() / ((VelocityEstimator::kSamples - 1) * dt_s);
  const auto sure = [&](double v) { return std::copysign(std::max(0.0, std::abs(v) - unsure), v); };
  const Vec3 v = velocity_m_per_s().v;
  return {{sure(v.x), sure(v.y), sure(v.z)}};
}

void TickPipeline::control_energy(double dt_s) noexcept {
  if (options_.passivity != Passivity::control || now_.energy == EnergyModel::self_limited) return;
  const double gives_W =
      dot(written_N_, sure_velocity_m_per_s(dt_s)) + dot(written_Nm_, rotation_.velocity_rad_per_s());
  // Less than a tenth of what the tests of energy allow is let pass: on a frictionless slope the sensor's
  // steps show as much, and a force that is reduced for it comes back a tick later.
  constexpr double kUnfelt_J = 1e-7;
  const double made_J = observer_.made_J();
  const double wanted =
      made_J > kUnfelt_J ? passivity_factor(gives_W, made_J, readings_.ticks() * dt_s) : 1.0;
  if (wanted >= 1.0) return;
  const Sent& before = sent_[newest_];
  const double factor = without_step(wanted, {written_N_, written_Nm_}, {before.written_N, before.written_Nm},
                                     std::min(dt_s, options_.max_rise_time_s));
  if (factor >= 1.0) return;
  flags_ |= flag::kPassivityActed;
  written_N_ = factor * written_N_;
  written_Nm_ = factor * written_Nm_;
  // From this value it grows within the rise limit.
  rise_.weakened_to(written_N_);
}

}  // namespace palpable::haptics
