// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// What is done before a tick, and what it writes to the device: its force, and the surface for a device that
// computes forces itself.
#include "palpable/haptics/law/rehearsal.hpp"
#include "palpable/haptics/tick/tick.hpp"

namespace palpable::haptics {
namespace {

using device::LocalSurface;

/// The plane across a spring's force, of a law that knows no other; free air without a force.
LocalSurface across_spring(const LawOutput& output, Point<SceneFrame> hand, double damping_Ns_per_m,
                           const Transform<DeviceFrame, SceneFrame>& device_from_scene, double scale) {
  LocalSurface surface;
  surface.kind = LocalSurface::Kind::free;
  const double spring_N = norm(output.spring_N);
  if (!output.contact || !(spring_N > 0.0) || !(output.stored_J > 0.0)) return surface;
  // A spring that stores U at a force f is 2 U / f long, and has the stiffness f² / 2 U.
  const Vector<SceneFrame> outward = (1.0 / spring_N) * output.spring_N;
  surface.kind = LocalSurface::Kind::plane;
  surface.place = device_from_scene * (hand + (2.0 * output.stored_J / spring_N) * outward);
  surface.normal = rotate_force(device_from_scene, outward);
  surface.stiffness_N_per_m = scale * spring_N * spring_N / (2.0 * output.stored_J);
  surface.damping_Ns_per_m = scale * damping_Ns_per_m;
  return surface;
}

}  // namespace

device::LocalSurface TickPipeline::local_surface() const noexcept {
  const Side& side = fading() && faded_ >= 0.5 ? coming_ : now_;
  const auto& scene_from_device = side.scene->scene_from_device;
  const auto& device_from_scene = side.device_from_scene;
  const double scale = scene_from_device.scale;
  const Touchable& touchable = *side.scene->touchable;
  const Hand hand{scene_from_device * position_, {}};
  LocalSurface surface;
  if (side.energy == EnergyModel::spring || touchable.has_tangent_planes()) {
    if (const TangentPlane plane = touchable.tangent_plane(hand, side.state); plane.is_known) {
      surface.kind = LocalSurface::Kind::plane;
      surface.place = device_from_scene * plane.place;
      surface.normal = rotate_force(device_from_scene, plane.normal);
      surface.stiffness_N_per_m = scale * plane.contact.stiffness_N_per_m;
      surface.damping_Ns_per_m = scale * plane.contact.damping_Ns_per_m;
      surface.static_friction = plane.contact.static_friction;
      surface.dynamic_friction = plane.contact.dynamic_friction;
      if (plane.texture >= 0)
        surface.texture = {static_cast<std::uint16_t>(plane.texture + 1), plane.onto,
                           scene_from_device.rotation, scene_from_device.translation_m, scale};
    } else {
      surface =
          across_spring(side.output, hand.position, touchable.damping_Ns_per_m(), device_from_scene, scale);
    }
  } else if (side.energy == EnergyModel::weight) {
    surface.kind = LocalSurface::Kind::slope;
    // Where the force is no gradient of what is stored, it is the law's without its damper.
    const double damping_Ns_per_m = touchable.damping_Ns_per_m();
    const Vector<SceneFrame> damper_N = -damping_Ns_per_m * (scene_from_device * motion_.velocity_m_per_s());
    const bool has_gradient = side.output.spring_N != Vector<SceneFrame>{};
    surface.force_N = device_force_N(
        side, has_gradient ? side.output.spring_N : side.output.force_N - side.output.guide_N - damper_N);
    surface.stored_J = side.output.stored_J / scale;
    surface.damping_Ns_per_m = scale * damping_Ns_per_m;
  } else {
    surface.kind = LocalSurface::Kind::force;
    surface.force_N = device_force_N(side, side.output.force_N - side.output.guide_N);
  }
  surface.hand = position_;
  surface.pull_N = device_force_N(side, side.output.guide_N);
  surface.pull_reserve_J = side.output.guide_reserve_J / scale;
  surface.transient = side.scene->transient;
  return is_valid(surface) ? surface : LocalSurface{};
}

void TickPipeline::rehearse(double dt_s) noexcept {
  if (counts_.ticks == 0) return;
  haptics::rehearse(*now_.scene->touchable, hand_in(now_, dt_s), now_.state);
  if (fading()) haptics::rehearse(*coming_.scene->touchable, hand_in(coming_, dt_s), coming_.state);
}

void TickPipeline::write_device(bool wanted, bool is_held) noexcept {
  if (takes_surface_ != nullptr) {
    // A reading that is not used changes nothing.
    if (!is_held) surface_ = wanted && !is_paused() ? local_surface() : LocalSurface{};
    takes_surface_->write_surface(surface_);
  }
  device_.note_ramp(ramp_.value());
  if (has_torque_) device_.write_torque(written_Nm_);
  // A force that was cut since the reading stays so; the next tick begins from zero.
  const bool is_cut = cut_ != nullptr && cut_->load(std::memory_order_relaxed);
  device_.write(is_cut ? Vector<DeviceFrame>{} : written_N_);
}

}  // namespace palpable::haptics
