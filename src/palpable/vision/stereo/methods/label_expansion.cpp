// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/stereo/methods/label_expansion.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>

#include <opencv2/core.hpp>
#include <opencv2/imgproc/detail/gcgraph.hpp>

namespace palpable::vision {
namespace {

// Integers make the cut exact, so that it terminates and is reproducible.
using Graph = cv::detail::GCGraph<int>;
constexpr float kFixedPoint = 16.0F;
constexpr int kStrip = 4 * Candidates::kCell;

/// A pixel's neighbours after it in raster order, and the rasters of their weights.
struct Neighbour {
  int dx;
  int dy;
  Raster<float> GridEnergy::*weight;
};
constexpr std::array<Neighbour, 4> kNeighbours{{{1, 0, &GridEnergy::right},
                                                {0, 1, &GridEnergy::down},
                                                {1, 1, &GridEnergy::down_right},
                                                {-1, 1, &GridEnergy::down_left}}};

/// Expansion moves within the rows [top, bottom); the labels outside stay fixed. One object a thread.
class StripExpansion {
 public:
  StripExpansion(const GridEnergy& energy, const Candidates& candidates, int top, int bottom)
      : energy_(energy),
        candidates_(candidates),
        top_(top),
        bottom_(bottom),
        node_(energy.width, bottom - top, -1) {}

  /// Whether any pixel took the label.
  bool expand(int alpha, Raster<int>& label) {
    collect(alpha, label);
    if (pixels_.empty()) return false;
    Graph graph(static_cast<unsigned>(pixels_.size()), static_cast<unsigned>(4 * pixels_.size()));
    for (std::size_t i = 0; i < pixels_.size(); ++i) graph.addVtx();
    for (std::size_t i = 0; i < pixels_.size(); ++i) add_terms(static_cast<int>(i), alpha, label, graph);
    graph.maxFlow();
    bool changed = false;
    for (std::size_t i = 0; i < pixels_.size(); ++i) {
      const auto [x, y] = pixels_[i];
      if (!graph.inSourceSegment(static_cast<int>(i))) {
        label(x, y) = alpha;
        changed = true;
      }
      node_(x, y - top_) = -1;
    }
    return changed;
  }

 private:
  void collect(int alpha, const Raster<int>& label) {
    pixels_.clear();
    for (int y = top_; y < bottom_; ++y) {
      for (int cell = 0; cell < candidates_.columns; ++cell) {
        if (candidates_.of(cell, y / Candidates::kCell)[alpha] == 0) continue;
        const int end = std::min(energy_.width, (cell + 1) * Candidates::kCell);
        for (int x = cell * Candidates::kCell; x < end; ++x) {
          if (label(x, y) == alpha) continue;
          node_(x, y - top_) = static_cast<int>(pixels_.size());
          pixels_.push_back({x, y});
        }
      }
    }
  }

  int smoothness(float weight, int a, int b) const {
    const float apart = std::min(static_cast<float>(std::abs(a - b)), energy_.truncation);
    return static_cast<int>(kFixedPoint * weight * apart + 0.5F);
  }

  /// A pixel on the source's side of the cut keeps its label; one on the sink's side takes alpha.
  void add_terms(int i, int alpha, const Raster<int>& label, Graph& graph) const {
    const auto [x, y] = pixels_[static_cast<std::size_t>(i)];
    const int own = label(x, y);
    const std::uint8_t* data = energy_.costs(x, y);
    int keep = static_cast<int>(kFixedPoint) * data[own];
    int take = static_cast<int>(kFixedPoint) * data[alpha];
    for (const Neighbour& n : kNeighbours) {
      if (label.contains(x + n.dx, y + n.dy)) {
        const int other = label(x + n.dx, y + n.dy);
        const float weight = (energy_.*n.weight)(x, y);
        const int j = y + n.dy < bottom_ ? node_(x + n.dx, y + n.dy - top_) : -1;
        if (j < 0) {
          keep += smoothness(weight, own, other);
          take += smoothness(weight, alpha, other);
        } else {
          add_pair(i, j, smoothness(weight, own, other), smoothness(weight, own, alpha),
                   smoothness(weight, alpha, other), keep, take, graph);
        }
      }
      // Pairs with an earlier movable pixel have been added there.
      if (label.contains(x - n.dx, y - n.dy) && (y - n.dy < top_ || node_(x - n.dx, y - n.dy - top_) < 0)) {
        const int other = label(x - n.dx, y - n.dy);
        const float weight = (energy_.*n.weight)(x - n.dx, y - n.dy);
        keep += smoothness(weight, own, other);
        take += smoothness(weight, alpha, other);
      }
    }
    graph.addTermWeights(i, take, keep);
  }

  /// E(x_i, x_j) with x = 1 for alpha: `none` both keep, `second` only j takes it, `first` only i does; both:
  /// 0. Written as none + (first - none) x_i - first x_j + (second + first - none) (1 - x_i) x_j.
  static void add_pair(int i, int j, int none, int second, int first, int& keep_i, int& take_i,
                       Graph& graph) {
    keep_i += none;
    take_i += first;
    graph.addTermWeights(j, 0, first);
    graph.addEdges(i, j, std::max(0, second + first - none), 0);
  }

  const GridEnergy& energy_;
  const Candidates& candidates_;
  int top_;
  int bottom_;
  Raster<int> node_;
  std::vector<Pixel> pixels_;
};

}  // namespace

double GridEnergy::value(const Raster<int>& label) const {
  double sum = 0.0;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      sum += costs(x, y)[label(x, y)];
      for (const Neighbour& n : kNeighbours) {
        if (!label.contains(x + n.dx, y + n.dy)) continue;
        const auto apart = static_cast<float>(std::abs(label(x, y) - label(x + n.dx, y + n.dy)));
        sum += static_cast<double>((this->*n.weight)(x, y) * std::min(apart, truncation));
      }
    }
  }
  return sum;
}

Candidates::Candidates(int width, int height, int label_count)
    : columns((width + kCell - 1) / kCell),
      rows((height + kCell - 1) / kCell),
      labels(label_count),
      flags(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows) *
            static_cast<std::size_t>(labels)) {}

std::uint8_t* Candidates::of(int cell_x, int cell_y) {
  return flags.data() + (static_cast<std::size_t>(cell_y) * static_cast<std::size_t>(columns) +
                         static_cast<std::size_t>(cell_x)) *
                            static_cast<std::size_t>(labels);
}

const std::uint8_t* Candidates::of(int cell_x, int cell_y) const {
  return const_cast<Candidates*>(this)->of(cell_x, cell_y);
}

void expand_labels(const GridEnergy& energy, const Candidates& candidates, int passes, Raster<int>& label,
                   const Work& work) {
  for (int pass = 0; pass < passes; ++pass) {
    const int offset = pass % 2 == 0 ? 0 : kStrip / 2;
    const int strips = (energy.height + offset + kStrip - 1) / kStrip;
    for (const int parity : {0, 1}) {
      const int of_parity = (strips - parity + 1) / 2;
      parallel_for(work, of_parity, 1, [&](int begin, int end) {
        for (int k = begin; k < end; ++k) {
          const int strip = 2 * k + parity;
          const int top = std::max(0, strip * kStrip - offset);
          const int bottom = std::min(energy.height, (strip + 1) * kStrip - offset);
          StripExpansion expansion(energy, candidates, top, bottom);
          for (int alpha = 0; alpha < energy.labels && !work.cancelled(); ++alpha)
            expansion.expand(alpha, label);
        }
      });
    }
  }
}

}  // namespace palpable::vision
