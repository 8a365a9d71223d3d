// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/measure/boundary_score.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace palpable::measure {
namespace {

constexpr int kNone = -1;

/// Sparse bipartite graph between found and drawn pixels, and Hopcroft and Karp's (1973) maximum matching on
/// it.
class Matching {
 public:
  Matching(std::vector<std::vector<int>> neighbours, int right_count)
      : neighbours_(std::move(neighbours)),
        partner_of_left_(neighbours_.size(), kNone),
        partner_of_right_(static_cast<std::size_t>(right_count), kNone),
        layer_(neighbours_.size()) {
    while (layers())
      for (int left = 0; left < left_count(); ++left)
        if (partner_of_left_[at(left)] == kNone) augment(left);
  }
  const std::vector<int>& partner_of_left() const { return partner_of_left_; }
  const std::vector<int>& partner_of_right() const { return partner_of_right_; }

 private:
  static std::size_t at(int i) { return static_cast<std::size_t>(i); }
  int left_count() const { return static_cast<int>(neighbours_.size()); }

  /// Breadth-first layers from the free left pixels; whether a free right pixel was reached.
  bool layers() {
    std::vector<int> queue;
    for (int left = 0; left < left_count(); ++left) {
      layer_[at(left)] = partner_of_left_[at(left)] == kNone ? 0 : kNone;
      if (layer_[at(left)] == 0) queue.push_back(left);
    }
    bool reached = false;
    for (std::size_t head = 0; head < queue.size(); ++head) {
      const int left = queue[head];
      for (const int right : neighbours_[at(left)]) {
        const int next = partner_of_right_[at(right)];
        if (next == kNone) {
          reached = true;
        } else if (layer_[at(next)] == kNone) {
          layer_[at(next)] = layer_[at(left)] + 1;
          queue.push_back(next);
        }
      }
    }
    return reached;
  }

  /// Depth-first search along the layers with an explicit stack, since paths may be thousands long.
  void augment(int root) {
    struct Step {
      int left;
      std::size_t next;
    };
    std::vector<Step> path{{root, 0}};
    while (!path.empty()) {
      Step& step = path.back();
      if (step.next == neighbours_[at(step.left)].size()) {
        layer_[at(step.left)] = kNone;
        path.pop_back();
        continue;
      }
      const int right = neighbours_[at(step.left)][step.next++];
      const int next = partner_of_right_[at(right)];
      if (next != kNone) {
        if (layer_[at(next)] == layer_[at(step.left)] + 1) path.push_back({next, 0});
        continue;
      }
      for (const Step& s : path) {
        const int chosen = neighbours_[at(s.left)][s.next - 1];
        partner_of_left_[at(s.left)] = chosen;
        partner_of_right_[at(chosen)] = s.left;
        layer_[at(s.left)] = kNone;
      }
      return;
    }
  }

  std::vector<std::vector<int>> neighbours_;
  std::vector<int> partner_of_left_;
  std::vector<int> partner_of_right_;
  std::vector<int> layer_;
};

struct Pixel {
  int x;
  int y;
};

template <class T>
std::vector<Pixel> pixels_from(const Raster<T>& raster, T least) {
  std::vector<Pixel> out;
  for (int y = 0; y < raster.height(); ++y)
    for (int x = 0; x < raster.width(); ++x)
      if (raster(x, y) >= least) out.push_back({x, y});
  return out;
}

/// Candidate pairs within the radius, nearest first, so that the matching begins with the nearest.
std::vector<std::vector<int>> pairs_within(const std::vector<Pixel>& found, const std::vector<Pixel>& drawn,
                                           int width, int height, double radius) {
  Raster<int> index(width, height, kNone);
  for (std::size_t i = 0; i < drawn.size(); ++i) index(drawn[i].x, drawn[i].y) = static_cast<int>(i);
  std::vector<Pixel> offsets;
  const int r = static_cast<int>(radius);
  for (int dy = -r; dy <= r; ++dy)
    for (int dx = -r; dx <= r; ++dx)
      if (dx * dx + dy * dy <= radius * radius) offsets.push_back({dx, dy});
  std::stable_sort(offsets.begin(), offsets.end(),
                   [](Pixel a, Pixel b) { return a.x * a.x + a.y * a.y < b.x * b.x + b.y * b.y; });
  std::vector<std::vector<int>> out(found.size());
  for (std::size_t i = 0; i < found.size(); ++i)
    for (const Pixel o : offsets)
      if (index.contains(found[i].x + o.x, found[i].y + o.y) &&
          index(found[i].x + o.x, found[i].y + o.y) != kNone)
        out[i].push_back(index(found[i].x + o.x, found[i].y + o.y));
  return out;
}

BoundaryCounts counts_at(const Raster<float>& line, const std::vector<Raster<std::uint8_t>>& truths,
                         double threshold, double radius) {
  BoundaryCounts counts;
  counts.threshold = threshold;
  const auto found = pixels_from(line, static_cast<float>(threshold));
  std::vector<bool> is_true(found.size(), false);
  for (const auto& truth : truths) {
    const auto drawn = pixels_from(truth, std::uint8_t{1});
    const Matching matching(pairs_within(found, drawn, line.width(), line.height(), radius),
                            static_cast<int>(drawn.size()));
    for (std::size_t i = 0; i < found.size(); ++i)
      if (matching.partner_of_left()[i] != kNone) is_true[i] = true;
    counts.wanted += static_cast<std::int64_t>(drawn.size());
    counts.wanted_found +=
        std::count_if(matching.partner_of_right().begin(), matching.partner_of_right().end(),
                      [](int partner) { return partner != kNone; });
  }
  counts.found = static_cast<std::int64_t>(found.size());
  counts.found_true = std::count(is_true.begin(), is_true.end(), true);
  return counts;
}

}  // namespace

double BoundaryCounts::f_measure() const {
  const double sum = precision() + recall();
  return sum > 0.0 ? 2.0 * precision() * recall() / sum : 0.0;
}

BoundaryCounts& BoundaryCounts::operator+=(const BoundaryCounts& other) {
  found += other.found;
  found_true += other.found_true;
  wanted += other.wanted;
  wanted_found += other.wanted_found;
  return *this;
}

std::vector<double> usual_thresholds() {
  std::vector<double> out;
  for (int k = 1; k < 100; k += 2) out.push_back(0.01 * k);
  return out;
}

Result<std::vector<BoundaryCounts>> score_boundary(const Raster<float>& line,
                                                   const std::vector<Raster<std::uint8_t>>& truths,
                                                   const BoundaryScoreOptions& options, const Work& work) {
  if (truths.empty()) return invalid_input("there is no true boundary to compare with");
  for (const auto& truth : truths)
    if (truth.width() != line.width() || truth.height() != line.height())
      return invalid_input("the result and the truth differ in size");
  const double radius = options.tolerance_of_diagonal * std::hypot(line.width(), line.height());
  std::vector<BoundaryCounts> out(options.thresholds.size());
  parallel_for(work, static_cast<int>(out.size()), 1, [&](int begin, int end) {
    for (int k = begin; k < end && !work.cancelled(); ++k)
      out[static_cast<std::size_t>(k)] =
          counts_at(line, truths, options.thresholds[static_cast<std::size_t>(k)], radius);
  });
  if (work.cancelled()) return Work::interrupted();
  return out;
}

Raster<std::uint8_t> boundary_of_labels(const Raster<float>& labels) {
  Raster<std::uint8_t> out(labels.width(), labels.height());
  for (int y = 0; y < labels.height(); ++y)
    for (int x = 0; x < labels.width(); ++x)
      out(x, y) = (x + 1 < labels.width() && labels(x, y) != labels(x + 1, y)) ||
                          (y + 1 < labels.height() && labels(x, y) != labels(x, y + 1))
                      ? 1
                      : 0;
  return out;
}

}  // namespace palpable::measure
