// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/formats/scene/field_streams.hpp"

#include "palpable/formats/scene/model_codec.hpp"
#include "palpable/models/field/field.hpp"
#include "palpable/models/field/field_leaf.hpp"

#include <bit>
#include <memory>
#include <random>
#include <string>
#include <variant>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace palpable::formats {
namespace {

using models::FieldTree;
using models::LeafHead;

models::FieldGrid grid() { return {{-0.01, 0.0, 0.002}, 0.001, 3, {2, 1, 1}}; }

/// Leaves of all kinds: one to three planes and curved pieces, quantised or not, and compact leaves.
FieldTree tree_of_everything(bool with_compact = true) {
  std::mt19937 random(11);
  std::uniform_real_distribution<float> uniform(-1.0F, 1.0F);
  const auto number = [&] { return static_cast<std::uint32_t>(random()); };
  FieldTree tree;
  const auto leaf = [&] {
    const auto at = static_cast<std::uint32_t>(tree.words.size());
    if (with_compact && number() % 3 == 0) {
      models::CompactQuadratic q;
      q.middle = static_cast<std::int32_t>(number() % 4000) - 2000;
      for (std::int32_t& v : q.numbers) v = static_cast<std::int32_t>(number() % 1000) - 500;
      const auto words = models::words_of(q);
      tree.words.insert(tree.words.end(), words.begin(), words.end());
      return at | FieldTree::kLeaf;
    }
    const std::uint32_t pieces = number() % 3, curved = number() % 8;
    tree.words.push_back(pieces | curved << 2U | (number() % 4) << 5U);
    const LeafHead head{tree.words[at]};
    tree.words.resize(tree.words.size() + 2 * pieces);
    for (int i = 0; i < head.pieces(); ++i) {
      if (!head.curved(i)) {
        for (std::size_t k = 0; k < LeafHead::kPlaneWords; ++k)
          tree.words.push_back(std::bit_cast<std::uint32_t>(uniform(random)));
        continue;
      }
      const bool whole = number() % 4 != 0;
      tree.words.push_back(std::bit_cast<std::uint32_t>(
          whole ? static_cast<float>(static_cast<int>(number() % 4000) - 2000) / 8192.0F : uniform(random)));
      for (int k = 0; k < 4; ++k) tree.words.push_back(number());
      tree.words.push_back(number() & 0xFFFFU);
    }
    models::set_half_angles(&tree.words[at]);
    return at | FieldTree::kLeaf;
  };
  tree.nodes.resize(24);
  for (std::size_t i = 0; i < 8; ++i) tree.nodes[i] = i == 3 ? 1U : leaf();
  for (std::size_t i = 8; i < 16; ++i) tree.nodes[i] = i == 9 ? 2U : leaf();
  for (std::size_t i = 16; i < 24; ++i) tree.nodes[i] = leaf();
  // A repeated leaf.
  tree.nodes[20] = tree.nodes[5];
  tree.roots = {0U, leaf()};
  return tree;
}

TEST(FieldStreams, KeepEveryKindOfLeafBitByBit) {
  const FieldTree tree = tree_of_everything();
  const auto again = tree_from(grid(), streams_of(grid(), tree));
  ASSERT_TRUE(again) << again.error().sentence();
  // The words have another order: the order of the leaves in the tree.
  const auto same = [&](std::uint32_t a, std::uint32_t b, auto&& recurse) -> bool {
    if (((a ^ b) & FieldTree::kLeaf) != 0) return false;
    if ((a & FieldTree::kLeaf) == 0) {
      for (std::size_t k = 0; k < 8; ++k)
        if (!recurse(tree.nodes[8 * std::size_t{a} + k], again->nodes[8 * std::size_t{b} + k], recurse))
          return false;
      return true;
    }
    const std::uint32_t* left = &tree.words[a & ~FieldTree::kLeaf];
    const std::uint32_t* right = &again->words[b & ~FieldTree::kLeaf];
    return std::equal(left, left + LeafHead{*left}.words(), right);
  };
  for (std::size_t i = 0; i < tree.roots.size(); ++i)
    EXPECT_TRUE(same(tree.roots[i], again->roots[i], same)) << i;
}

TEST(FieldCodec, ReadsFieldsFromBeforeCompactLeaves) {
  auto distance = models::DistanceField::from_tree(grid(), tree_of_everything(false), {1e-5, 2e-5, 3e-5});
  ASSERT_TRUE(distance) << distance.error().sentence();
  auto field = models::field_of(*std::move(distance), {-0.005, 0.001, 0.003}, {0.005, 0.006, 0.008});
  ASSERT_TRUE(field) << field.error().sentence();
  nlohmann::json description;
  ZipMembers members;
  ASSERT_TRUE(write_field(*field, description, members));
  // The earlier layout had another version number and two streams fewer.
  description["layout"] = 2;
  auto& parts = description["parts"];
  Bytes& cells = members.at(description["cells"].get<std::string>());
  for (int k = 0; k < 2; ++k) {
    cells.resize(cells.size() - parts.back().get<std::size_t>());
    parts.erase(parts.size() - 1);
  }
  const auto model = read_field(description, members);
  ASSERT_TRUE(model) << model.error().sentence();
  const auto& back = std::get<std::shared_ptr<const models::Field>>(*model)->distance;
  for (int k = 0; k < 500; ++k) {
    const Vec3 p{-0.01 + 0.00003 * k, 0.00001 * k, 0.002 + 0.000012 * k};
    ASSERT_EQ(back.sample({p}).distance_m, field->distance.sample({p}).distance_m);
  }
  description["layout"] = 3;
  EXPECT_FALSE(read_field(description, members));
}

TEST(FieldStreams, AreRefusedOrGiveAValidTreeWhenDamaged) {
  const FieldStreams whole = streams_of(grid(), tree_of_everything());
  int refused = 0;
  for (std::size_t stream = 0; stream < FieldStreams::kCount; ++stream)
    for (std::size_t at = 0; at < whole.bytes[stream].size(); ++at) {
      FieldStreams damaged = whole;
      damaged.bytes[stream][at] ^= 0x5BU;
      auto tree = tree_from(grid(), damaged);
      refused += tree ? 0 : 1;
      if (tree) static_cast<void>(models::DistanceField::from_tree(grid(), *std::move(tree), {}));
      damaged.bytes[stream].resize(at);
      auto cut = tree_from(grid(), damaged);
      if (cut) static_cast<void>(models::DistanceField::from_tree(grid(), *std::move(cut), {}));
    }
  EXPECT_GT(refused, 0);
}

}  // namespace
}  // namespace palpable::formats
