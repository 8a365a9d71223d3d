// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sculpt/field_from_source.hpp"
#include "palpable/sculpt/test_solids.hpp"

#include <algorithm>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

namespace palpable::sculpt {
namespace {

constexpr Vec3 kBeside{0.03, 0.0, 0.0};

/// A ball of 20 mm and a small one beside it.
class BallAndPea final : public DistanceSource {
 public:
  explicit BallAndPea(double pea_m) : pea_(pea_m) {}
  models::FieldSample at(Vec3 p, Hint& hint) const override {
    const models::FieldSample a = ball_.at(p, hint), b = pea_.at(p - kBeside, hint);
    return a.distance_m < b.distance_m ? a : b;
  }
  Box bounds() const override { return {{-0.02, -0.02, -0.02}, {0.035, 0.02, 0.02}}; }

 private:
  Ball ball_{0.02};
  Ball pea_;
};

TEST(UpdatedField, FollowsWhatChangedAndKeepsTheRestToTheBit) {
  FieldOptions options;
  options.resolution = 128;
  const auto before = field_from_source(BallAndPea(0.002), options, {});
  ASSERT_TRUE(before);
  const BallAndPea grown(0.0025);
  const Vec3 reach{0.0025, 0.0025, 0.0025};
  const auto after = updated_field(*before, grown, {kBeside - reach, kBeside + reach}, options, {});
  ASSERT_TRUE(after) << after.error().sentence();
  EXPECT_GT(after->root_cells, 0U);
  EXPECT_LT(after->root_cells, before->tree().roots.size() / 2);
  std::mt19937_64 random(6);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  const Vec3 size = before->grid().size_m();
  int same = 0;
  for (int i = 0; i < 20000; ++i) {
    const double x = uniform(random), y = uniform(random), z = uniform(random);
    const Vec3 p = before->grid().origin_m + Vec3{x * size.x, y * size.y, z * size.z};
    DistanceSource::Hint hint;
    const double truth = grown.at(p, hint).distance_m;
    const models::FieldSample was = before->sample(p), is = after->field.sample(p);
    // The field built anew would err as much: sheets between the balls are rounded, far places are coarse.
    if (truth > -0.003 && truth < 0.001) {
      ASSERT_NEAR(is.distance_m, truth, 0.4 * before->cell_m());
    }
    if (p.x > -0.004) continue;
    ASSERT_EQ(is.distance_m, was.distance_m);
    ASSERT_EQ(is.gradient, was.gradient);
    ++same;
  }
  EXPECT_GT(same, 5000);
}

TEST(UpdatedField, RefusesASolidThatLeavesItsBox) {
  FieldOptions options;
  options.resolution = 32;
  const auto small = field_from_source(Ball(0.01), options, {});
  ASSERT_TRUE(small);
  const auto refused =
      updated_field(*small, Ball(0.02), {{-0.02, -0.02, -0.02}, {0.02, 0.02, 0.02}}, options, {});
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::failed);
}

}  // namespace
}  // namespace palpable::sculpt
