// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <numeric>
#include <vector>

namespace palpable {

/// Disjoint sets of the numbers 0 … count - 1 (count below 2^32), each in a set of its own at first
/// (union-find with path halving).
class DisjointSets {
 public:
  explicit DisjointSets(std::size_t count) : parent_(count) {
    std::iota(parent_.begin(), parent_.end(), std::uint32_t{0});
  }
  /// The number that stands for the set of `i`; it may change when sets are joined.
  std::uint32_t find(std::size_t i) {
    auto at = static_cast<std::uint32_t>(i);
    while (parent_[at] != at) at = parent_[at] = parent_[parent_[at]];
    return at;
  }
  /// Joins the sets of `a` and `b`; gives the number that stands for both, which is that of `b`.
  std::uint32_t join(std::size_t a, std::size_t b) { return parent_[find(a)] = find(b); }
  /// The least member of each number's set.
  std::vector<std::uint32_t> firsts() {
    constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
    std::vector<std::uint32_t> first_of(parent_.size(), kNone), firsts(parent_.size());
    for (std::uint32_t i = 0; i < firsts.size(); ++i) {
      std::uint32_t& first = first_of[find(i)];
      if (first == kNone) first = i;
      firsts[i] = first;
    }
    return firsts;
  }

 private:
  std::vector<std::uint32_t> parent_;
};

}  // namespace palpable
