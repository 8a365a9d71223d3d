// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/haptics/law/contact_law.hpp"
#include "palpable/models/grid/occupancy_grid.hpp"

#include <memory>
#include <utility>

namespace palpable::haptics {

extern const LawDescription kGridLaw;

/// `grid`: f = max(0, K d - B v·n) n with depth d and normal n from an occupancy grid (Park & Howard 2012,
/// eq. 6, corrected). The proxy is the surface point along the normal. Depth and normal are continuous, but
/// the normal is not the gradient of the depth. So the law generates energy and has no potential that could
/// be observed.
class GridLaw : public ContactLaw<models::OccupancyGrid> {
 public:
  struct State {};

  using ContactLaw::ContactLaw;

  LawOutput evaluate(const Hand& hand, State&) const noexcept {
    const models::GridSample s = surface().sample(hand.position);
    LawOutput output;
    output.label = materials().label_at(hand.position.v.x, hand.position.v.y);
    output.contact = s.depth_m > 0.0;
    if (!output.contact) return output;
    const Contact& contact = materials().contact(output.label);
    output.force_N.v =
        damped_push(contact.stiffness_N_per_m * s.depth_m, s.normal.v, hand.velocity_m_per_s.v, contact);
    output.has_proxy = true;
    output.proxy = hand.position + s.depth_m * s.normal;
    return output;
  }

  /// In free air, where the grid knows its surface within half a spacing only, that straight below the hand.
  TangentPlane tangent_plane(const Hand& hand, const State&) const noexcept {
    constexpr int kSteps = 40;
    const double step_m = 0.5 * surface().spacing_m();
    Point<SceneFrame> at = hand.position;
    for (int k = 0; k < kSteps; ++k, at.v.z -= step_m) {
      const models::GridSample s = surface().sample(at);
      const double length = norm(s.normal);
      if (length > 0.0)
        return plane_above(at.v, s.depth_m, s.normal.v / length,
                           materials().contact(materials().label_at(at.v.x, at.v.y)));
    }
    return {};
  }
};

}  // namespace palpable::haptics
