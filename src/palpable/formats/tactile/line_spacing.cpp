// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/formats/tactile/line_spacing.hpp"

#include "palpable/formats/tactile/walked_line.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <optional>
#include <utility>

namespace palpable::formats {
namespace {

/// Lines meet where they are nearer than this share of the least distance.
constexpr double kMeets = 0.35;
/// A line is not compared with itself over this many least distances of its length.
constexpr double kOwn = 3.0;
/// How far along a line a place is searched where it meets another one, in least distances.
constexpr double kAhead = 2.0;
constexpr double kLeastFree = 4.0, kLeastEndingOnALine = 2.0;

struct Sample {
  Vec3 at;
  double along_m = 0.0;
};

/// Points of lines, found by their place.
class PointBins {
 public:
  explicit PointBins(double cell_m) : cell_m_(cell_m) {}

  void add(const Sample& sample) { bins_[cell_of(sample.at)].push_back(sample); }

  /// The nearest one within a cell's size of those that `counts` says.
  template <class Counts>
  std::optional<Sample> nearest(Vec3 at, const Counts& counts) const {
    std::optional<Sample> best;
    double least = cell_m_;
    const auto [column, row] = cell_of(at);
    for (int i = column - 1; i <= column + 1; ++i)
      for (int j = row - 1; j <= row + 1; ++j) {
        const auto bin = bins_.find({i, j});
        if (bin == bins_.end()) continue;
        for (const Sample& sample : bin->second)
          if (const double d = norm(sample.at - at); d < least && counts(sample)) {
            least = d;
            best = sample;
          }
      }
    return best;
  }

 private:
  std::pair<int, int> cell_of(Vec3 at) const {
    return {static_cast<int>(std::floor(at.x / cell_m_)), static_cast<int>(std::floor(at.y / cell_m_))};
  }

  double cell_m_;
  std::map<std::pair<int, int>, std::vector<Sample>> bins_;
};

std::vector<Sample> samples_of(const Polyline& line, double step_m) {
  std::vector<Sample> samples;
  double along_m = 0.0;
  walk_along(line, step_m, [&](Vec3 at) {
    const double step = samples.empty() ? 0.0 : norm(at - samples.back().at);
    if (!samples.empty() && step == 0.0) return;
    along_m += step;
    samples.push_back({at, along_m});
  });
  return samples;
}

/// One line against those that are kept.
class Spacing {
 public:
  Spacing(const PointBins& kept, std::vector<Sample> samples, double apart_m, bool closed)
      : kept_(kept), own_(apart_m), samples_(std::move(samples)), apart_m_(apart_m) {
    const double length_m = samples_.empty() ? 0.0 : samples_.back().along_m;
    for (const Sample& sample : samples_) {
      const auto other = other_near(sample, closed, length_m);
      near_.push_back(other ? std::optional(other->at) : std::nullopt);
      if (!other) own_.add(sample);
    }
  }

  /// Whether the whole line is far enough from all others and long enough.
  bool is_free() const {
    return !samples_.empty() && samples_.back().along_m >= kLeastFree * apart_m_ &&
           std::none_of(near_.begin(), near_.end(), [](const auto& near) { return near.has_value(); });
  }

  std::vector<Polyline> pieces() const {
    std::vector<Polyline> pieces;
    for (std::size_t begin = 0; begin < samples_.size();) {
      if (near_[begin]) {
        ++begin;
        continue;
      }
      std::size_t end = begin;
      while (end < samples_.size() && !near_[end]) ++end;
      if (auto piece = piece_of(begin, end)) pieces.push_back(*std::move(piece));
      begin = end;
    }
    return pieces;
  }

 private:
  std::optional<Sample> other_near(const Sample& sample, bool closed, double length_m) const {
    if (auto other = kept_.nearest(sample.at, [](const Sample&) { return true; })) return other;
    return own_.nearest(sample.at, [&](const Sample& own) {
      const double between_m = std::abs(sample.along_m - own.along_m);
      return std::min(between_m, closed ? length_m - between_m : between_m) > kOwn * apart_m_;
    });
  }

  /// The places from a piece's end (a sample) to where the line meets another one; empty if it does not.
  std::vector<Vec3> way_to_other(std::size_t end, int step) const {
    std::vector<Vec3> way;
    for (auto k = static_cast<std::ptrdiff_t>(end) + step;
         k >= 0 && k < static_cast<std::ptrdiff_t>(samples_.size()); k += step) {
      const Sample& sample = samples_[static_cast<std::size_t>(k)];
      const auto& near = near_[static_cast<std::size_t>(k)];
      if (!near || std::abs(sample.along_m - samples_[end].along_m) > kAhead * apart_m_) break;
      way.push_back(sample.at);
      if (norm(*near - sample.at) > kMeets * apart_m_) continue;
      way.push_back(*near);
      return way;
    }
    return {};
  }

  std::optional<Polyline> piece_of(std::size_t begin, std::size_t end) const {
    const double length_m = samples_[end - 1].along_m - samples_[begin].along_m;
    const auto before = way_to_other(begin, -1), after = way_to_other(end - 1, 1);
    const double least = before.empty() && after.empty() ? kLeastFree : kLeastEndingOnALine;
    if (length_m < least * apart_m_) return std::nullopt;
    Polyline piece;
    piece.points.assign(before.rbegin(), before.rend());
    for (std::size_t k = begin; k < end; ++k) piece.points.push_back(samples_[k].at);
    piece.points.insert(piece.points.end(), after.begin(), after.end());
    return piece;
  }

  const PointBins& kept_;
  PointBins own_;
  std::vector<Sample> samples_;
  /// The place on another line that is too near; nullopt: none.
  std::vector<std::optional<Vec3>> near_;
  double apart_m_;
};

}  // namespace

std::vector<std::vector<Polyline>> spaced_lines(std::span<const Polyline> lines, double apart_m) {
  const double step_m = 0.25 * apart_m;
  PointBins kept(apart_m);
  std::vector<std::vector<Polyline>> all;
  for (const Polyline& line : lines) {
    const bool closed =
        line.closed || (line.points.size() > 2 && norm(line.points.front() - line.points.back()) < step_m);
    const Spacing spacing(kept, samples_of(line, step_m), apart_m, closed);
    all.push_back(spacing.is_free() ? std::vector{line} : spacing.pieces());
    for (const Polyline& piece : all.back()) walk_along(piece, step_m, [&](Vec3 at) { kept.add({at, 0.0}); });
  }
  return all;
}

}  // namespace palpable::formats
