// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/result.hpp"
#include "palpable/core/work.hpp"
#include "palpable/models/distance_field.hpp"
#include "palpable/models/field_leaf.hpp"
#include "palpable/sculpt/distance_source.hpp"
#include "palpable/sculpt/field_from_source.hpp"
#include "palpable/sculpt/leaf_fit.hpp"

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace palpable::sculpt {

/// One root cell's part of the tree, its entries counted from its own beginning.
struct Branch {
  std::uint32_t entry = 0;
  std::vector<std::uint32_t> nodes;
  std::vector<std::uint32_t> words;
};

/// Samples the root cells that `wanted` names by their number (x fastest); the others' branches stay empty.
/// Errors: failed for more than options.most_bytes, interrupted.
Result<std::vector<Branch>> branches_of(const DistanceSource& source, const models::FieldGrid& grid,
                                        const FitBounds& bounds, const FieldOptions& options,
                                        const std::function<bool(int)>& wanted, const Work& work);

/// A root cell's part of a tree, as it was built.
Branch branch_of(const models::FieldTree& tree, std::size_t root);

/// Joins the branches; leaves that hold the same share their words.
class Joiner {
 public:
  void add(const Branch& branch) {
    const auto first_node = static_cast<std::uint32_t>(tree_.nodes.size() / 8);
    for (const std::uint32_t entry : branch.nodes) tree_.nodes.push_back(moved(entry, branch, first_node));
    tree_.roots.push_back(moved(branch.entry, branch, first_node));
  }
  models::FieldTree take() { return std::move(tree_); }

 private:
  std::uint32_t moved(std::uint32_t entry, const Branch& branch, std::uint32_t first_node) {
    if ((entry & models::FieldTree::kLeaf) == 0) return entry + first_node;
    const std::uint32_t* words = &branch.words[entry & ~models::FieldTree::kLeaf];
    const std::size_t count = models::LeafHead{words[0]}.words();
    const std::string_view key(reinterpret_cast<const char*>(words), count * sizeof(std::uint32_t));
    const auto [at, fresh] =
        known_.try_emplace(std::string(key), static_cast<std::uint32_t>(tree_.words.size()));
    if (fresh) tree_.words.insert(tree_.words.end(), words, words + count);
    return at->second | models::FieldTree::kLeaf;
  }

  models::FieldTree tree_;
  std::unordered_map<std::string, std::uint32_t> known_;
};

}  // namespace palpable::sculpt
