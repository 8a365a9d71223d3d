// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/models/field/dense_line.hpp"

#include <algorithm>
#include <random>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace palpable::models {
namespace {

constexpr Lattice kLineLattice{{-0.004, 0.002, -0.001}, 0.001, {9, 8, 7}};

/// Noise: a kink at every face between cells.
DenseField noise(DenseContent content, unsigned seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<float> value(-0.0002F, 0.001F);
  std::vector<float> values(floats_of(content) * kLineLattice.places());
  for (float& v : values) v = value(random);
  return *DenseField::from(kLineLattice, content, std::move(values), {});
}

/// Lines between random places, and along the faces and edges of cells.
struct Lines {
  std::mt19937_64 random{17};
  double between(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  }
  Vec3 place(bool on_faces) {
    const Vec3 size = kLineLattice.size_m();
    Vec3 p{between(0.0, size.x), between(0.0, size.y), between(0.0, size.z)};
    if (on_faces) p.x = kLineLattice.spacing_m * static_cast<int>(p.x / kLineLattice.spacing_m);
    if (on_faces && between(0.0, 1.0) < 0.5) p.z = size.z;
    return kLineLattice.origin_m + p;
  }
};

TEST(DenseLine, FindsTheFirstDipHoweverShort) {
  Lines lines;
  int dips = 0;
  for (const DenseContent content : {DenseContent::distance, DenseContent::distance_and_force})
    for (unsigned seed = 0; seed < 40; ++seed) {
      const DenseField field = noise(content, seed);
      for (int k = 0; k < 25; ++k) {
        const Vec3 from = lines.place(k % 5 == 0);
        const Vec3 to =
            k % 5 == 0 ? lines.place(true) : from + lines.between(0.05, 1.0) * (lines.place(false) - from);
        const auto distance_m = [&](double share) {
          return field.sample({from + share * (to - from)}).distance_m;
        };
        constexpr int kPlaces = 3000;
        double least_m = 1.0;
        for (int n = 0; n <= kPlaces; ++n) least_m = std::min(least_m, distance_m(1.0 * n / kPlaces));
        // Just above the lowest value, so that the dip is short; and below it.
        const double below_m = least_m + lines.between(1e-9, 1e-6);
        EXPECT_FALSE(first_dip(field, {from}, {to}, least_m - 1e-5));
        const auto dip = first_dip(field, {from}, {to}, below_m);
        ASSERT_TRUE(dip);
        ++dips;
        EXPECT_LT(distance_m(dip->lowest), below_m + 1e-12);
        EXPECT_LE(dip->begins, dip->lowest);
        if (dip->begins > 0.0) {
          EXPECT_NEAR(distance_m(dip->begins), below_m, 1e-9);
        } else {
          EXPECT_LT(distance_m(0.0), below_m + 1e-9);
        }
        for (int n = 0; n < 300 && dip->begins > 0.0; ++n) {
          const double share = dip->begins * n / 300.0;
          ASSERT_GT(distance_m(share), below_m - 1e-9) << "before the dip at " << dip->begins;
        }
      }
    }
  EXPECT_EQ(dips, 2000);
}

TEST(DenseLine, KnowsAPlaceForALine) {
  const DenseField field = noise(DenseContent::distance, 3);
  const Vec3 place = kLineLattice.origin_m + Vec3{0.0031, 0.0042, 0.0017};
  const double distance_m = field.sample({place}).distance_m;
  EXPECT_FALSE(first_dip(field, {place}, {place}, distance_m - 1e-9));
  const auto dip = first_dip(field, {place}, {place}, distance_m + 1e-9);
  ASSERT_TRUE(dip);
  EXPECT_EQ(dip->begins, 0.0);
}

}  // namespace
}  // namespace palpable::models
