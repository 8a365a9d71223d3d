// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/models/field/distance_field.hpp"

#include "palpable/models/field/field_leaf.hpp"

#include <array>
#include <bit>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

namespace palpable::models {
namespace {

std::uint32_t word(float value) { return std::bit_cast<std::uint32_t>(value); }

/// Two root cells of eight finest cells, the left one subdivided; every leaf is a plane that disagrees with
/// its neighbours.
FieldTree inconsistent_tree() {
  std::mt19937 random(7);
  std::uniform_real_distribution<float> uniform(-1.0F, 1.0F);
  FieldTree tree;
  const auto leaf = [&] {
    const auto at = static_cast<std::uint32_t>(tree.words.size());
    tree.words.insert(tree.words.end(), {0U, word(uniform(random)), word(uniform(random)),
                                         word(uniform(random)), word(0.01F * uniform(random))});
    return at | FieldTree::kLeaf;
  };
  tree.nodes.resize(16);
  for (std::size_t i = 0; i < 8; ++i) tree.nodes[i] = i == 3 ? 1U : leaf();
  for (std::size_t i = 8; i < 16; ++i) tree.nodes[i] = leaf();
  tree.roots = {0U, leaf()};
  return tree;
}

FieldGrid small_grid() { return {{-0.01, 0.0, 0.002}, 0.001, 3, {2, 1, 1}}; }

TEST(FieldLeaf, OppositeFacesHaveNoEdge) {
  for (const float cosine : {0.0F, 1e-8F}) {
    double da = 0.0, db = 0.0;
    EXPECT_DOUBLE_EQ(convex_meeting(3e-3, 1e-3, {cosine, 1.0F}, 1e-4, da, db), 3e-3);
    EXPECT_DOUBLE_EQ(da, 1.0);
    EXPECT_DOUBLE_EQ(db, 0.0);
  }
}

TEST(FieldLeaf, ACompactQuadraticIsDecodedFromItsWords) {
  CompactQuadratic q;
  q.middle = -8388608;
  q.numbers = {-2048, 2047, 1, -512, 511, -1, 300, -300, 0};
  ASSERT_TRUE(q.fits());
  const auto words = words_of(q);
  const CompactQuadratic back = compact_of(words.data());
  EXPECT_EQ(back.middle, q.middle);
  EXPECT_EQ(back.numbers, q.numbers);
  const LeafHead head{words[0]};
  EXPECT_EQ(head.words(), words.size());
  EXPECT_EQ(head.pieces(), 1);
  EXPECT_FALSE(head.flat());
  for (const std::size_t k : {std::size_t{0}, std::size_t{8}}) {
    CompactQuadratic large = q;
    large.numbers[k] = k == 0 ? 2048 : 512;
    EXPECT_FALSE(large.fits());
  }
}

TEST(FieldLeaf, ACompactQuadraticEqualsItsCurvedPiece) {
  std::mt19937 random(4);
  const auto number = [&](int most) {
    return static_cast<int>(random() % (2U * static_cast<unsigned>(most))) - most;
  };
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  for (int i = 0; i < 200; ++i) {
    CompactQuadratic q;
    q.middle = number(4000);
    for (std::size_t k = 0; k < 9; ++k) q.numbers[k] = number(k < 3 ? 1024 : 256);
    // The same values in the steps of a curved piece.
    std::array<std::uint32_t, 7> curved{4U,
                                        word(static_cast<float>(q.middle * CompactQuadratic::kMiddleStep))};
    for (std::size_t k = 0; k < 9; ++k) {
      const auto steps = static_cast<int>(q.numbers[k] * CompactQuadratic::step_of(k) / LeafHead::kStep);
      curved[2 + k / 2] |= (static_cast<std::uint32_t>(steps) & 0xFFFFU) << (k % 2 == 0 ? 0U : 16U);
    }
    const auto compact = words_of(q);
    const double x = uniform(random), y = uniform(random), z = uniform(random);
    const DistanceSample a = leaf_at(compact.data(), {}, {x, y, z}, 1e-4, 1e-4);
    const DistanceSample b = leaf_at(curved.data(), {}, {x, y, z}, 1e-4, 1e-4);
    ASSERT_NEAR(a.distance_m, b.distance_m, 1e-15);
    ASSERT_LT(norm(a.gradient - b.gradient), 1e-12);
  }
}

TEST(DistanceField, IsContinuousWithItsGradientForAnyLeaves) {
  const auto field = DistanceField::from_tree(small_grid(), inconsistent_tree(), {});
  ASSERT_TRUE(field) << field.error().sentence();
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> uniform(0.04, 0.96);
  constexpr double kStep_m = 1e-9;
  double steepest = 0.0;
  for (int i = 0; i < 40000; ++i) {
    const Vec3 size = field->grid().size_m();
    Vec3 p = field->grid().origin_m +
             Vec3{uniform(random) * size.x, uniform(random) * size.y, uniform(random) * size.z};
    // Half of them on a face between finest cells.
    if (i % 2 == 0)
      p.x = field->grid().origin_m.x + 0.0005 * std::round((p.x - field->grid().origin_m.x) / 0.0005);
    const Vec3 d = kStep_m * unit({uniform(random) - 0.5, uniform(random) - 0.5, uniform(random) - 0.5});
    const FieldSample a = field->sample({p - d}), b = field->sample({p + d});
    steepest = std::max(steepest, norm(a.gradient));
    EXPECT_NEAR(b.distance_m - a.distance_m, dot(a.gradient + b.gradient, {d}), 1e-12);
    // Leaves that differ by 20 mm within a cell of 1 mm give second derivatives of about 1e5 per metre.
    EXPECT_LT(norm(b.gradient - a.gradient), 1e6 * kStep_m);
  }
  EXPECT_GT(steepest, 2.0) << "the leaves must differ for this test";
}

TEST(DistanceField, EqualsItsLeafAwayFromFaces) {
  FieldTree tree;
  tree.words = {0U, word(0.0F), word(0.6F), word(0.8F), word(-0.002F)};
  tree.roots = {FieldTree::kLeaf, FieldTree::kLeaf};
  const auto field = DistanceField::from_tree(small_grid(), tree, {});
  ASSERT_TRUE(field);
  const FieldSample s = field->sample({{-0.009, 0.003, 0.006}});
  EXPECT_NEAR(s.distance_m, 0.6 * 0.003 + 0.8 * 0.004 - 0.002, 1e-9);
  EXPECT_NEAR(s.gradient.v.y, 0.6, 1e-7);
}

TEST(DistanceField, AddsTheDistanceToItsBoxOutside) {
  FieldTree tree;
  tree.words = {0U, word(0.0F), word(0.0F), word(1.0F), word(0.0F)};
  tree.roots = {FieldTree::kLeaf, FieldTree::kLeaf};
  const auto field = DistanceField::from_tree(small_grid(), tree, {});
  ASSERT_TRUE(field);
  EXPECT_NEAR(field->sample({{0.0, 0.004, 1.01}}).distance_m, 1.008, 1e-6);
  EXPECT_FALSE(field->contains({{0.0, 0.004, 1.01}}));
}

TEST(DistanceField, RefusesTreesWithInvalidIndices) {
  const FieldTree valid = inconsistent_tree();
  FieldTree loop = valid;
  loop.nodes[11] = 0;
  EXPECT_FALSE(DistanceField::from_tree(small_grid(), loop, {}));
  FieldTree beyond = valid;
  beyond.roots[1] = FieldTree::kLeaf | 100000U;
  EXPECT_FALSE(DistanceField::from_tree(small_grid(), beyond, {}));
  FieldTree infinite = valid;
  infinite.words[1] = word(INFINITY);
  EXPECT_FALSE(DistanceField::from_tree(small_grid(), infinite, {}));
  FieldTree few = valid;
  few.roots.pop_back();
  EXPECT_FALSE(DistanceField::from_tree(small_grid(), few, {}));
  FieldGrid flat = small_grid();
  flat.roots[2] = 0;
  EXPECT_FALSE(DistanceField::from_tree(flat, valid, {}));
}

TEST(DistanceField, AKeptWindowChangesNoBit) {
  const auto field = *DistanceField::from_tree(small_grid(), inconsistent_tree(), {});
  std::mt19937 random(9);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  FieldWindow window;
  Vec3 place{-0.005, 0.004, 0.006};
  int kept_windows = 0;
  for (int i = 0; i < 20000; ++i) {
    // Mostly a walk of a fifth of a cell a step, with jumps, also out of the grid and onto its faces.
    if (i % 50 == 0)
      place = field.origin_m() + Vec3{0.008, 0.004, 0.004} +
              Vec3{0.01 * uniform(random), 0.006 * uniform(random), 0.006 * uniform(random)};
    place += 2e-4 * Vec3{uniform(random), uniform(random), uniform(random)};
    if (i % 7 == 0) place.y = 0.001 * std::round(1000.0 * place.y);
    kept_windows += window.is_of(1000.0 * (place - field.origin_m())) ? 1 : 0;
    const FieldSample kept = field.sample({place}, window), anew = field.sample({place});
    ASSERT_EQ(kept.distance_m, anew.distance_m) << i;
    ASSERT_EQ(kept.gradient, anew.gradient) << i;
  }
  EXPECT_GT(kept_windows, 3000);
}

TEST(FieldLeaf, JoinsPlanesInAnExactEdge) {
  // A right-angled convex edge: inside the nearer face, outside the faces or the edge itself.
  const HalfAngle right{static_cast<float>(std::sqrt(0.5)), static_cast<float>(std::sqrt(0.5))};
  double da = 0.0, db = 0.0;
  EXPECT_NEAR(convex_meeting(0.003, 0.004, right, 1e-4, da, db), 0.005, 2e-8);
  EXPECT_NEAR(da, 0.6, 1e-5);
  EXPECT_NEAR(db, 0.8, 1e-5);
  EXPECT_NEAR(convex_meeting(0.003, -0.004, right, 1e-4, da, db), 0.003, 1e-9);
  EXPECT_NEAR(convex_meeting(-0.003, -0.004, right, 1e-4, da, db), -0.003, 1e-9);
  // On the bisector between them, rounded by at most half of the rounding's width.
  EXPECT_NEAR(convex_meeting(-0.003, -0.003, right, 1e-4, da, db), -0.003 + 0.5e-4 * std::sqrt(0.5), 1e-9);
}

}  // namespace
}  // namespace palpable::models
