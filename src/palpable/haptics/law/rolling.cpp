// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/haptics/law/rolling.hpp"

#include "palpable/haptics/law/law_making.hpp"
#include "palpable/haptics/law/law_parameters.hpp"
#include "palpable/models/relief/relief_shaping.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <variant>

namespace palpable::haptics {
namespace {

constexpr LawParameter kSmoothing{&LawParameters::rolling_smoothing_m,
                                  "rolling_smoothing_m",
                                  "Smoothing of the relief",
                                  "m",
                                  "rolling-smoothing",
                                  0.0,
                                  kMostRollingSmoothing_m,
                                  0.0,
                                  kMostRollingSmoothing_m,
                                  0.0};
constexpr std::array kParameters{kSlopeForce, kPlaneDamping, kSmoothing};

/// How far a smoothing of radius 1 reaches: three means.
constexpr int kRoomOfRadius = 3;

/// The steepest slope of a solid: that of reliefs unless another is chosen.
constexpr double kSteepestOfSolid = 3.0;

/// With level ground around it: a relief's border continues outwards for ever.
Raster<float> on_ground(const Raster<float>& heights, float ground_m, int around_px) {
  Raster<float> wider(heights.width() + 2 * around_px, heights.height() + 2 * around_px, ground_m);
  for (int y = 0; y < heights.height(); ++y)
    for (int x = 0; x < heights.width(); ++x) wider(x + around_px, y + around_px) = heights(x, y);
  return wider;
}

int radius_px(double smoothing_m, double pixel_m) {
  // smooth_heights() with the radius r is a Gaussian of sqrt(r (r + 1)) pixels.
  const double pixels = smoothing_m / pixel_m;
  return static_cast<int>(std::lround(std::sqrt(0.25 + pixels * pixels) - 0.5));
}

/// A solid seen from above has upright sides, whose slope has no limit.
bool is_solid(const models::Scene& scene) {
  return models::is_field(scene.model) ||
         std::holds_alternative<std::shared_ptr<const models::Grid>>(scene.model);
}

/// The heights that the ball rolls on. The upright sides of a solid become ramps within its outline, so that
/// there is no force beside it. Reliefs and grooves were made with limited slopes. `room_px`: level ground
/// that a smoothing of a solid needs around it.
Raster<float> rolled_heights(const models::Scene& scene, int room_px) {
  // As far as a sample changes the spline.
  constexpr int kAround = 3;
  const models::Relief& relief = *models::relief_of(scene);
  if (!is_solid(scene)) return relief.samples_m();
  Raster<float> heights =
      models::is_field(scene.model)
          ? on_ground(relief.samples_m(), static_cast<float>(relief.lowest_m()), kAround + room_px)
          : relief.samples_m();
  models::cut_to_slope(heights, relief.pixel_m(), kSteepestOfSolid);
  return heights;
}

Result<std::shared_ptr<const models::Relief>> rolled_surface(const models::Scene& scene, double smoothing_m) {
  const auto& relief = models::relief_of(scene);
  const int radius = radius_px(smoothing_m, relief->pixel_m());
  if (!is_solid(scene) && radius == 0) return relief;
  Raster<float> heights = rolled_heights(scene, kRoomOfRadius * radius);
  models::smooth_heights(heights, radius);
  auto rolled = models::Relief::from_samples(std::move(heights), relief->pixel_m());
  if (!rolled) return rolled.error();
  return std::make_shared<const models::Relief>(*std::move(rolled));
}

MadeLaw make(const LawInput& in) {
  const LawParameters& p = in.parameters;
  const auto rolled = rolled_surface(in.scene, value_or_preset(p, kSmoothing));
  if (!rolled) return {rolled.error()};
  const std::shared_ptr<const models::Relief>& relief = *rolled;
  return made_law(
      RollingLaw<models::Relief>(relief, value_or_preset(p, kSlopeForce), value_or_preset(p, kPlaneDamping)),
      mixed(static_cast<std::uint64_t>(p.law), content_hash(*relief)));
}

}  // namespace

constexpr LawDescription kRollingLaw{.law = Law::rolling,
                                     .name = "rolling",
                                     .title = "Rolling ball",
                                     .paper = "Shi & Pai 1997, eq. 1",
                                     .models = {true, true, true, true},
                                     .parameters = kParameters,
                                     .strength = &LawParameters::slope_force_N,
                                     .degrees_of_freedom = 2,
                                     .conservative = true,
                                     .make = make};

RollingFit fit_rolling(const models::Scene& scene, const RollingFit& wanted, const RollingBounds& bounds) {
  const double pixel_m = models::relief_of(scene)->pixel_m();
  const int most = radius_px(kMostRollingSmoothing_m, pixel_m);
  const Raster<float> heights = rolled_heights(scene, kRoomOfRadius * most);
  // The greatest force per newton of slope force, and the greatest stiffness, each as a share of its bound.
  const auto load = [&](int radius) {
    Raster<float> smooth = heights;
    models::smooth_heights(smooth, radius);
    const double bend_per_m = models::greatest_bend_per_m(smooth, pixel_m);
    const auto surface = models::Relief::from_samples(std::move(smooth), pixel_m);
    const double slope = surface ? surface->steepest_slope() : 0.0;
    return wanted.slope_force_N *
           std::max(bend_per_m / bounds.max_stiffness_N_per_m, slope / bounds.max_force_N);
  };
  int enough = radius_px(wanted.smoothing_m, pixel_m);
  if (load(enough) <= 1.0) return wanted;
  int too_little = enough;
  const double least = load(most);
  for (enough = std::max(enough, most); least <= 1.0 && enough - too_little > 1;) {
    const int between = (too_little + enough) / 2;
    (load(between) <= 1.0 ? enough : too_little) = between;
  }
  const double smoothing_m = std::min(kMostRollingSmoothing_m, pixel_m * std::sqrt(enough * (enough + 1.0)));
  return {wanted.slope_force_N / std::max(1.0, least), std::max(wanted.smoothing_m, smoothing_m)};
}

}  // namespace palpable::haptics
