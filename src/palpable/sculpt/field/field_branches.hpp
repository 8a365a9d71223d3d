// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/result.hpp"
#include "palpable/core/work.hpp"
#include "palpable/models/field/distance_field.hpp"
#include "palpable/models/field/field_leaf.hpp"
#include "palpable/sculpt/field/field_from_source.hpp"
#include "palpable/sculpt/field/leaf_fit.hpp"
#include "palpable/sculpt/solid/distance_source.hpp"

#include <cstdint>
#include <functional>
#include <string_view>
#include <unordered_set>
#include <vector>

namespace palpable::sculpt {

/// The subtree of one root cell, with indices relative to its start.
struct Branch {
  std::uint32_t entry = 0;
  std::vector<std::uint32_t> nodes;
  std::vector<std::uint32_t> words;
  /// The value from the source (DistanceSource::Hint).
  double greatest_difference_m = 0.0;
  /// Whether nothing changed in it: it is the same as in the earlier tree, and the other members are empty.
  bool kept = false;
};

/// A field of which a part is sampled again.
struct Earlier {
  const models::FieldTree& tree;
  /// Whether the nearest surface point may belong to the change, for a point relative to the grid's origin
  /// and the source's new distance there. Any thread.
  std::function<bool(Vec3 from_origin_m, double distance_m)> changed_at;
  /// A quick test of a cell without the source: true only if nothing changed in it.
  std::function<bool(Vec3 centre_m, double half_m)> is_far;
};

/// Samples all root cells, x fastest. With an earlier tree on the same grid, unchanged cells are copied bit
/// by bit; if a part of a cell changed, its children are visited. Errors: failed for more than
/// options.most_bytes, interrupted.
Result<std::vector<Branch>> branches_of(const DistanceSource& source, const models::FieldGrid& grid,
                                        const FitBounds& bounds, const FieldOptions& options,
                                        const Earlier* earlier, const Work& work);

/// The fit bounds of a field of a solid with this longest side.
FitBounds bounds_for(double longest_m, double cell_m, const FieldOptions& options);

/// Joins branches in the order of their root cells; leaves with equal content share their words.
class Joiner {
 public:
  /// `earlier`: the tree that contains the kept branches, or null.
  explicit Joiner(const models::FieldTree* earlier = nullptr)
      : earlier_(earlier), known_(0, Hash{tree_.words}, Same{tree_.words}) {
    if (earlier_ != nullptr) kept_words_.resize(earlier_->words.size());
  }
  void add(const Branch& branch) {
    if (branch.kept) {
      const std::uint32_t entry = kept(earlier_->roots[tree_.roots.size()]);
      tree_.roots.push_back(entry);
      return;
    }
    const auto first_node = static_cast<std::uint32_t>(tree_.nodes.size() / 8);
    for (const std::uint32_t entry : branch.nodes) tree_.nodes.push_back(moved(entry, branch, first_node));
    tree_.roots.push_back(moved(branch.entry, branch, first_node));
  }
  Joiner(const Joiner&) = delete;
  Joiner& operator=(const Joiner&) = delete;
  models::FieldTree take() { return std::move(tree_); }

 private:
  std::uint32_t moved(std::uint32_t entry, const Branch& branch, std::uint32_t first_node);
  std::uint32_t kept(std::uint32_t entry);

  /// Hash of the words of the leaf that starts at an index.
  struct Hash {
    const std::vector<std::uint32_t>& words;
    std::size_t operator()(std::uint32_t begin) const {
      return std::hash<std::string_view>{}(bytes(words, begin));
    }
  };
  struct Same {
    const std::vector<std::uint32_t>& words;
    bool operator()(std::uint32_t a, std::uint32_t b) const { return bytes(words, a) == bytes(words, b); }
  };
  static std::string_view bytes(const std::vector<std::uint32_t>& words, std::uint32_t begin) {
    return {reinterpret_cast<const char*>(&words[begin]),
            sizeof(std::uint32_t) * models::LeafHead{words[begin]}.words()};
  }

  models::FieldTree tree_;
  const models::FieldTree* earlier_;
  /// Start index of the words of each distinct leaf.
  std::unordered_set<std::uint32_t, Hash, Same> known_;
  /// New start index, plus 1, of each leaf of the earlier tree; 0: not copied yet.
  std::vector<std::uint32_t> kept_words_;
};

}  // namespace palpable::sculpt
