// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sculpt/field/field_branches.hpp"

#include "palpable/sculpt/field/field_too_large.hpp"
#include "palpable/sculpt/field/shared_samples.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <limits>
#include <mutex>
#include <numeric>
#include <utility>

namespace palpable::sculpt {
namespace {

using models::DistanceSample;
using models::FieldGrid;
using models::FieldTree;

/// Copies an entry and its subtree.
std::uint32_t copied(const FieldTree& tree, std::uint32_t entry, Branch& branch) {
  if ((entry & FieldTree::kLeaf) != 0) {
    const std::uint32_t* words = &tree.words[entry & ~FieldTree::kLeaf];
    const auto begin = static_cast<std::uint32_t>(branch.words.size());
    branch.words.insert(branch.words.end(), words, words + models::LeafHead{*words}.words());
    return begin | FieldTree::kLeaf;
  }
  const auto node = static_cast<std::uint32_t>(branch.nodes.size() / 8);
  branch.nodes.resize(branch.nodes.size() + 8);
  for (std::size_t child = 0; child < 8; ++child) {
    const std::uint32_t below = copied(tree, tree.nodes[8 * std::size_t{entry} + child], branch);
    branch.nodes[8 * std::size_t{node} + child] = below;
  }
  return node;
}

class BranchBuilder {
 public:
  BranchBuilder(const DistanceSource& source, const FieldGrid& grid, const FitBounds& bounds,
                const Earlier* earlier, const Work& work)
      : grid_(grid), bounds_(bounds), earlier_(earlier), work_(work), shared_(source, earlier) {
    // Largest size of a cell on the surface: larger ones could miss small details between their samples.
    longest_on_surface_ = std::max(1, (1 << grid.levels) / 2);
  }

  /// Builds the branch of a root cell. A builder may be used for several root cells in turn.
  Branch build(std::array<int, 3> corner, std::size_t root) {
    Branch branch;
    if (earlier_ != nullptr) {
      const double half_m = 0.5 * grid_.cell_m * (1 << grid_.levels);
      branch.kept = earlier_->is_far(place_of(corner) + Vec3{half_m, half_m, half_m}, half_m);
      if (branch.kept) return branch;
    }
    root_ = corner;
    recent_ = {};
    shared_.begin(grid_, place_of(corner), (2 << grid_.levels) + 1);
    branch.entry =
        build(corner, grid_.levels, earlier_ == nullptr ? kNone : earlier_->tree.roots[root], branch);
    branch.greatest_difference_m = shared_.greatest_difference_m();
    return branch;
  }

 private:
  Vec3 place_of(std::array<int, 3> corner) const {
    return grid_.cell_m * Vec3{static_cast<double>(corner[0]), static_cast<double>(corner[1]),
                               static_cast<double>(corner[2])};
  }

  /// `was`: the cell's entry in the earlier tree, or kNone.
  std::uint32_t build(std::array<int, 3> corner, int level, std::uint32_t was, Branch& branch) {
    CellSamples samples;
    samples.half_m = 0.5 * grid_.cell_m * (1 << level);
    samples.centre_m = place_of(corner) + Vec3{samples.half_m, samples.half_m, samples.half_m};
    if (was != kNone && earlier_->is_far(samples.centre_m, samples.half_m))
      return copied(earlier_->tree, was, branch);
    // Includes the cell's corners and a margin for rounding.
    shared_.enter(samples.centre_m, 1.7321 * samples.half_m);
    const std::uint32_t entry = build_within(samples, corner, level, was, branch);
    shared_.leave();
    return entry;
  }

  std::uint32_t build_within(CellSamples& samples, std::array<int, 3> corner, int level, std::uint32_t was,
                             Branch& branch) {
    const int side = 1 << level;
    std::size_t changed = 0;
    for (std::size_t k = 0; k < kFitPlaces; ++k) {
      const SharedSamples::Answer& answer = shared_.at(lattice_place(corner, side, fit_place(k)));
      samples.at[k] = answer.sample;
      samples.coarse_m = std::max(samples.coarse_m, answer.coarse_m);
      samples.coarse_turn = std::max(samples.coarse_turn, answer.coarse_turn);
      changed += answer.changed;
    }
    if (was != kNone) {
      const bool whole = (was & FieldTree::kLeaf) != 0;
      if (changed == 0 && whole) return copied(earlier_->tree, was, branch);
      if (changed < kFitPlaces && !whole) return split(corner, level, was, branch);
    }
    // Half the diagonal of a cube, with a margin.
    constexpr std::size_t kCentre = kFitPlaces / 2;
    const bool on_surface = std::abs(samples.at[kCentre].distance_m) < 1.8 * samples.half_m;
    if (on_surface && side > longest_on_surface_ && !work_.cancelled())
      return split(corner, level, kNone, branch);
    samples.is_last = side <= smallest_side(samples);
    const LeafFit leaf = fit_leaf(samples, bounds_, recent_);
    const bool fits = leaf.error <= 1.0 && (samples.is_last || holds_between(leaf, samples));
    if (!fits && !samples.is_last && !work_.cancelled()) return split(corner, level, kNone, branch);
    if (fits) recent_.add(leaf);
    const auto begin = static_cast<std::uint32_t>(branch.words.size());
    branch.words.insert(branch.words.end(), leaf.used().begin(), leaf.used().end());
    return begin | FieldTree::kLeaf;
  }

  /// A sample point of the fit in half cells from the root's corner.
  std::array<int, 3> lattice_place(std::array<int, 3> corner, int side, Vec3 u) const {
    const auto along = [&](std::size_t axis, double v) {
      return 2 * (corner[axis] - root_[axis]) + side * (1 + static_cast<int>(v));
    };
    return {along(0, u.x), along(1, u.y), along(2, u.z)};
  }

  std::uint32_t split(std::array<int, 3> corner, int level, std::uint32_t was, Branch& branch) {
    const auto node = static_cast<std::uint32_t>(branch.nodes.size() / 8);
    branch.nodes.resize(branch.nodes.size() + 8);
    const int half = 1 << (level - 1);
    for (unsigned child = 0; child < 8; ++child) {
      const std::uint32_t entry =
          build({corner[0] + (child & 1U ? half : 0), corner[1] + (child & 2U ? half : 0),
                 corner[2] + (child & 4U ? half : 0)},
                level - 1, was == kNone ? kNone : earlier_->tree.nodes[8 * std::size_t{was} + child], branch);
      branch.nodes[8 * std::size_t{node} + child] = entry;
    }
    return node;
  }

  /// Tests the leaf at points between those of the fit, to find small details: many near the surface, a few
  /// elsewhere, where small details have little effect. The allowed error is slightly larger, since the bound
  /// was tested at the other points.
  bool holds_between(const LeafFit& leaf, const CellSamples& samples) {
    constexpr std::array<Vec3, 9> kBetween{{{0.4, -0.45, 0.35},
                                            {0.6, 0.56, 0.52},
                                            {-0.64, 0.68, 0.66},
                                            {0.68, -0.62, 0.7},
                                            {0.62, 0.7, -0.68},
                                            {-0.7, -0.64, 0.62},
                                            {-0.66, 0.62, -0.7},
                                            {0.66, -0.68, -0.64},
                                            {-0.62, -0.7, -0.66}}};
    // Edges have a smaller allowance, since the rounding of the edge adds to the error.
    const bool has_edge = models::LeafHead{leaf.words[0]}.pieces() > 1;
    const double slack = has_edge ? 1.1 : 1.5;
    constexpr std::ptrdiff_t kFew = 4;
    const bool is_near = std::any_of(samples.at.begin(), samples.at.end(), [&](const DistanceSample& s) {
      return s.distance_m > -bounds_.inside_m && s.distance_m < bounds_.outside_m;
    });
    const auto holds_at = [&](Vec3 u) {
      const DistanceSample truth = shared_.between(samples.centre_m + samples.half_m * u - place_of(root_));
      return leaf_error(leaf, samples, u, truth, bounds_) <= slack;
    };
    const auto end = is_near ? kBetween.end() : kBetween.begin() + kFew;
    if (!std::all_of(kBetween.begin(), end, holds_at)) return false;
    if (!is_near) return true;
    // In large cells the sample points are far apart: where there is one edge, another one could cut off a
    // part between them.
    const int side = static_cast<int>(std::lround(2.0 * samples.half_m / grid_.cell_m));
    const int more = has_edge && side >= kLarge ? kMorePerCell * side : 0;
    for (int i = 1; i <= more; ++i)
      if (!holds_at(spread_place(i))) return false;
    return true;
  }
  static constexpr int kLarge = 4, kMorePerCell = 8;
  /// The i-th point of a sequence that fills a cell evenly for any number of points (Roberts 2018: R3).
  static Vec3 spread_place(int i) {
    const auto along = [&](double step) {
      const double v = 0.5 + i * step;
      return 2.0 * (v - std::floor(v)) - 1.0;
    };
    return {along(0.8191725133961645), along(0.6710436067037893), along(0.5497004779019703)};
  }

  /// Far from the surface small details do not matter, so cells stay larger.
  int smallest_side(const CellSamples& samples) const {
    double nearest_m = std::numeric_limits<double>::infinity();
    bool outside = true;
    for (const DistanceSample& s : samples.at) {
      nearest_m = std::min(nearest_m, std::abs(s.distance_m));
      outside = outside && s.distance_m > 0.0;
    }
    if (nearest_m <= (outside ? bounds_.outside_m : bounds_.inside_m)) return 1;
    if (!outside) return 2;
    return std::max(2, static_cast<int>(0.25 * nearest_m / grid_.cell_m));
  }

  /// Not an index of a node, since there are fewer than 2^31.
  static constexpr std::uint32_t kNone = FieldTree::kLeaf - 1;
  const FieldGrid& grid_;
  const FitBounds& bounds_;
  const Earlier* earlier_;
  const Work& work_;
  SharedSamples shared_;
  RecentLeaves recent_;
  std::array<int, 3> root_{};
  int longest_on_surface_ = 1;
};

/// Estimates the total size from the finished root cells, which are distributed over the solid.
class SizeEstimate {
 public:
  SizeEstimate(int count, std::size_t most_bytes)
      : count_(count), most_bytes_(static_cast<double>(most_bytes)) {}

  void add(const Branch& branch) {
    const auto bytes =
        static_cast<double>(sizeof(std::uint32_t) * (branch.nodes.size() + branch.words.size()));
    const std::lock_guard lock(mutex_);
    ++done_;
    sum_ += bytes;
    squares_ += bytes * bytes;
    const double mean = sum_ / done_;
    const double variance = std::max(0.0, squares_ / done_ - mean * mean) * (count_ - done_) / count_;
    // Sizes of root cells differ by a factor of a hundred, so the estimate needs enough of them and includes
    // its standard error.
    constexpr double kLeast = 64.0, kSure = 4.0;
    const double least = count_ * (mean - kSure * std::sqrt(variance / done_));
    if (sum_ > most_bytes_ || (done_ >= kLeast && least > most_bytes_)) too_much_ = true;
  }
  bool is_too_much() const { return too_much_.load(std::memory_order_relaxed); }

  /// A field's size grows with its surface, that is, with the square of its resolution.
  Error too_large(const FieldOptions& options) const {
    const double needed_bytes = count_ * sum_ / std::max(1.0, done_);
    const double share = std::sqrt(most_bytes_ / needed_bytes);
    const int fits =
        std::clamp(static_cast<int>(0.9 * share * options.resolution) / 16 * 16, 16, options.resolution);
    return field_too_large("a field", needed_bytes, options.most_bytes, options.resolution, fits);
  }

 private:
  double count_, most_bytes_;
  std::mutex mutex_;
  double done_ = 0.0, sum_ = 0.0, squares_ = 0.0;
  std::atomic<bool> too_much_{false};
};

/// A step size that visits each of `count` root cells once; the first visited ones are distributed over all.
int spread_step(int count) {
  constexpr double kGolden = 0.618034;
  int step = std::max(1, static_cast<int>(kGolden * count));
  while (std::gcd(step, count) != 1) ++step;
  return step;
}

}  // namespace

Result<std::vector<Branch>> branches_of(const DistanceSource& source, const FieldGrid& grid,
                                        const FitBounds& bounds, const FieldOptions& options,
                                        const Earlier* earlier, const Work& work) {
  const int count = grid.roots[0] * grid.roots[1] * grid.roots[2];
  std::vector<Branch> branches(static_cast<std::size_t>(count));
  std::atomic<int> next{0};
  std::atomic<int> done{0};
  SizeEstimate estimate(count, options.most_bytes);
  const std::int64_t step = spread_step(count);
  std::mutex reporting;
  // The work for root cells differs by a factor of a hundred, so each thread takes the next one when it is
  // ready.
  parallel_for(work, static_cast<int>(work.thread_count()), 1, [&](int begin, int end) {
    if (begin == end) return;
    BranchBuilder builder(source, grid, bounds, earlier, work);
    for (int n = next++; n < count && !work.cancelled() && !estimate.is_too_much(); n = next++) {
      const int side = 1 << grid.levels;
      const auto i = static_cast<int>(n * step % count);
      const auto root = static_cast<std::size_t>(i);
      branches[root] = builder.build({i % grid.roots[0] * side, i / grid.roots[0] % grid.roots[1] * side,
                                      i / (grid.roots[0] * grid.roots[1]) * side},
                                     root);
      estimate.add(branches[root]);
      const int ready = ++done;
      if (ready % 32 == 0) {
        const std::lock_guard lock(reporting);
        work.report(0.05 + 0.93 * ready / count, "sampling the distance");
      }
    }
  });
  if (work.cancelled()) return Work::interrupted();
  if (estimate.is_too_much()) return estimate.too_large(options);
  return branches;
}

std::uint32_t Joiner::moved(std::uint32_t entry, const Branch& branch, std::uint32_t first_node) {
  if ((entry & FieldTree::kLeaf) == 0) return entry + first_node;
  const std::uint32_t* words = &branch.words[entry & ~FieldTree::kLeaf];
  const std::size_t count = models::LeafHead{words[0]}.words();
  const auto begin = static_cast<std::uint32_t>(tree_.words.size());
  tree_.words.insert(tree_.words.end(), words, words + count);
  const auto [at, fresh] = known_.insert(begin);
  if (!fresh) tree_.words.resize(begin);
  return *at | FieldTree::kLeaf;
}

std::uint32_t Joiner::kept(std::uint32_t entry) {
  if ((entry & FieldTree::kLeaf) == 0) {
    const auto node = static_cast<std::uint32_t>(tree_.nodes.size() / 8);
    tree_.nodes.resize(tree_.nodes.size() + 8);
    for (std::size_t child = 0; child < 8; ++child) {
      const std::uint32_t below = kept(earlier_->nodes[8 * std::size_t{entry} + child]);
      tree_.nodes[8 * std::size_t{node} + child] = below;
    }
    return node;
  }
  // Shared words stay shared.
  std::uint32_t& went = kept_words_[entry & ~FieldTree::kLeaf];
  if (went == 0) {
    const std::uint32_t* words = &earlier_->words[entry & ~FieldTree::kLeaf];
    went = static_cast<std::uint32_t>(tree_.words.size()) + 1;
    tree_.words.insert(tree_.words.end(), words, words + models::LeafHead{*words}.words());
  }
  return (went - 1) | FieldTree::kLeaf;
}

FitBounds bounds_for(double longest_m, double cell_m, const FieldOptions& options) {
  FitBounds bounds;
  bounds.cell_m = cell_m;
  bounds.bound_m = options.max_error_m > 0.0 ? options.max_error_m : 1e-4 * longest_m;
  // Depths that a hand reaches, limited to shares of the size for small and large scenes.
  bounds.inside_m = std::clamp(options.inside_m, 0.03 * longest_m, 0.15 * longest_m);
  bounds.outside_m = std::clamp(options.outside_m, 0.01 * longest_m, 0.05 * longest_m);
  return bounds;
}

}  // namespace palpable::sculpt
