// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/core/picture/level_lines.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <unordered_map>

namespace palpable {
namespace {

/// A crossing of a grid edge, in samples, and the edge's number, which both adjacent cells share.
struct Crossing {
  double x;
  double y;
  std::uint64_t edge;
};
using CrossedLine = std::vector<Crossing>;

/// Finds the crossings of one level with the grid (marching squares) and joins the segments to lines.
class LevelTracer {
 public:
  LevelTracer(const Raster<float>& heights, double level) : z_(heights), level_(level) {}

  std::vector<CrossedLine> lines() {
    for (int y = 0; y + 1 < z_.height(); ++y)
      for (int x = 0; x + 1 < z_.width(); ++x) cross_cell(x, y);
    std::vector<CrossedLine> found;
    used_.assign(pieces_.size(), false);
    for (std::size_t k = 0; k < pieces_.size(); ++k)
      if (!used_[k]) found.push_back(follow(k));
    return found;
  }

 private:
  double above(int x, int y) const { return double{z_(x, y)} - level_; }

  /// Side 0 is the cell's upper edge, 1 its right, 2 its lower, 3 its left one.
  Crossing on_side(int x, int y, int side) const {
    const int x0 = x + (side == 1 ? 1 : 0);
    const int y0 = y + (side == 2 ? 1 : 0);
    const bool across = side == 0 || side == 2;
    const int x1 = x0 + (across ? 1 : 0);
    const int y1 = y0 + (across ? 0 : 1);
    const double a = above(x0, y0);
    const double t = a / (a - above(x1, y1));
    const auto number = static_cast<std::uint64_t>(y0) * static_cast<std::uint64_t>(z_.width()) +
                        static_cast<std::uint64_t>(x0);
    return {x0 + t * (x1 - x0), y0 + t * (y1 - y0), 2 * number + (across ? 0U : 1U)};
  }

  void cross_cell(int x, int y) {
    const std::array<bool, 4> high{above(x, y) > 0, above(x + 1, y) > 0, above(x + 1, y + 1) > 0,
                                   above(x, y + 1) > 0};
    std::vector<int> sides;
    for (int side = 0; side < 4; ++side)
      if (high[static_cast<std::size_t>(side)] != high[static_cast<std::size_t>((side + 1) % 4)])
        sides.push_back(side);
    if (sides.size() == 2) add(x, y, sides[0], sides[1]);
    if (sides.size() != 4) return;
    // A saddle: the mean height decides which corners are connected.
    const bool middle = above(x, y) + above(x + 1, y) + above(x + 1, y + 1) + above(x, y + 1) > 0;
    const int turn = middle == high[0] ? 0 : 3;
    add(x, y, turn, (turn + 1) % 4);
    add(x, y, (turn + 2) % 4, (turn + 3) % 4);
  }

  void add(int x, int y, int side, int other) {
    const std::size_t k = pieces_.size();
    pieces_.push_back({on_side(x, y, side), on_side(x, y, other)});
    for (const Crossing& end : pieces_.back()) at_edge_[end.edge].push_back(k);
  }

  /// The segment on the other side of an edge, if any.
  bool next_piece(std::uint64_t edge, std::size_t& next) const {
    for (const std::size_t k : at_edge_.at(edge))
      if (!used_[k]) return next = k, true;
    return false;
  }

  CrossedLine follow(std::size_t first) {
    used_[first] = true;
    CrossedLine line{pieces_[first][0], pieces_[first][1]};
    for (const bool forwards : {true, false}) {
      CrossedLine further;
      std::uint64_t edge = forwards ? line.back().edge : line.front().edge;
      for (std::size_t k = 0; next_piece(edge, k);) {
        used_[k] = true;
        const Crossing& end = pieces_[k][pieces_[k][0].edge == edge ? 1 : 0];
        further.push_back(end);
        edge = end.edge;
      }
      if (forwards)
        line.insert(line.end(), further.begin(), further.end());
      else
        line.insert(line.begin(), further.rbegin(), further.rend());
    }
    return line;
  }

  const Raster<float>& z_;
  double level_;
  std::vector<std::array<Crossing, 2>> pieces_;
  std::vector<bool> used_;
  std::unordered_map<std::uint64_t, std::vector<std::size_t>> at_edge_;
};

}  // namespace

std::vector<std::vector<RasterPoint>> level_lines(const Raster<float>& values, double level) {
  std::vector<std::vector<RasterPoint>> lines;
  for (const CrossedLine& crossed : LevelTracer(values, level).lines()) {
    std::vector<RasterPoint>& line = lines.emplace_back();
    line.reserve(crossed.size());
    for (const Crossing& crossing : crossed) line.push_back({crossing.x, crossing.y});
  }
  return lines;
}

}  // namespace palpable
