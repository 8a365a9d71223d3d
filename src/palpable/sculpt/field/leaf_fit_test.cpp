// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sculpt/field/leaf_fit.hpp"

#include "palpable/models/field/distance_field.hpp"
#include "palpable/models/field/field_leaf.hpp"
#include "palpable/sculpt/field/leaf_quadratic.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

namespace palpable::sculpt {
namespace {

using models::DistanceSample;

const DistanceSample& nearer(const DistanceSample& a, const DistanceSample& b) {
  return a.distance_m < b.distance_m ? a : b;
}
const DistanceSample& farther(const DistanceSample& a, const DistanceSample& b) {
  return a.distance_m < b.distance_m ? b : a;
}

/// The edge of two walls beside a corner of three: five faces in one cell.
CellSamples where_five_faces_meet(std::mt19937_64& random, double cell_m) {
  std::normal_distribution<double> normal;
  std::array<DistanceSample, 5> faces;
  for (DistanceSample& face : faces) {
    const double x = normal(random), y = normal(random), z = normal(random);
    face = {0.15 * cell_m * normal(random), unit(Vec3{x, y, z})};
  }
  CellSamples samples;
  samples.half_m = 0.5 * cell_m;
  samples.centre_m = {10.5 * cell_m, 20.5 * cell_m, 30.5 * cell_m};
  for (std::size_t k = 0; k < kFitPlaces; ++k) {
    std::array<DistanceSample, 5> at = faces;
    for (DistanceSample& f : at) f.distance_m += samples.half_m * dot(f.gradient, fit_place(k));
    samples.at[k] = nearer(farther(at[0], at[1]), farther(at[2], nearer(at[3], at[4])));
  }
  return samples;
}

TEST(LeafFit, StaysNearTheTruthWhereManyFacesMeetInAFinestCell) {
  std::mt19937_64 random(3);
  FitBounds bounds;
  bounds.cell_m = 2e-4;
  double sum_m = 0.0, most_m = 0.0;
  constexpr int kCells = 300;
  for (int i = 0; i < kCells; ++i) {
    const CellSamples samples = where_five_faces_meet(random, bounds.cell_m);
    const LeafFit leaf = fit_leaf(samples, bounds, {});
    double error_m = 0.0;
    for (std::size_t k = 0; k < kFitPlaces; ++k) {
      const Vec3 u = fit_place(k);
      const DistanceSample felt =
          models::leaf_at(leaf.words.data(), samples.centre_m + samples.half_m * u, u, samples.half_m,
                          models::DistanceField::kRounding * bounds.cell_m);
      error_m = std::max(error_m, std::abs(felt.distance_m - samples.at[k].distance_m));
    }
    sum_m += error_m / kCells;
    most_m = std::max(most_m, error_m);
  }
  EXPECT_LT(sum_m, 0.25 * bounds.cell_m);
  EXPECT_LT(most_m, 0.5 * bounds.cell_m);
}

/// One of two pieces may hold the samples of one face of a cell only, which do not tell how it bends away
/// from that face.
TEST(LeafFit, AQuadraticThroughOneFaceStaysStraightAwayFromIt) {
  std::mt19937_64 random(5);
  std::normal_distribution<double> normal;
  std::array<bool, kFitPlaces> on_face{};
  for (std::size_t k = 18; k < kFitPlaces; ++k) on_face[k] = true;
  double most = 0.0;
  for (int i = 0; i < 300; ++i) {
    const double x = normal(random), y = normal(random), z = normal(random);
    const Vec3 face = unit(Vec3{x, y, z});
    CellSamples samples;
    samples.half_m = 1e-4;
    for (std::size_t k = 0; k < kFitPlaces; ++k) {
      // Facets differ a little from a plane, in height and direction.
      samples.at[k].distance_m = samples.half_m * (dot(face, fit_place(k)) + 0.01 * normal(random));
      samples.at[k].gradient = unit(face + 0.02 * Vec3{normal(random), normal(random), normal(random)});
    }
    const Quadratic c = quadratic_through(samples, on_face);
    // Opposite the face, in its middle.
    const double there = c[0] - c[3] + c[6];
    most = std::max(most, std::abs(there + face.z));
  }
  EXPECT_LT(most, 0.1);
}

}  // namespace
}  // namespace palpable::sculpt
