// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/haptics/law/material_map.hpp"
#include "palpable/haptics/law/penalty.hpp"
#include "palpable/haptics/law/touchable.hpp"
#include "palpable/models/grid/occupancy_grid.hpp"

#include <memory>
#include <utility>

namespace palpable::haptics {

/// `grid`: f = max(0, K d - B v·n) n with depth d and normal n from an occupancy grid (Park & Howard 2012,
/// eq. 6, corrected). The proxy is the place on the surface straight along the normal. Depth and normal are
/// continuous, but the normal is not the depth's gradient: it makes energy, and has no potential to watch.
class GridLaw {
 public:
  struct State {};

  GridLaw(std::shared_ptr<const models::OccupancyGrid> grid, MaterialMap materials)
      : grid_(std::move(grid)), materials_(std::move(materials)) {}

  Feel feel(const Hand& hand, State&) const noexcept {
    const models::GridSample s = grid_->sample(hand.position.v);
    Feel feel;
    feel.label = materials_.label_at(hand.position.v.x, hand.position.v.y);
    feel.contact = s.depth_m > 0.0;
    if (!feel.contact) return feel;
    feel.force_N.v = pressed(s.depth_m, s.normal, hand.velocity_m_per_s.v, materials_.contact(feel.label));
    feel.has_proxy = true;
    feel.proxy.v = hand.position.v + s.depth_m * s.normal;
    return feel;
  }

  const models::OccupancyGrid& surface() const noexcept { return *grid_; }
  double damping_Ns_per_m() const noexcept { return materials_.contact(0).damping_Ns_per_m; }
  std::size_t memory_bytes() const noexcept { return grid_->memory_bytes() + materials_.memory_bytes(); }

 private:
  std::shared_ptr<const models::OccupancyGrid> grid_;
  MaterialMap materials_;
};

}  // namespace palpable::haptics
