// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/segmentation/segment_features.hpp"

#include <algorithm>
#include <limits>
#include <numeric>
#include <set>
#include <utility>

namespace palpable::vision {
namespace {

std::array<Pixel, 4> beside(Pixel p) {
  return {Pixel{p.x + 1, p.y}, Pixel{p.x - 1, p.y}, Pixel{p.x, p.y + 1}, Pixel{p.x, p.y - 1}};
}

// Connected components that are being merged: sums, neighbours, and into which one each has gone.
class ComponentGraph {
 public:
  ComponentGraph(const Raster<int>& labels, const Raster<SegmentFeature>& cells);

  void absorb_small(int least_cells);
  void join_similar(float distance);
  SegmentComponents result() const;

 private:
  struct Node {
    int label = 0;
    int cells = 0;
    // Cells all of whose neighbours belong to it.
    int interior = 0;
    std::array<double, kAppearances> appearance{};
    std::array<double, 2> position{};
    std::set<int> neighbours;
    int merged_into = -1;
  };
  Node& node(int i) { return nodes_[static_cast<std::size_t>(i)]; }
  const Node& node(int i) const { return nodes_[static_cast<std::size_t>(i)]; }
  void flood(const Raster<int>& labels, const Raster<SegmentFeature>& cells, Pixel seed);
  static SegmentFeature mean(const Node& n);
  float difference(int a, int b) const { return squared_difference(mean(node(a)), mean(node(b))); }
  int most_similar_neighbour(int i) const;
  void merge(int from, int into);
  int root(int i) const {
    while (node(i).merged_into >= 0) i = node(i).merged_into;
    return i;
  }

  Raster<int> of_cell_;
  std::vector<Node> nodes_;
};

ComponentGraph::ComponentGraph(const Raster<int>& labels, const Raster<SegmentFeature>& cells)
    : of_cell_(labels.width(), labels.height(), -1) {
  for (int y = 0; y < labels.height(); ++y)
    for (int x = 0; x < labels.width(); ++x)
      if (of_cell_(x, y) < 0) flood(labels, cells, {x, y});
  for (int y = 0; y < labels.height(); ++y)
    for (int x = 0; x < labels.width(); ++x) {
      const int here = of_cell_(x, y);
      bool inside = true;
      for (const Pixel next : beside({x, y})) {
        if (!of_cell_.contains(next.x, next.y) || of_cell_(next.x, next.y) == here) continue;
        inside = false;
        node(here).neighbours.insert(of_cell_(next.x, next.y));
      }
      if (inside) ++node(here).interior;
    }
}

void ComponentGraph::flood(const Raster<int>& labels, const Raster<SegmentFeature>& cells, Pixel seed) {
  const int number = static_cast<int>(nodes_.size()), label = labels(seed.x, seed.y);
  Node& component = nodes_.emplace_back();
  component.label = label;
  std::vector<Pixel> open{seed};
  of_cell_(seed.x, seed.y) = number;
  while (!open.empty()) {
    const Pixel at = open.back();
    open.pop_back();
    ++component.cells;
    const SegmentFeature& cell = cells(at.x, at.y);
    for (std::size_t i = 0; i < kAppearances; ++i)
      component.appearance[i] += static_cast<double>(cell.appearance[i]);
    for (std::size_t i = 0; i < 2; ++i) component.position[i] += static_cast<double>(cell.position[i]);
    for (const Pixel next : beside(at)) {
      if (!labels.contains(next.x, next.y) || of_cell_(next.x, next.y) >= 0 ||
          labels(next.x, next.y) != label)
        continue;
      of_cell_(next.x, next.y) = number;
      open.push_back(next);
    }
  }
}

SegmentFeature ComponentGraph::mean(const Node& n) {
  SegmentFeature out;
  for (std::size_t i = 0; i < kAppearances; ++i)
    out.appearance[i] = static_cast<float>(n.appearance[i] / n.cells);
  for (std::size_t i = 0; i < 2; ++i) out.position[i] = static_cast<float>(n.position[i] / n.cells);
  return out;
}

int ComponentGraph::most_similar_neighbour(int i) const {
  int best = -1;
  float least = std::numeric_limits<float>::infinity();
  for (const int other : node(i).neighbours)
    if (const float d = difference(i, other); d < least) least = d, best = other;
  return best;
}

void ComponentGraph::merge(int from, int into) {
  Node& a = node(from);
  Node& b = node(into);
  b.cells += a.cells, b.interior += a.interior;
  for (std::size_t i = 0; i < kAppearances; ++i) b.appearance[i] += a.appearance[i];
  for (std::size_t i = 0; i < 2; ++i) b.position[i] += a.position[i];
  for (const int other : a.neighbours) {
    node(other).neighbours.erase(from);
    if (other == into) continue;
    node(other).neighbours.insert(into);
    b.neighbours.insert(other);
  }
  b.neighbours.erase(from);
  a.neighbours.clear();
  a.merged_into = into;
}

// The smallest first, so that fragments of one thing come together before they join another.
void ComponentGraph::absorb_small(int least_cells) {
  std::set<std::pair<int, int>> small;
  for (int i = 0; i < static_cast<int>(nodes_.size()); ++i)
    if (node(i).interior < least_cells) small.emplace(node(i).cells, i);
  while (!small.empty()) {
    const auto [cells, i] = *small.begin();
    small.erase(small.begin());
    const int into = most_similar_neighbour(i);
    if (into < 0) continue;
    small.erase({node(into).cells, into});
    if (node(into).cells < cells) node(into).label = node(i).label;
    merge(i, into);
    if (node(into).interior < least_cells) small.emplace(node(into).cells, into);
  }
}

void ComponentGraph::join_similar(float distance) {
  for (;;) {
    int first = -1, second = -1;
    float least = distance * distance;
    for (int i = 0; i < static_cast<int>(nodes_.size()); ++i)
      for (const int other : node(i).neighbours)
        if (const float d = difference(i, other); i < other && d < least)
          least = d, first = i, second = other;
    if (first < 0) return;
    // The older identity stays; a label below 0 is none.
    const int low = std::min(node(first).label, node(second).label),
              high = std::max(node(first).label, node(second).label);
    node(second).label = low < 0 ? high : low;
    merge(first, second);
  }
}

SegmentComponents ComponentGraph::result() const {
  SegmentComponents out{of_cell_, {}};
  std::vector<int> number(nodes_.size(), -1);
  for (int i = 0; i < static_cast<int>(nodes_.size()); ++i) {
    if (node(i).merged_into >= 0) continue;
    number[static_cast<std::size_t>(i)] = static_cast<int>(out.components.size());
    out.components.push_back({node(i).label, mean(node(i)), node(i).cells});
  }
  std::vector<int> final_number(nodes_.size());
  for (int i = 0; i < static_cast<int>(nodes_.size()); ++i)
    final_number[static_cast<std::size_t>(i)] = number[static_cast<std::size_t>(root(i))];
  for (int& cell : out.of_cell.values()) cell = final_number[static_cast<std::size_t>(cell)];
  return out;
}

}  // namespace

SegmentComponents merged_components(const Raster<int>& labels, const Raster<SegmentFeature>& cells,
                                    const SegmentMergeOptions& options) {
  ComponentGraph graph(labels, cells);
  graph.absorb_small(options.least_cells);
  graph.join_similar(static_cast<float>(options.merge_distance));
  return graph.result();
}

}  // namespace palpable::vision
