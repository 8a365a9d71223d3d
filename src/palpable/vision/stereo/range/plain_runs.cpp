// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/stereo/range/plain_runs.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <span>
#include <utility>

namespace palpable::vision {
namespace {

struct Run {
  int begin = 0;
  int length = 0;
  double level = 0.0;
};

/// The runs of a row that end inside it.
std::vector<Run> runs_of(std::span<const std::uint8_t> row, const PlainRunOptions& options) {
  std::vector<Run> out;
  const int width = static_cast<int>(row.size());
  int begin = 0;
  double sum = 0.0;
  for (int x = 0; x < width; ++x) {
    const double level = row[static_cast<std::size_t>(x)];
    if (x > begin && std::abs(level - sum / (x - begin)) > options.alike_levels) {
      if (begin > 0 && x - begin >= options.least_px) out.push_back({begin, x - begin, sum / (x - begin)});
      begin = x;
      sum = 0.0;
    }
    sum += level;
  }
  return out;
}

bool are_alike(const Run& a, const Run& b, const PlainRunOptions& options) {
  return std::abs(a.level - b.level) <= 0.5 * options.alike_levels &&
         std::abs(a.length - b.length) <= 1.0 + options.length_share * std::max(a.length, b.length);
}

/// A run of the left picture and its disparity.
struct MatchedRun {
  Run run;
  int disparity_px = 0;
};

std::vector<MatchedRun> matched_runs(const std::vector<Run>& left, const std::vector<Run>& right,
                                     const PlainRunOptions& options) {
  const auto alike_in = [&](const std::vector<Run>& runs, const Run& run) {
    return std::count_if(runs.begin(), runs.end(),
                         [&](const Run& other) { return are_alike(run, other, options); });
  };
  std::vector<MatchedRun> out;
  for (const Run& here : left)
    for (const Run& there : right)
      if (there.begin <= here.begin && are_alike(here, there, options) && alike_in(right, here) == 1 &&
          alike_in(left, there) == 1)
        out.push_back({here, here.begin - there.begin});
  return out;
}

}  // namespace

std::vector<Parameter> parameters_of(PlainRunOptions& o) {
  return {
      {"alike_levels", &o.alike_levels, {1, 64}, "levels", "A run ends at a pixel that differs by more"},
      {"least_px", &o.least_px, {2, 1000}, "px", "Least length of a run"},
      {"length_share", &o.length_share, {0, 1}, "", "Difference of its lengths in both pictures"},
      {"agreeing_rows", &o.agreeing_rows, {1, 5}, "", "Rows within two that must agree, itself included"}};
}

std::vector<int> plain_run_disparities(const Raster<std::uint8_t>& left, const Raster<std::uint8_t>& right,
                                       const PlainRunOptions& options, const Work& work) {
  constexpr int kRowsAround = 2, kShift_px = 4;
  const int height = left.height();
  std::vector<std::vector<MatchedRun>> rows(static_cast<std::size_t>(height));
  parallel_for(work, height, 16, [&](int begin, int end) {
    for (int y = begin; y < end && !work.cancelled(); ++y)
      rows[static_cast<std::size_t>(y)] =
          matched_runs(runs_of(left.row(y), options), runs_of(right.row(y), options), options);
  });
  const auto agrees = [&](const MatchedRun& a, int y) {
    if (y < 0 || y >= height) return false;
    const auto& others = rows[static_cast<std::size_t>(y)];
    return std::any_of(others.begin(), others.end(), [&](const MatchedRun& b) {
      return std::abs(a.disparity_px - b.disparity_px) <= 1 &&
             std::abs(a.run.begin - b.run.begin) <= kShift_px;
    });
  };
  std::vector<int> pixels(static_cast<std::size_t>(left.width()));
  for (int y = 0; y < height; ++y)
    for (const MatchedRun& match : rows[static_cast<std::size_t>(y)]) {
      int agreeing = 0;
      for (int v = y - kRowsAround; v <= y + kRowsAround; ++v) agreeing += agrees(match, v) ? 1 : 0;
      if (agreeing >= options.agreeing_rows)
        pixels[static_cast<std::size_t>(match.disparity_px)] += match.run.length;
    }
  return pixels;
}

}  // namespace palpable::vision
