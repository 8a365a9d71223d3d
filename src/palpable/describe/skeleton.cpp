// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/describe/skeleton.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <utility>

namespace palpable::describe {
namespace {

std::array<bool, 8> neighbours_of(const Mask& mask, int x, int y) {
  std::array<bool, 8> on{};
  for (std::size_t k = 0; k < on.size(); ++k) on[k] = mask(x + kAround[k].x, y + kAround[k].y) != 0;
  return on;
}

/// Whether step 0 or 1 of Zhang & Suen deletes the pixel.
bool is_removed(const Mask& mask, int x, int y, int step) {
  const auto on = neighbours_of(mask, x, y);
  int neighbours = 0, changes = 0;
  for (std::size_t k = 0; k < on.size(); ++k) {
    neighbours += on[k] ? 1 : 0;
    changes += !on[k] && on[(k + 1) % 8] ? 1 : 0;
  }
  if (neighbours < 2 || neighbours > 6 || changes != 1) return false;
  return step == 0 ? !(on[0] && on[2] && on[4]) && !(on[2] && on[4] && on[6])
                   : !(on[0] && on[2] && on[6]) && !(on[0] && on[4] && on[6]);
}

/// Whether the pixel only joins two side neighbours that already touch at a corner.
bool is_stair(const Mask& mask, int x, int y) {
  const auto on = neighbours_of(mask, x, y);
  for (std::size_t k = 0; k < on.size(); k += 2)
    if (on[k] && on[(k + 2) % 8] && !on[(k + 4) % 8] && !on[(k + 5) % 8] && !on[(k + 6) % 8]) return true;
  return false;
}

template <class Visit>
void for_inner_pixels(const Mask& mask, const Visit& visit) {
  for (int y = 1; y + 1 < mask.height(); ++y)
    for (int x = 1; x + 1 < mask.width(); ++x)
      if (mask(x, y) != 0) visit(x, y);
}

/// The pixels with at least three neighbours.
Mask node_pixels(const Mask& lines) {
  Mask nodes(lines.width(), lines.height(), 0);
  for_inner_pixels(lines, [&](int x, int y) {
    const auto on = neighbours_of(lines, x, y);
    nodes(x, y) = std::count(on.begin(), on.end(), true) >= 3 ? 1 : 0;
  });
  return nodes;
}

/// Sorts the connected pixels of a path along it, from an end if it has one, and clears them in `rest`.
std::vector<Pixel> in_order(const std::vector<Pixel>& pixels, const Mask& paths, Mask& rest) {
  const auto degree = [&](Pixel p) {
    const auto on = neighbours_of(paths, p.x, p.y);
    return std::count(on.begin(), on.end(), true);
  };
  const auto end = std::find_if(pixels.begin(), pixels.end(), [&](Pixel p) { return degree(p) <= 1; });
  std::vector<Pixel> ordered{end != pixels.end() ? *end : pixels.front()};
  rest(ordered.front().x, ordered.front().y) = 0;
  for (bool found = true; found;) {
    found = false;
    const Pixel at = ordered.back();
    // Side neighbours before corner neighbours, so that no pixel of a staircase is skipped.
    for (const std::size_t first : {std::size_t{0}, std::size_t{1}})
      for (std::size_t k = first; k < kAround.size() && !found; k += 2) {
        const Pixel next{at.x + kAround[k].x, at.y + kAround[k].y};
        if (rest(next.x, next.y) == 0) continue;
        rest(next.x, next.y) = 0;
        ordered.push_back(next);
        found = true;
      }
  }
  return ordered;
}

/// Indices of the nodes adjacent to a pixel.
std::vector<int> nodes_beside(Pixel p, const Raster<int>& node_of) {
  std::vector<int> found;
  for (const Pixel step : kAround) {
    const int node = node_of(p.x + step.x, p.y + step.y) - 1;
    if (node >= 0 && std::find(found.begin(), found.end(), node) == found.end()) found.push_back(node);
  }
  return found;
}

bool are_neighbours(Pixel a, Pixel b) { return std::abs(a.x - b.x) <= 1 && std::abs(a.y - b.y) <= 1; }

SkeletonPath path_of(std::vector<Pixel> pixels, const Raster<int>& node_of) {
  SkeletonPath path;
  path.pixels = std::move(pixels);
  const auto at_first = nodes_beside(path.pixels.front(), node_of),
             at_last = nodes_beside(path.pixels.back(), node_of);
  constexpr std::size_t kLeastRing = 4;
  if (at_first.empty() && at_last.empty()) {
    path.closed = path.pixels.size() >= kLeastRing && are_neighbours(path.pixels.front(), path.pixels.back());
    return path;
  }
  if (path.pixels.size() == 1) {
    path.first = at_first.front();
    if (at_first.size() > 1) path.last = at_first[1];
    return path;
  }
  if (!at_first.empty()) path.first = at_first.front();
  if (!at_last.empty()) path.last = at_last.front();
  return path;
}

}  // namespace

void thin_to_lines(Mask& mask) {
  std::vector<Pixel> removed;
  for (bool changed = true; changed;) {
    changed = false;
    for (const int step : {0, 1}) {
      removed.clear();
      for_inner_pixels(mask, [&](int x, int y) {
        if (is_removed(mask, x, y, step)) removed.push_back({x, y});
      });
      for (const Pixel p : removed) mask(p.x, p.y) = 0;
      changed = changed || !removed.empty();
    }
  }
  for_inner_pixels(mask, [&](int x, int y) {
    if (is_stair(mask, x, y)) mask(x, y) = 0;
  });
}

std::vector<Pixel> flood(const Mask& mask, Pixel start, int mark, Raster<int>& marks, Connected connected) {
  const std::uint8_t value = mask(start.x, start.y);
  std::vector<Pixel> found{start};
  marks(start.x, start.y) = mark;
  for (std::size_t k = 0; k < found.size(); ++k)
    for (std::size_t n = 0; n < kAround.size(); n += connected == Connected::over_sides ? 2 : 1) {
      const Pixel next{found[k].x + kAround[n].x, found[k].y + kAround[n].y};
      if (!mask.contains(next.x, next.y)) continue;
      if (mask(next.x, next.y) != value || marks(next.x, next.y) != 0) continue;
      marks(next.x, next.y) = mark;
      found.push_back(next);
    }
  return found;
}

Skeleton paths_of(const Mask& lines) {
  const Mask nodes = node_pixels(lines);
  Skeleton skeleton;
  Raster<int> node_of(lines.width(), lines.height(), 0);
  for_inner_pixels(nodes, [&](int x, int y) {
    if (node_of(x, y) != 0) return;
    const int mark = static_cast<int>(skeleton.nodes.size()) + 1;
    std::array<double, 2> middle{};
    const auto pixels = flood(nodes, {x, y}, mark, node_of, Connected::over_corners_too);
    for (const Pixel p : pixels) middle[0] += p.x, middle[1] += p.y;
    for (double& m : middle) m /= static_cast<double>(pixels.size());
    skeleton.nodes.push_back(middle);
  });
  Mask paths = lines;
  for_inner_pixels(nodes, [&](int x, int y) { paths(x, y) = 0; });
  Mask rest = paths;
  Raster<int> seen(lines.width(), lines.height(), 0);
  for_inner_pixels(paths, [&](int x, int y) {
    if (seen(x, y) != 0) return;
    auto pixels = in_order(flood(paths, {x, y}, 1, seen, Connected::over_corners_too), paths, rest);
    skeleton.paths.push_back(path_of(std::move(pixels), node_of));
  });
  return skeleton;
}

}  // namespace palpable::describe
