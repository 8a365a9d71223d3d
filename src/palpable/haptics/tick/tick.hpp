// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/system/hand_off.hpp"
#include "palpable/device/device.hpp"
#include "palpable/device/local_surface.hpp"
#include "palpable/haptics/safety/heat_budget.hpp"
#include "palpable/haptics/safety/limits.hpp"
#include "palpable/haptics/safety/passivity.hpp"
#include "palpable/haptics/safety/return_limit.hpp"
#include "palpable/haptics/safety/rise_limit.hpp"
#include "palpable/haptics/tick/hand_motion.hpp"
#include "palpable/haptics/tick/reading_filter.hpp"
#include "palpable/haptics/tick/rotation.hpp"
#include "palpable/haptics/tick/servo_types.hpp"
#include "palpable/haptics/tick/shown_work.hpp"
#include "palpable/haptics/tick/surface_between.hpp"
#include "palpable/haptics/tick/tick_options.hpp"
#include "palpable/haptics/tick/tick_time.hpp"
#include "palpable/haptics/tick/transient_player.hpp"
#include "palpable/haptics/tick/velocity.hpp"

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>

namespace palpable::haptics {

/// One tick of touch, without thread or clock. Its steps: read the device; reject readings that are not
/// finite or plausible; evaluate the law; reject a force that is not finite; observe the energy of the force
/// that was held until now; cap the force; ramp it; limit its rise; apply the passivity controller; bound
/// what came out, whatever it is; write. The servo loop calls it in real time, tests as fast as possible; the
/// same readings give the same results. One thread; step() never allocates, locks, throws or prints.
class TickPipeline {
 public:
  /// `device` and `events` must outlive this object; `scene` (with its touchable) must live until
  /// take_retired() returns it. Samples and events carry the number of the probe.
  TickPipeline(device::Device& device, const HapticScene& scene, const TickOptions& options,
               Ring<TouchEvent>& events, std::uint8_t probe = 0);

  /// `t_s` is the time since the first step, `dt_s` that since the previous one (usable_time()). Readings of
  /// a recording bring their own times.
  const TouchSample& step(double t_s, double dt_s) noexcept;

  /// Computes the law's part of the step() that is to be expected next and discards the result: for the time
  /// in which a loop waits, after which step() is faster (rehearsal.hpp). Changes no result. Tick path.
  void rehearse(double dt_s) noexcept;

  bool fading() const noexcept { return coming_.scene != nullptr; }
  /// Starts a cross-fade to `scene`; only while not fading(). It takes fade_s and a tick, whatever the
  /// device's status is; longer where a spring comes up under the hand: 1 s for each 30 mm, at most 1 s. A
  /// surface that moves (Succession) comes at the hand in fade_s, and under it as slowly.
  void change(const HapticScene& scene) noexcept;
  /// The scene that the last step() stopped using, returned once; else null.
  const HapticScene* take_retired() noexcept;
  void set_paused(bool paused) noexcept { paused_ = paused; }
  /// Another thread has written zero force: the force of the next step() rises from zero.
  void note_cut_force() noexcept { force_was_cut_ = true; }
  /// The same, told by a flag that is looked at after each reading, which may hang; it must outlive this
  /// object.
  void watch_cuts(std::atomic<bool>& cut) noexcept { cut_ = &cut; }

  const TickCounts& counts() const noexcept { return counts_; }

 private:
  /// The state of a touch in one scene; there are two during a cross-fade.
  struct Side {
    void begin(const HapticScene& next) noexcept {
      *this = {};
      scene = &next;
      device_from_scene = next.scene_from_device.inverse();
      energy = next.touchable->energy_model();
    }
    const HapticScene* scene = nullptr;
    Transform<DeviceFrame, SceneFrame> device_from_scene;
    EnergyModel energy = EnergyModel::none;
    TouchState state;
    LawOutput output;
  };
  TickTime when_of(const device::Reading& reading, double t_s, double dt_s) noexcept;
  ReadingUse accept(const device::Reading& reading, double dt_s) noexcept;
  void take(const device::Reading& reading, const JudgedReading& judged) noexcept;
  void drop_force() noexcept;
  /// The hand in a side's scene.
  Hand hand_in(const Side& side, double dt_s) const noexcept;
  bool evaluate_law(Side& side, double dt_s) noexcept;
  Vector<DeviceFrame> device_force_N(const Side& side, Vector<SceneFrame> force_N) const noexcept;
  Vector<DeviceFrame> device_torque_Nm(const Side& side, Vector<SceneFrame> torque_Nm) const noexcept;
  /// What is stored, in the device's frame, and the spring's part of the force, after the cap.
  struct Potential {
    Vector<DeviceFrame> spring_N;
    double stored_J = 0.0;
    /// The spring's force before the cap.
    Vector<DeviceFrame> uncapped_N;
  };
  bool has_spring() const noexcept;
  /// Its energy is counted, and brought up and down by the rise limit.
  bool is_accounted() const noexcept;
  /// `faded`: the part of the scene that fades in.
  Potential potential(double faded) const noexcept;
  /// What of it the hand gave, or a ramp that loaded it brought.
  double given_J(const RiseLimit& rise) const noexcept;
  /// What a change of parameters on the same surface added to it in this tick.
  double changed_J(const RiseLimit& rise) const noexcept;
  Vector<DeviceFrame> damper_N() const noexcept;
  /// How far a surface that moves between two pictures came in this tick.
  Vector<DeviceFrame> way_of_surface() const noexcept;
  /// By how much the ramp rises in a tick in which it loads a spring: it lifts the hand slowly.
  double loading_s(const Potential& p, double dt_s) const noexcept;
  void account_spring(double dt_s, bool wanted) noexcept;
  void account_stall(RiseLimit::Input in, double dt_s) noexcept;
  void make_torque(double risen_s) noexcept;
  void begin_returns() noexcept;
  void account_returns() noexcept;
  struct Sent;
  struct Forces {
    Vector<DeviceFrame> force_N;
    Vector<DeviceFrame> torque_Nm;
  };
  /// A share 0 ... 1 to which an account of energy reduces the forces, raised so that their step
  /// is no longer than the rise limit allows, or than the law's own, or takes no more than the rise limit
  /// from what the law wants.
  double without_step(double share, const Forces& wanted, const Forces& before, double dt_s) const noexcept;
  /// The forces that a touch sent without a guide's pull, and as they would be without the controller.
  static Forces as_written(const Sent& sent) noexcept;
  static Forces as_uncontrolled(const Sent& sent) noexcept;
  /// How far the work of a force on the hand is not known within the sensor's step, J.
  double unsure_J(Vector<DeviceFrame> force_N) const noexcept;
  /// What the forces that were sent but do not act yet will give the hand, J; >= 0.
  double on_the_way_J(Forces (*sent_as)(const Sent&), double dt_s) const noexcept;
  double returned_share(const ReturnLimit& limit, const Forces& wanted, Forces (*sent_as)(const Sent&),
                        double dt_s) const noexcept;
  /// Reduces the forces of this tick to what the contact may return.
  void limit_returns(double dt_s) noexcept;
  /// The hand's velocity, and its expected change until a force acts, for what forces give it: where the
  /// reading flickers, those of the place within its steps.
  Vector<DeviceFrame> velocity_m_per_s() const noexcept;
  Vector<DeviceFrame> gains_m_per_s() const noexcept;
  /// The velocity as far as the sensor's step lets it be known.
  Vector<DeviceFrame> sure_velocity_m_per_s(double dt_s) const noexcept;
  void control_energy(double dt_s) noexcept;
  void bound(double dt_s) noexcept;
  void send() noexcept;
  /// What is touched near the hand, in the device's frame.
  device::LocalSurface local_surface() const noexcept;
  void write_device(bool wanted, bool is_held) noexcept;
  bool evaluate_laws(double dt_s) noexcept;
  void blend_laws() noexcept;
  void fade(double dt_s) noexcept;
  /// The part of a fade that is done after this tick, of a surface that moves.
  double moved_by(double dt_s) const noexcept;
  SurfaceAtHand surface_of(const Side& side) const noexcept;
  void meet_moving_surface(double dt_s) noexcept;
  void take_force_between() noexcept;
  /// What the law or, between two pictures, the moving surface is to the hand.
  bool is_in_contact() const noexcept { return moves_ ? between_.contact : now_.output.contact; }
  /// Fading to a scene that feels otherwise here. An equal surface, as a live source sends it, changes
  /// nothing.
  bool is_changing() const noexcept;
  void end_fade() noexcept;
  /// Work on the hand since the previous tick, of the written forces and of those without the controller.
  struct Received {
    double written_J = 0.0;
    double uncontrolled_J = 0.0;
  };
  void count_received() noexcept;
  void count_scene_change() noexcept;
  void observe() noexcept;
  bool is_free() const noexcept;
  Vector<DeviceFrame> with_transient(Vector<DeviceFrame> force_N, double dt_s) noexcept;
  void make_force(double dt_s) noexcept;
  void begin_touch() noexcept;
  void describe(const device::Reading& reading) noexcept;
  void count_shown_work() noexcept;
  void count_heat(double dt_s) noexcept;
  void report_changes(const TouchSample& before) noexcept;
  void report_status(bool healthy, std::uint32_t status) noexcept;
  void emit(TouchEvent::Kind kind, std::uint32_t value) noexcept;
  void count() noexcept;

  device::Device& device_;
  /// The device, if it computes forces itself; else null.
  device::TakesLocalSurface* takes_surface_;
  device::LocalSurface surface_;
  Ring<TouchEvent>& events_;
  TickOptions options_;
  double max_force_N_;
  /// What of it may be written now.
  HeatBudget heat_;
  bool planar_;

  Side now_;
  /// Its scene is null if no scene fades in.
  Side coming_;
  double faded_ = 0.0;
  double faded_before_ = 0.0;
  /// The scene that fades in is the same law on the same surface: springs and energies continue.
  bool same_surface_ = false;
  /// It is the same surface, seen later: energies continue.
  bool goes_on_ = false;
  /// The same, with contact springs; as seen from the hand, and between both.
  bool moves_ = false;
  SurfaceAtHand from_;
  SurfaceAtHand to_;
  SurfaceBetween between_;
  /// Of the surface under the hand, eased; and by how much it moved since the previous reading.
  Vector<DeviceFrame> surface_m_per_s_;
  Vector<DeviceFrame> surface_moved_m_;
  const HapticScene* retired_ = nullptr;

  ReadingFilter readings_;
  HandMotion motion_;
  FinePosition fine_;
  Point<DeviceFrame> position_;
  /// Since the previous reading that was used, m and s.
  Vector<DeviceFrame> moved_;
  double passed_s_ = 0.001;
  bool has_torque_;
  bool torque_capped_ = false;
  TransientPlayer transient_;
  /// The law was in contact in the previous tick.
  bool was_in_contact_ = false;
  RotationEstimator rotation_;
  /// Since the previous tick, rad.
  Vector<DeviceFrame> rotated_;

  Ramp ramp_;
  /// The ramp loads the spring (RiseLimit::Input::loads) when it rises.
  bool loads_ = true;
  /// For the written force, and for the force as it would be without the controller.
  RiseLimit rise_;
  RiseLimit uncontrolled_rise_;
  /// The same pair.
  ReturnLimit returns_;
  ReturnLimit uncontrolled_returns_;
  /// The contact is over once the force that acts now has acted.
  bool returns_end_ = false;
  /// What the springs held before the current change of scene; the work on the hand during it; and the most
  /// energy that it has brought so far. On the same surface: the sum of what it changed.
  double stored_before_change_J_ = 0.0;
  double change_work_J_ = 0.0;
  double change_brought_J_ = 0.0;
  /// What the current change of scene added to the stored energy in this tick.
  double changed_J_ = 0.0;
  /// What the dampers and the friction of a surface that moves brought in it.
  double damped_J_ = 0.0;
  /// What the law stores, as of the last account.
  double stored_J_ = 0.0;
  /// And its spring's force.
  Vector<DeviceFrame> spring_N_;
  /// The law's force (the last finite one), the force after caps and ramp, and the written force.
  Vector<DeviceFrame> law_force_N_;
  Vector<DeviceFrame> guide_N_;
  Vector<DeviceFrame> uncontrolled_N_;
  Vector<DeviceFrame> written_N_;
  Vector<DeviceFrame> law_torque_Nm_;
  Vector<DeviceFrame> uncontrolled_Nm_;
  Vector<DeviceFrame> written_Nm_;
  /// The last forces, for a device whose motors receive them some ticks late; the newest is at newest_.
  struct Sent {
    Vector<DeviceFrame> written_N;
    Vector<DeviceFrame> uncontrolled_N;
    Vector<DeviceFrame> written_Nm;
    Vector<DeviceFrame> uncontrolled_Nm;
    /// The part of the law's force that pulls along a way.
    Vector<DeviceFrame> guide_N;
    /// What of the force a moving surface's damper and friction are.
    Vector<DeviceFrame> damper_N;
    /// The controller reduced it.
    bool weakened = false;
  };
  static constexpr int kMaxDelay = static_cast<int>(PassivityObserver::kMostDelay);
  std::array<Sent, kMaxDelay + 1> sent_{};
  std::size_t newest_ = 0;
  /// What the motors held when the force was dropped.
  Sent dropped_;
  Vector<DeviceFrame> dropped_velocity_m_per_s_;
  Received received_;
  std::size_t delay_;
  /// The forces that the motors held since the last reading: written one tick ago, plus the device's delay.
  const Sent& held() const noexcept { return sent_[(newest_ + sent_.size() - delay_) % sent_.size()]; }
  /// The held force was shortened by a fade or a torque cap, or by the ramp of a law without a spring.
  bool shortened_ = true;
  bool scene_changes_ = false;
  bool paused_ = false;
  /// The newest reading's.
  bool clutched_ = false;
  bool is_paused() const noexcept { return paused_ || clutched_; }
  bool force_was_cut_ = false;
  std::atomic<bool>* cut_ = nullptr;
  bool healthy_ = true;
  std::uint32_t flags_ = 0;
  PassivityObserver observer_;
  PassivityObserver without_controller_;
  ShownWork shown_;
  TouchSample sample_;
  TickCounts counts_;
};

}  // namespace palpable::haptics
