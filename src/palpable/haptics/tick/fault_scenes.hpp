// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

// What the tests of faults share.

#include "palpable/haptics/law/test_scenes.hpp"
#include "palpable/haptics/tick/servo_types.hpp"
#include "palpable/models/scene/test_grid.hpp"

#include <cstdlib>
#include <memory>
#include <random>
#include <vector>

namespace palpable::haptics {

/// How many instants of each fault and law: `everyday`, or PALPABLE_FAULTS=1000 for a measurement.
inline int instants(int everyday = 60) {
  const char* wanted = std::getenv("PALPABLE_FAULTS");
  return wanted != nullptr ? std::atoi(wanted) : everyday;
}

inline double from(std::mt19937& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}

inline HapticScene on_relief(Law law, const models::Scene& scene, double radius_m, double stiffness_N_per_m) {
  LawParameters p = frictionless(radius_m);
  p.law = law;
  p.stiffness_N_per_m = stiffness_N_per_m;
  p.damping_Ns_per_m = 2.0;
  return {made(scene, p), {}, 0};
}

inline std::vector<HapticScene> grid_scenes() {
  std::vector<HapticScene> scenes;
  for (const int top : {5, 6})
    for (const double stiffness_N_per_m : {500.0, 1500.0}) {
      const auto plate = models::grid_scene({21, 21, 9}, 0.004F, [top](int z) { return z <= top; });
      scenes.push_back(on_relief(Law::grid, plate, 0.0, stiffness_N_per_m));
    }
  return scenes;
}

inline std::vector<HapticScene> groove_scenes() {
  std::vector<HapticScene> scenes;
  for (const float ground_m : {0.005F, 0.0052F})
    for (const double stiffness_N_per_m : {500.0, 1500.0}) {
      models::Scene scene;
      scene.model = std::make_shared<const models::Contours>(models::Contours{
          *models::BoundaryMap::from_edges(Raster<models::BoundaryPixel>(100, 80), kPixel_m, 2.0, {}, Work{}),
          models::relief_of(flat_ground(ground_m))});
      scenes.push_back(on_relief(Law::groove, scene, 0.0, stiffness_N_per_m));
    }
  return scenes;
}

/// The first tick of a force that restarts from zero is at most this: a thousandth of the greatest force of
/// the device, plus a tolerance.
inline constexpr double kBegins_N = 0.2;

}  // namespace palpable::haptics
