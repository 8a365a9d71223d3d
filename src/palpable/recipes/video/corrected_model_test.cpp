// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/recipes/video/corrected_model.hpp"

#include "palpable/recipes/video/seen_house.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace palpable::recipes {
namespace {

// The mean distance of a surface's upper vertices, off the ground, from the house.
double mean_distance(const Mesh& surface) {
  double sum = 0;
  int count = 0;
  for (const Vec3& v : surface.vertices_m)
    if (v.z > 0.03) sum += std::abs(outside_house(v)), ++count;
  return count > 0 ? sum / count : 1.0;
}

TEST(CorrectedModel, EveryStepLowersTheErrorOrLeavesItAndTheLastSurfaceIsTheHouse) {
  auto maps = maps_of_house(4, 0.001);
  VideoModelOptions model_options;
  model_options.structure_step_px = 2;
  const VideoModel model = video_model(maps, model_options, 1);
  crop(maps, model);
  std::vector<double> distances;
  const auto observe = [&](const ModelStep& step, const Mesh& surface) {
    if (step.taken) distances.push_back(mean_distance(surface));
  };
  CorrectedModelOptions options;
  options.measured.step_px = 2;
  options.most_samples = 80;
  options.passes = 2;
  ModelShapesOptions shapes;
  shapes.shapes.used_points = 1200;
  const auto made =
      corrected_model(model, maps, Raster<Rgb8>(160, 120, Rgb8{90, 90, 90}), shapes, options, observe, {});
  ASSERT_TRUE(made) << made.error().sentence();
  EXPECT_TRUE(is_watertight(made->surface));
  EXPECT_EQ(made->shapes.objects, 1U);
  double error = std::numeric_limits<double>::infinity();
  int corrections = 0;
  for (const ModelStep& step : made->steps) {
    EXPECT_EQ(step.taken, step.kind == ModelStep::Kind::sampling || step.error <= error);
    if (step.taken) error = step.error;
    corrections += step.kind == ModelStep::Kind::correction ? 1 : 0;
  }
  // Whole passes over the four maps.
  EXPECT_GE(corrections, 4);
  EXPECT_EQ(corrections % 4, 0);
  EXPECT_EQ(made->corrected_error, error);
  EXPECT_LT(made->corrected_error, 0.8 * made->predicted_error);
  // Not only the points that the error was measured at: the whole surface, also where nothing was seen.
  EXPECT_LT(distances.back(), 0.012);
}

}  // namespace
}  // namespace palpable::recipes
