// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/haptics/tick/tick.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

namespace palpable::haptics {
namespace {

/// Smaller forces cannot be felt (about the detection threshold of a fingertip).
constexpr double kFelt_N = 0.02;

double known_or(double value, double otherwise) { return std::isfinite(value) ? value : otherwise; }

/// 0 if one of the two is not a force.
double max_force_N_of(const TickOptions& options, const device::Traits& traits) {
  const bool valid = options.max_force_N > 0.0 && traits.max_force_N > 0.0;
  return valid ? std::min(options.max_force_N, traits.max_force_N) : 0.0;
}

/// Whether what a law returned can be computed with: forces and energies are finite (a law without a
/// potential states none), and far below values whose squares are not.
bool is_usable(const LawOutput& output) {
  constexpr double kMost = 1e6;
  const auto within = [](Vec3 v) {
    return std::abs(v.x) <= kMost && std::abs(v.y) <= kMost && std::abs(v.z) <= kMost;
  };
  return within(output.force_N.v) && within(output.torque_Nm.v) && within(output.spring_N.v) &&
         within(output.spring_torque_Nm.v) && within(output.guide_N.v) &&
         !(std::abs(output.stored_J) > kMost);
}

}  // namespace

TickPipeline::TickPipeline(device::Device& device, const HapticScene& scene, const TickOptions& options,
                           Ring<TouchEvent>& events, std::uint8_t probe)
    : device_(device),
      takes_surface_(dynamic_cast<device::TakesLocalSurface*>(&device)),
      events_(events),
      options_(options),
      max_force_N_(max_force_N_of(options, device.traits())),
      heat_(max_force_N_, device.traits().pushes_back ? device.traits().continuous_force_N : max_force_N_,
            options.heat),
      planar_(device.traits().degrees_of_freedom < 3),
      readings_(device.traits(), options),
      motion_(device.traits(), options),
      fine_(known_or(device.traits().position_resolution_m, 0.0)),
      has_torque_(device.traits().has_torque),
      rotation_(shortest_window_s(options)),
      ramp_(options.ramp_down_s, options.ramp_up_s),
      delay_(static_cast<std::size_t>(std::clamp(device.traits().delay_samples, 0, kMaxDelay))),
      shown_(device.traits(), options) {
  now_.begin(scene);
  sample_.probe = probe;
}

TickTime TickPipeline::when_of(const device::Reading& reading, double t_s, double dt_s) noexcept {
  bool was_cut = std::exchange(force_was_cut_, false);
  if (cut_ != nullptr && cut_->load(std::memory_order_relaxed))
    was_cut = cut_->exchange(false, std::memory_order_acq_rel) || was_cut;
  TickTime when{t_s, dt_s, was_cut || (dt_s > options_.stall_s && counts_.ticks > 0)};
  if (reading.recorded) {
    // The recorded state applies, not that of this loop.
    const device::RecordedTime& then = *reading.recorded;
    paused_ = (then.flags & flag::kPaused) != 0;
    when = {then.t_s, then.dt_s, (then.flags & flag::kStalled) != 0};
  }
  // The first tick may be at 0.
  return usable_time(when, counts_.ticks > 0 ? sample_.t_s : -kShortestStep_s);
}

const TouchSample& TickPipeline::step(double clock_t_s, double clock_dt_s) noexcept {
  const TouchSample before = sample_;
  flags_ = 0;
  const device::Reading reading = device_.read();
  clutched_ = reading.clutched;
  const auto [t_s, dt_s, stalled] = when_of(reading, clock_t_s, clock_dt_s);
  if (stalled) {
    flags_ |= flag::kStalled;
    ++counts_.stalls;
    // The force comes back within the time for which it was gone: a slower one lets a loaded hand sink more.
    // A ramp that was rising takes no less time than it would have.
    const double up_s = ramp_.value() < 1.0 ? std::max(dt_s, ramp_.up_s()) : dt_s;
    drop_force();
    ramp_.reset(up_s);
  }
  const ReadingUse use = accept(reading, dt_s);
  count_received();
  const bool good = use == ReadingUse::continues || use == ReadingUse::new_touch;
  const bool is_held = use == ReadingUse::glitch || use == ReadingUse::repeated;
  if (fading()) fade(dt_s);
  const bool valid = good && evaluate_laws(dt_s);
  if (!is_held) account_spring(dt_s, valid && !is_paused());
  account_returns();
  if (fading() && faded_ >= 1.0) end_fade();
  observe();
  if (!is_held) make_force(dt_s);
  bound(dt_s);
  send();
  write_device(valid, is_held);

  sample_.t_s = t_s;
  sample_.dt_s = dt_s;
  describe(reading);
  count_shown_work();
  count_heat(dt_s);
  if (good && !valid) emit(TouchEvent::Kind::not_finite, 0);
  if (!is_held) report_status(valid, static_cast<std::uint32_t>(good ? device::Status::ok : reading.status));
  report_changes(before);
  count();
  return sample_;
}

ReadingUse TickPipeline::accept(const device::Reading& reading, double dt_s) noexcept {
  moved_ = {};
  surface_moved_m_ = {};
  rotated_ = {};
  changed_J_ = damped_J_ = 0.0;
  rise_.hold();
  uncontrolled_rise_.hold();
  const JudgedReading judged = readings_.judge(reading, dt_s);
  if (judged.implausible) flags_ |= flag::kImplausible;
  if (judged.use == ReadingUse::repeated) flags_ |= flag::kRepeated;
  passed_s_ = judged.is_good() ? judged.passed_s : dt_s;
  if (judged.use == ReadingUse::new_touch) {
    // However the hand got there, the force rises from zero.
    drop_force();
    begin_touch();
  } else if (judged.is_good() && ramp_.value() <= 0.0 && !healthy_) {
    begin_touch();
  }
  if (judged.is_good()) take(reading, judged);
  return judged.use;
}

void TickPipeline::take(const device::Reading& reading, const JudgedReading& judged) noexcept {
  position_ = reading.position;
  motion_.update(position_, judged.passed_s);
  const Point<DeviceFrame> before = fine_.place();
  const Point<DeviceFrame> now = fine_.update(position_);
  if (!judged.first) moved_ = now - before;
  if (!judged.first) surface_moved_m_ = judged.passed_s * surface_m_per_s_;
  if (!has_torque_) return;
  if (judged.first) rotation_.begin();
  rotation_.update(reading.rotation, judged.passed_s);
  rotated_ = rotation_.rotated_rad();
}

void TickPipeline::drop_force() noexcept {
  ramp_.reset();
  rise_.drop();
  uncontrolled_rise_.drop();
  dropped_ = held();
  dropped_velocity_m_per_s_ = motion_.velocity_m_per_s();
  written_N_ = {};
  uncontrolled_N_ = {};
  guide_N_ = {};
  written_Nm_ = {};
  uncontrolled_Nm_ = {};
  sent_.fill({});
  transient_.stop();
  motion_.begin();
  surface_m_per_s_ = {};
  shortened_ = true;
  scene_changes_ = false;
}

Hand TickPipeline::hand_in(const Side& side, double dt_s) const noexcept {
  const auto& scene_from_device = side.scene->scene_from_device;
  // Dampers and friction act on what is seen from a surface that moves.
  Hand hand{scene_from_device * position_,
            scene_from_device * (motion_.velocity_m_per_s() - surface_m_per_s_), dt_s};
  hand.acts_after_s = motion_.acts_after_s(dt_s);
  hand.gains_m_per_s = scene_from_device * motion_.gains_m_per_s();
  if (has_torque_) {
    hand.rotation = rotation_in_scene(scene_from_device, rotation_.rotation());
    hand.angular_velocity_rad_per_s = rotate_force(scene_from_device, rotation_.velocity_rad_per_s());
  }
  return hand;
}

bool TickPipeline::evaluate_law(Side& side, double dt_s) noexcept {
  const LawOutput output = side.scene->touchable->evaluate(hand_in(side, dt_s), side.state);
  if (!is_usable(output)) return false;
  side.output = output;
  return true;
}

Vector<DeviceFrame> TickPipeline::device_force_N(const Side& side,
                                                 Vector<SceneFrame> force_N) const noexcept {
  Vector<DeviceFrame> turned = rotate_force(side.device_from_scene, force_N);
  if (planar_) turned.v.z = 0.0;
  return turned;
}

Vector<DeviceFrame> TickPipeline::device_torque_Nm(const Side& side,
                                                   Vector<SceneFrame> torque_Nm) const noexcept {
  // Angles are equal in the scene and at the device, while lengths at the device are 1 / scale as long. So
  // energy, and torque, scale by 1 / scale.
  return (1.0 / side.scene->scene_from_device.scale) * rotate_force(side.device_from_scene, torque_Nm);
}

void TickPipeline::begin_touch() noexcept {
  // The force has been zero for some time and the hand may have moved anywhere: the law's state is obsolete.
  now_.state = {};
  coming_.state = {};
  loads_ = true;
  rise_.reset();
  uncontrolled_rise_.reset();
  begin_returns();
  motion_.begin();
  surface_m_per_s_ = {};
  rotation_.begin();
  flags_ |= flag::kNewTouch;
}

bool TickPipeline::is_free() const noexcept {
  if (moves_) return !between_.contact;
  const auto nothing = [](const LawOutput& output) {
    return !output.contact && output.force_N == Vector<SceneFrame>{} &&
           output.torque_Nm == Vector<SceneFrame>{};
  };
  return nothing(now_.output) && (!fading() || nothing(coming_.output));
}

void TickPipeline::send() noexcept {
  newest_ = (newest_ + 1) % sent_.size();
  sent_[newest_] = {written_N_,
                    uncontrolled_N_,
                    written_Nm_,
                    uncontrolled_Nm_,
                    guide_N_,
                    damper_N(),
                    (flags_ & flag::kPassivityActed) != 0};
}

void TickPipeline::describe(const device::Reading& reading) noexcept {
  const auto& scene_from_device = now_.scene->scene_from_device;
  sample_.tick = counts_.ticks;
  sample_.device_position = reading.position;
  sample_.position = scene_from_device * position_;
  sample_.velocity_m_per_s = scene_from_device * motion_.velocity_m_per_s();
  sample_.proxy = moves_ && between_.contact ? sample_.position + between_.to_surface_m : now_.output.proxy;
  sample_.raw_force_N = now_.output.force_N;
  sample_.written_force_N = rotate_force(scene_from_device, written_N_);
  sample_.energy_J = observer_.balance_J();
  if (has_torque_) {
    sample_.device_rotation = reading.rotation;
    sample_.angular_velocity_rad_per_s = rotate_force(scene_from_device, rotation_.velocity_rad_per_s());
    sample_.raw_torque_Nm = now_.output.torque_Nm;
    sample_.written_torque_Nm = rotate_force(scene_from_device, written_Nm_);
  }
  sample_.label = now_.output.label;
  sample_.buttons = reading.buttons;
  sample_.scene_id = now_.scene->id;
  sample_.coming_scene_id = fading() ? coming_.scene->id : 0;
  sample_.status = reading.status;
  sample_.flags =
      flags_ | (is_in_contact() ? flag::kContact : 0U) | (now_.output.has_proxy ? flag::kHasProxy : 0U);
}

void TickPipeline::report_changes(const TouchSample& before) noexcept {
  using Kind = TouchEvent::Kind;
  const bool contact = sample_.has(flag::kContact);
  const bool was_contact = before.has(flag::kContact);
  if (contact && !was_contact) emit(Kind::contact_made, 0);
  if (!contact && was_contact) emit(Kind::contact_lost, 0);
  if (contact && (!was_contact || sample_.label != before.label)) emit(Kind::label_entered, sample_.label);
  const std::uint32_t changed = sample_.buttons ^ before.buttons;
  for (std::uint32_t rest = changed; rest != 0; rest &= rest - 1) {
    const auto button = static_cast<std::uint32_t>(std::countr_zero(rest));
    emit((sample_.buttons >> button & 1U) != 0 ? Kind::button_down : Kind::button_up, button);
  }
}

void TickPipeline::report_status(bool healthy, std::uint32_t status) noexcept {
  if (healthy != healthy_) emit(healthy ? TouchEvent::Kind::recovered : TouchEvent::Kind::fault, status);
  healthy_ = healthy;
}

void TickPipeline::count_heat(double dt_s) noexcept {
  const bool was_warm = heat_.is_warm();
  heat_.add(dot(written_N_, written_N_), dt_s);
  if (heat_.is_warm() != was_warm)
    emit(was_warm ? TouchEvent::Kind::motors_cool : TouchEvent::Kind::motors_warm, 0);
  counts_.heat = heat_.heat();
}

void TickPipeline::emit(TouchEvent::Kind kind, std::uint32_t value) noexcept {
  events_.put({counts_.ticks, kind, value, sample_.probe});
}

void TickPipeline::count() noexcept {
  const double written = norm(written_N_);
  counts_.max_force_N = std::max(counts_.max_force_N, written);
  counts_.force_capped_ticks += sample_.has(flag::kForceCapped) ? 1 : 0;
  counts_.rise_limited_ticks += sample_.has(flag::kRiseLimited) ? 1 : 0;
  counts_.passivity_ticks += sample_.has(flag::kPassivityActed) ? 1 : 0;
  counts_.contact_ticks += sample_.has(flag::kContact) ? 1 : 0;
  counts_.fault_ticks += healthy_ ? 0 : 1;
  // No account reports less than a recording of this touch shows.
  counts_.made_max_J = std::max(observer_.made_max_J(), shown_.made_max_J());
  counts_.made_max_without_controller_J = std::max(without_controller_.made_max_J(), shown_.made_max_J());
  if (std::isnan(counts_.first_force_t_s) && written >= kFelt_N) counts_.first_force_t_s = sample_.t_s;
  ++counts_.ticks;
}

}  // namespace palpable::haptics
