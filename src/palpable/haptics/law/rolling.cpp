// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/haptics/law/rolling.hpp"

#include "palpable/haptics/law/law_making.hpp"
#include "palpable/haptics/law/law_parameters.hpp"
#include "palpable/models/relief/relief_shaping.hpp"

#include <array>
#include <variant>

namespace palpable::haptics {
namespace {

constexpr std::array kParameters{kSlopeForce, kPlaneDamping};

/// The steepest slope of a solid: that of reliefs unless another is chosen.
constexpr double kSteepestOfSolid = 3.0;

/// With level ground around it: a relief's border continues outwards for ever.
Raster<float> on_ground(const Raster<float>& heights, float ground_m) {
  // As far as a sample changes the spline.
  constexpr int kAround = 3;
  Raster<float> wider(heights.width() + 2 * kAround, heights.height() + 2 * kAround, ground_m);
  for (int y = 0; y < heights.height(); ++y)
    for (int x = 0; x < heights.width(); ++x) wider(x + kAround, y + kAround) = heights(x, y);
  return wider;
}

/// The surface that the ball rolls on. A solid seen from above has upright sides, whose slope has no limit:
/// they become ramps within its outline, so that there is no force beside the solid. Reliefs and grooves were
/// made with limited slopes.
Result<std::shared_ptr<const models::Relief>> rolled_surface(const models::Scene& scene) {
  const auto& relief = models::relief_of(scene);
  const bool is_field = models::is_field(scene.model);
  if (!is_field && !std::holds_alternative<std::shared_ptr<const models::Grid>>(scene.model)) return relief;
  Raster<float> heights =
      is_field ? on_ground(relief->samples_m(), static_cast<float>(relief->lowest_m())) : relief->samples_m();
  models::cut_to_slope(heights, relief->pixel_m(), kSteepestOfSolid);
  auto cut = models::Relief::from_samples(std::move(heights), relief->pixel_m());
  if (!cut) return cut.error();
  return std::make_shared<const models::Relief>(*std::move(cut));
}

MadeLaw make(const LawInput& in) {
  const auto rolled = rolled_surface(in.scene);
  if (!rolled) return {rolled.error()};
  const std::shared_ptr<const models::Relief>& relief = *rolled;
  const LawParameters& p = in.parameters;
  return made_law(
      RollingLaw<models::Relief>(relief, value_or_preset(p, kSlopeForce), value_or_preset(p, kPlaneDamping)),
      mixed(static_cast<std::uint64_t>(p.law), content_hash(*relief)));
}

}  // namespace

constexpr LawDescription kRollingLaw{.law = Law::rolling,
                                     .name = "rolling",
                                     .title = "Rolling ball",
                                     .models = {true, true, true, true},
                                     .parameters = kParameters,
                                     .strength = &LawParameters::slope_force_N,
                                     .degrees_of_freedom = 2,
                                     .conservative = true,
                                     .make = make};

}  // namespace palpable::haptics
