// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/haptics/law/contact_law.hpp"
#include "palpable/models/relief/relief.hpp"

#include <cmath>
#include <memory>
#include <utility>

namespace palpable::haptics {

extern const LawDescription kAveragedLaw;

/// Weights of the five points of `averaged`.
struct Averaging {
  double offset_m = 0.001;
  double neighbour_weight = 1.0;
  double centre_weight = 1.0;
};

/// `averaged`: spring and damper along the normal of the weighted mean of five surface points: the one below
/// the hand, and those below four neighbours at an offset. c = (w sum P_i + w_c C_1) / (4 w + w_c) (Gomez
/// 2012, chapter 12, its weights corrected). This is one smoothing step: it reduces vibration in concave
/// places and blunts ridges. Within the offset of walls it pushes in free air, and it meets thin spikes late,
/// up to 4/5 of their height: where all neighbours are higher or lower. It is not conservative. Without
/// neighbours it is the papers' naive law (Park & Howard 2012, eq. 6; Gomez 2012), which in a crease pushes
/// with many times the wall's stiffness.
template <models::HeightField Surface>
class AveragedLaw : public ContactLaw<Surface> {
 public:
  struct State {};

  AveragedLaw(std::shared_ptr<const Surface> surface, MaterialMap materials, Averaging averaging)
      : ContactLaw<Surface>(std::move(surface), std::move(materials)), averaging_(averaging) {}

  LawOutput evaluate(const Hand& hand, State&) const noexcept {
    const Vec3 p = hand.position.v;
    const models::HeightSample s = mean_at(p.x, p.y);
    LawOutput output;
    output.label = this->materials().label_at(p.x, p.y);
    output.contact = p.z < s.z_m;
    if (!output.contact) return output;
    const double length = std::sqrt(1.0 + s.dzdx * s.dzdx + s.dzdy * s.dzdy);
    const Contact& contact = this->materials().contact(output.label);
    output.force_N.v = damped_push(contact.stiffness_N_per_m * ((s.z_m - p.z) / length),
                                   Vec3{-s.dzdx, -s.dzdy, 1.0} / length, hand.velocity_m_per_s.v, contact);
    return output;
  }

  TangentPlane tangent_plane(const Hand& hand, const State&) const noexcept {
    const Vec3 p = hand.position.v;
    const models::HeightSample s = mean_at(p.x, p.y);
    const double length = std::sqrt(1.0 + s.dzdx * s.dzdx + s.dzdy * s.dzdy);
    return plane_above(p, (s.z_m - p.z) / length, Vec3{-s.dzdx, -s.dzdy, 1.0} / length,
                       this->materials().contact(this->materials().label_at(p.x, p.y)));
  }

 private:
  models::HeightSample mean_at(double x_m, double y_m) const noexcept {
    const auto [offset, w, centre] = averaging_;
    models::HeightSample mean;
    const auto add = [&](double x, double y, double weight) {
      const models::HeightSample s = this->surface().sample(x, y);
      mean.z_m += weight * s.z_m;
      mean.dzdx += weight * s.dzdx;
      mean.dzdy += weight * s.dzdy;
    };
    const double share = 1.0 / (4.0 * w + centre);
    add(x_m, y_m, centre * share);
    add(x_m + offset, y_m, w * share);
    add(x_m - offset, y_m, w * share);
    add(x_m, y_m + offset, w * share);
    add(x_m, y_m - offset, w * share);
    return mean;
  }

  Averaging averaging_;
};

}  // namespace palpable::haptics
