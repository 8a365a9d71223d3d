// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sculpt/field/dense_field_from_source.hpp"

#include "palpable/sculpt/solid/mesh_solid.hpp"
#include "palpable/sculpt/solid/test_solids.hpp"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

namespace palpable::sculpt {
namespace {

using models::DenseContent;

models::DenseField dense(const DistanceSource& source, DenseContent content, int resolution) {
  const auto field = dense_field_from_source(source, {content, resolution}, Work{});
  EXPECT_TRUE(field) << field.error().sentence();
  return *field;
}

TEST(DenseFieldFromSource, HoldsTheExactDistanceAtEveryPlace) {
  const Ball ball(0.03);
  const models::DenseField field = dense(ball, DenseContent::distance, 24);
  const models::Lattice& lattice = field.lattice();
  EXPECT_DOUBLE_EQ(lattice.spacing_m, 0.06 / 24);
  for (int z = 0; z < lattice.counts[2]; ++z)
    for (int y = 0; y < lattice.counts[1]; ++y)
      for (int x = 0; x < lattice.counts[0]; ++x)
        ASSERT_FLOAT_EQ(field.values()[lattice.index(x, y, z)],
                        static_cast<float>(norm(lattice.place_m(x, y, z)) - 0.03));
  // Between samples, the field of a ball with a radius of 12 cells has an error equal to the sagitta: h^2 / 8
  // / r, and three times that in the middle of a cell.
  EXPECT_GT(field.errors().max_m, 0.0);
  EXPECT_LT(field.errors().max_m, 3.5 * 0.0025 * 0.0025 / 8.0 / 0.027);
}

TEST(DenseFieldFromSource, MarchesWithinAFractionOfACellOfTheTruthAndKeepsSignsAndDirections) {
  const Ball ball(0.03);
  const models::DenseField field = dense(ball, DenseContent::distance_and_force, 48);
  const models::Lattice& lattice = field.lattice();
  double worst_m = 0.0, worst_near_m = 0.0, worst_turn = 0.0;
  for (int z = 0; z < lattice.counts[2]; ++z)
    for (int y = 0; y < lattice.counts[1]; ++y)
      for (int x = 0; x < lattice.counts[0]; ++x) {
        const Vec3 p = lattice.place_m(x, y, z);
        const float* here = &field.values()[4 * lattice.index(x, y, z)];
        const double truth_m = norm(p) - 0.03, d_m = static_cast<double>(here[0]);
        ASSERT_EQ(d_m < 0.0, truth_m < 0.0) << truth_m;
        worst_m = std::max(worst_m, std::abs(d_m - truth_m));
        if (std::abs(truth_m) < 0.005) worst_near_m = std::max(worst_near_m, std::abs(d_m - truth_m));
        const Vec3 force{static_cast<double>(here[1]), static_cast<double>(here[2]),
                         static_cast<double>(here[3])};
        ASSERT_NEAR(norm(force), 1.0, 1e-5);
        // Near the middle, every direction is correct.
        if (norm(p) > 0.01) worst_turn = std::max(worst_turn, norm(force - unit(p)));
      }
  // First order: the error grows with the distance from the surface and is greatest in the middle of the
  // ball.
  EXPECT_GT(worst_near_m, 0.0);
  EXPECT_LT(worst_near_m, 0.25 * lattice.spacing_m);
  EXPECT_LT(worst_m, 2.0 * lattice.spacing_m);
  EXPECT_LT(worst_turn, 0.15);
}

TEST(DenseFieldFromSource, MarchingConvergesWithTheSpacing) {
  const Ball ball(0.03);
  const double coarse_m = dense(ball, DenseContent::distance_and_force, 24).errors().p99_m;
  const double fine_m = dense(ball, DenseContent::distance_and_force, 60).errors().p99_m;
  EXPECT_LT(fine_m, 0.5 * coarse_m);
}

TEST(DenseFieldFromSource, KeepsTheSignWhereFacesRunAlongTheLattice) {
  const Vec3 low{-0.02, -0.02, -0.02}, high{0.02, 0.02, 0.02};
  const auto solid = solid_from_mesh(box_mesh(low, high), 0.001, Work{});
  ASSERT_TRUE(solid);
  for (const DenseContent content : {DenseContent::distance, DenseContent::distance_and_force}) {
    const models::DenseField field = dense(*solid->distance, content, 20);
    std::mt19937_64 random(2);
    std::uniform_real_distribution<double> uniform(-0.024, 0.024);
    for (int i = 0; i < 4000; ++i) {
      const Vec3 p{uniform(random), uniform(random), uniform(random)};
      const double truth_m = box_distance(p, low, high);
      if (std::abs(truth_m) > 0.002) {
        ASSERT_EQ(field.sample({p}).distance_m < 0.0, truth_m < 0.0);
      }
    }
  }
}

TEST(DenseFieldFromSource, IsTheSameForAnyNumberOfThreads) {
  const auto solid = solid_from_mesh(box_mesh({-0.02, -0.01, 0.0}, {0.02, 0.01, 0.03}), 0.001, Work{});
  ASSERT_TRUE(solid);
  for (const DenseContent content : {DenseContent::distance, DenseContent::distance_and_force}) {
    Work one, three;
    one.threads = 1;
    three.threads = 3;
    const auto a = dense_field_from_source(*solid->distance, {content, 32}, one);
    const auto b = dense_field_from_source(*solid->distance, {content, 32}, three);
    ASSERT_TRUE(a && b);
    EXPECT_EQ(a->values(), b->values());
  }
}

TEST(DenseFieldFromSource, RefusesWhatWouldNotFitBeforeAnythingIsAskedAndSaysWhatFits) {
  /// A solid that must not be queried.
  class Untouched final : public DistanceSource {
   public:
    models::DistanceSample at(Vec3 /*p*/, Hint& /*hint*/) const override {
      ADD_FAILURE() << "asked before the size was known to fit";
      return {};
    }
    Box bounds() const override { return {{0.0, 0.0, 0.0}, {0.1, 0.05, 0.02}}; }
  };
  const Untouched solid;
  DenseFieldOptions options{DenseContent::distance_and_force, 1024};
  options.most_bytes = std::size_t{64} << 20U;
  const auto field = dense_field_from_source(solid, options, Work{});
  ASSERT_FALSE(field);
  EXPECT_EQ(field.error().code, ErrorCode::failed);
  const std::string sentence = field.error().message;
  const auto fits_at = sentence.rfind("; ");
  ASSERT_NE(fits_at, std::string::npos) << sentence;
  options.resolution = std::stoi(sentence.substr(fits_at + 2));
  EXPECT_TRUE(lattice_around(solid.bounds(), options)) << sentence;
  options.resolution += 2;
  EXPECT_FALSE(lattice_around(solid.bounds(), options)) << "more would fit than it says: " << sentence;
}

/// A plate of 40 x 40 x 0.1 mm.
class Plate final : public DistanceSource {
 public:
  models::DistanceSample at(Vec3 p, Hint&) const override {
    return {box_distance(p, -kHalf_m, kHalf_m), {0.0, 0.0, p.z < 0.0 ? -1.0 : 1.0}};
  }
  Box bounds() const override { return {-kHalf_m, kHalf_m}; }

 private:
  static constexpr Vec3 kHalf_m{0.02, 0.02, 5e-5};
};

TEST(DenseFieldFromSource, APlateBetweenThePlacesIsRefusedInsteadOfLost) {
  for (const DenseContent content : {DenseContent::distance, DenseContent::distance_and_force}) {
    // Of 32 cells a layer of places lies in the plate, of 40 none.
    EXPECT_TRUE(dense_field_from_source(Plate(), {content, 32}, Work{}));
    const auto lost = dense_field_from_source(Plate(), {content, 40}, Work{});
    ASSERT_FALSE(lost);
    EXPECT_EQ(lost.error().code, ErrorCode::invalid_input);
  }
}

TEST(DenseFieldFromSource, StopsWhenItIsCancelled) {
  const Ball ball(0.03);
  const std::atomic<bool> cancel{true};
  Work work;
  work.cancel = &cancel;
  for (const DenseContent content : {DenseContent::distance, DenseContent::distance_and_force}) {
    const auto field = dense_field_from_source(ball, {content, 24}, work);
    ASSERT_FALSE(field);
    EXPECT_EQ(field.error().code, ErrorCode::interrupted);
  }
}

}  // namespace
}  // namespace palpable::sculpt
