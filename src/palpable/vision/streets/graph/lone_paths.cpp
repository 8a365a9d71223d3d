// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/streets/graph/lone_paths.hpp"

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <vector>

namespace palpable::vision {

void remove_lone_paths(CentreLines& graph, const MapFrame& frame, double border_px) {
  std::vector<std::size_t> group(graph.nodes.size());
  std::iota(group.begin(), group.end(), std::size_t{0});
  const auto root = [&group](int node) {
    auto n = static_cast<std::size_t>(node);
    while (group[n] != n) n = group[n];
    return n;
  };
  for (const CentreLine& line : graph.lines) group[root(line.first)] = root(line.last);
  std::vector<bool> is_kept(graph.nodes.size(), false);
  for (const CentreLine& line : graph.lines) {
    const bool leaves = std::min(distance_to_side(frame, line.points.front()),
                                 distance_to_side(frame, line.points.back())) < border_px;
    if (line.kind != MapStreet::Kind::path || leaves) is_kept[root(line.first)] = true;
  }
  std::erase_if(graph.lines, [&](const CentreLine& line) { return !is_kept[root(line.first)]; });
}

}  // namespace palpable::vision
