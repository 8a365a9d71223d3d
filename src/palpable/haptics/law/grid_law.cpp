// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/haptics/law/grid_law.hpp"

#include "palpable/haptics/law/law_making.hpp"
#include "palpable/haptics/law/law_parameters.hpp"

#include <array>

namespace palpable::haptics {
namespace {

constexpr std::array kParameters{kStiffness, kContactDamping};

MadeLaw make(const LawInput& in) {
  const auto& grid = std::get<std::shared_ptr<const models::Grid>>(in.scene.model);
  const std::shared_ptr<const models::OccupancyGrid> surface(grid, &grid->occupancy);
  const std::uint64_t family = mixed(mixed(static_cast<std::uint64_t>(in.parameters.law),
                                           static_cast<std::uint64_t>(surface->occupied_points())),
                                     content_hash(*grid->from_above));
  return made_law(GridLaw(surface, materials_of(in.scene, *grid->from_above, in.parameters)), family);
}

}  // namespace

constexpr LawDescription kGridLaw{.law = Law::grid,
                                  .name = "grid",
                                  .title = "Grid of cells",
                                  .paper = "Park & Howard 2012, section 5",
                                  .models = {.grid = true},
                                  .parameters = kParameters,
                                  .strength = &LawParameters::stiffness_N_per_m,
                                  .is_contact = true,
                                  .make = make};

}  // namespace palpable::haptics
