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

/// How a cell stands to what changed in its solid.
enum class Change : std::uint8_t { none, partly, all };

/// A field that is to be sampled again in part.
struct Earlier {
  const models::FieldTree& tree;
  /// Of a cell (its centre from the grid's origin) and the distance that the source now tells at the places
  /// of the cell's fit. Any thread.
  std::function<Change(const CellSamples&)> change;
  /// The same, from the centre's distance alone: true only where nothing changed.
  std::function<bool(Vec3 centre_m, double half_m, double distance_m)> is_far;
};

/// Samples all root cells, x fastest. With an earlier tree of the same grid, its cells that did not change
/// are copied, to the bit; where a cell changed in part, its children are looked at. Errors: failed for more
/// than options.most_bytes, interrupted.
Result<std::vector<Branch>> branches_of(const DistanceSource& source, const models::FieldGrid& grid,
                                        const FitBounds& bounds, const FieldOptions& options,
                                        const Earlier* earlier, const Work& work);

/// The bounds of a field whose solid's longest side is `longest_m`.
FitBounds bounds_for(double longest_m, double cell_m, const FieldOptions& options);

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
