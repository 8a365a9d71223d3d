// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/vision/streets/lines/centre_lines.hpp"

#include <algorithm>
#include <cstddef>
#include <vector>

namespace palpable::vision {

/// Points of lines by place, so that those near a place are found quickly.
class PointGrid {
 public:
  struct Entry {
    std::size_t line;
    std::size_t point;
  };
  PointGrid(int width, int height)
      : columns_(width / kCell + 1),
        rows_(height / kCell + 1),
        cells_(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_)) {}
  void add(const CentreLines& graph) {
    for (std::size_t i = 0; i < graph.lines.size(); ++i)
      for (std::size_t k = 0; k < graph.lines[i].points.size(); ++k)
        cell(column(graph.lines[i].points[k].x), row(graph.lines[i].points[k].y)).push_back({i, k});
  }
  template <class Use>
  void near(MapPoint p, double reach, Use&& use) const {
    for (int r = row(p.y - reach); r <= row(p.y + reach); ++r)
      for (int c = column(p.x - reach); c <= column(p.x + reach); ++c)
        for (const Entry& entry : cells_[index(c, r)]) use(entry);
  }

 private:
  static constexpr int kCell = 16;
  int column(double x) const { return std::clamp(static_cast<int>(x) / kCell, 0, columns_ - 1); }
  int row(double y) const { return std::clamp(static_cast<int>(y) / kCell, 0, rows_ - 1); }
  std::size_t index(int c, int r) const {
    return static_cast<std::size_t>(r) * static_cast<std::size_t>(columns_) + static_cast<std::size_t>(c);
  }
  std::vector<Entry>& cell(int c, int r) { return cells_[index(c, r)]; }
  int columns_;
  int rows_;
  std::vector<std::vector<Entry>> cells_;
};

}  // namespace palpable::vision
