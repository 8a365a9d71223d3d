// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/haptics/effect/material_map.hpp"
#include "palpable/haptics/law/law.hpp"
#include "palpable/haptics/law/touchable.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>

namespace palpable::haptics {

/// Base of every law that is a spring against a surface with materials. Immutable.
template <class SurfaceType>
class ContactLaw {
 public:
  using Surface = SurfaceType;
  ContactLaw(std::shared_ptr<const Surface> surface, MaterialMap materials)
      : surface_(std::move(surface)), materials_(std::move(materials)) {}

  const Surface& surface() const noexcept { return *surface_; }
  const MaterialMap& materials() const noexcept { return materials_; }
  EnergyModel energy_model() const noexcept { return EnergyModel::none; }
  double damping_Ns_per_m() const noexcept { return materials_.contact(0).damping_Ns_per_m; }
  std::size_t memory_bytes() const noexcept { return surface_->memory_bytes() + materials_.memory_bytes(); }

 private:
  std::shared_ptr<const Surface> surface_;
  MaterialMap materials_;
};

/// The output of a law with a proxy, before its force. Every member by name: to clear the whole first takes
/// as long as a surface evaluation.
inline LawOutput output_with(Vec3 proxy_m, bool in_contact, std::uint16_t label) noexcept {
  return {.force_N = {},
          .proxy = {proxy_m},
          .stored_J = 0.0,
          .spring_N = {},
          .torque_Nm = {},
          .spring_torque_Nm = {},
          .guide_N = {},
          .guide_reserve_J = 0.0,
          .contact = in_contact,
          .has_proxy = true,
          .label = label};
}

/// The force of a spring of magnitude `spring_N` along `outward` (unit vector) with a damper; never a pull
/// (Park & Howard 2012, eq. 6, corrected).
inline Vec3 damped_push(double spring_N, Vec3 outward, Vec3 velocity_m_per_s,
                        const Contact& contact) noexcept {
  return std::max(0.0, spring_N - contact.damping_Ns_per_m * dot(velocity_m_per_s, outward)) * outward;
}

/// The plane of such a law, `depth_m` above the hand along `outward` (unit vector); below it if that is less
/// than 0.
inline TangentPlane plane_above(Vec3 hand_m, double depth_m, Vec3 outward, const Contact& contact) noexcept {
  TangentPlane plane;
  plane.is_known = true;
  plane.place.v = hand_m + depth_m * outward;
  plane.normal.v = outward;
  plane.contact = {contact.stiffness_N_per_m, contact.damping_Ns_per_m, 0.0, 0.0};
  return plane;
}

}  // namespace palpable::haptics
