// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sculpt/streets/street_selection.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <numeric>
#include <set>
#include <tuple>
#include <utility>

namespace palpable::sculpt {
namespace {

double line_length_px(const MapStreet& street) {
  double sum = 0.0;
  for (std::size_t i = 1; i < street.points.size(); ++i)
    sum +=
        std::hypot(street.points[i].x - street.points[i - 1].x, street.points[i].y - street.points[i - 1].y);
  return sum;
}

/// The pieces, the most important first.
std::vector<std::size_t> by_importance(const StreetMap& map, const std::map<std::string, double>& lengths,
                                       double width_step_px) {
  std::vector<std::size_t> order(map.streets.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto rank = [&](std::size_t i) {
    const MapStreet& street = map.streets[i];
    return std::tuple(street.kind != MapStreet::Kind::street, -std::floor(street.width_px / width_step_px),
                      street.name.empty(),
                      street.name.empty() ? -line_length_px(street) : -lengths.at(street.name), street.name,
                      i);
  };
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return rank(a) < rank(b); });
  return order;
}

/// The streets that were chosen so far, as the piece at each sample of their grooves.
class Chosen {
 public:
  Chosen(const StreetMap& map, const MapGrid& grid, const GrooveWidths& widths, double gap, double step_m)
      : map_(map),
        grid_(grid),
        widths_(widths),
        gap_(gap),
        step_(std::max(1.0, step_m * grid.of_metre)),
        owner_(grid.columns, grid.rows, -1) {}

  void add(std::size_t piece) {
    const MapStreet& street = map_.streets[piece];
    for (std::size_t k = 1; k < street.points.size(); ++k)
      near_segment(grid_, grid_.at(street.points[k - 1]), grid_.at(street.points[k]), half(piece),
                   [&](int x, int y, double) { owner_(x, y) = static_cast<std::int32_t>(piece); });
  }

  /// How much of a piece has another one too near beside it, 0 ... 1, and which one mostly.
  struct Crowding {
    double part = 0.0;
    std::int32_t by = -1;
  };
  Crowding crowding_of(std::size_t piece) const {
    const MapStreet& street = map_.streets[piece];
    int places = 0, crowded = 0;
    std::map<std::int32_t, int> by;
    const double total = line_length_px(street) * grid_.of_pixel;
    double along = 0.0;
    for (std::size_t k = 1; k < street.points.size(); ++k) {
      const MapPoint a = grid_.at(street.points[k - 1]), b = grid_.at(street.points[k]);
      const MapPoint d{b.x - a.x, b.y - a.y};
      const double length = std::hypot(d.x, d.y);
      const int steps = std::max(1, static_cast<int>(length / step_));
      for (int i = 0; i < steps && length > 0.0; ++i) {
        const double t = (i + 0.5) / steps;
        const double from_end = std::min(along + t * length, total - along - t * length);
        const MapPoint at{a.x + t * d.x, a.y + t * d.y};
        const std::int32_t here = owner_at(at);
        // In the groove that it begins or ends at.
        if (here >= 0 && from_end <= half(static_cast<std::size_t>(here))) continue;
        ++places;
        const std::int32_t other = here >= 0 ? here : beside(at, {-d.y / length, d.x / length}, half(piece));
        if (other < 0) continue;
        ++crowded;
        ++by[other];
      }
      along += length;
    }
    if (crowded == 0) return {};
    const auto most = std::max_element(by.begin(), by.end(),
                                       [](const auto& x, const auto& y) { return x.second < y.second; });
    return {static_cast<double>(crowded) / places, most->first};
  }

 private:
  double half(std::size_t piece) const {
    return 0.5 * groove_width_m(map_.streets[piece], grid_, widths_) * grid_.of_metre;
  }

  std::int32_t owner_at(MapPoint p) const {
    const int x = static_cast<int>(std::lround(p.x)), y = static_cast<int>(std::lround(p.y));
    return x < 0 || y < 0 || x >= grid_.columns || y >= grid_.rows ? -1 : owner_(x, y);
  }

  /// The first groove within the gap on either side of a place.
  std::int32_t beside(MapPoint p, MapPoint across, double own_half) const {
    for (double reach = step_; reach <= own_half + gap_; reach += step_)
      for (const double side : {1.0, -1.0})
        if (const std::int32_t other =
                owner_at({p.x + side * reach * across.x, p.y + side * reach * across.y});
            other >= 0)
          return other;
    return -1;
  }

  const StreetMap& map_;
  const MapGrid& grid_;
  const GrooveWidths& widths_;
  double gap_;
  double step_;
  Raster<std::int32_t> owner_;
};

/// The nodes at the two ends of each piece: ends in one place are one node.
std::vector<std::array<std::size_t, 2>> nodes_of(const StreetMap& map, double join_px) {
  std::map<std::pair<long, long>, std::vector<std::size_t>> cells;
  std::vector<MapPoint> nodes;
  const auto node_at = [&](MapPoint p) {
    const long x = std::lround(p.x / join_px), y = std::lround(p.y / join_px);
    for (long j = y - 1; j <= y + 1; ++j)
      for (long i = x - 1; i <= x + 1; ++i) {
        const auto found = cells.find({i, j});
        if (found == cells.end()) continue;
        for (const std::size_t node : found->second)
          if (std::hypot(nodes[node].x - p.x, nodes[node].y - p.y) <= join_px) return node;
      }
    cells[{x, y}].push_back(nodes.size());
    nodes.push_back(p);
    return nodes.size() - 1;
  };
  std::vector<std::array<std::size_t, 2>> ends;
  for (const MapStreet& street : map.streets)
    ends.push_back({node_at(street.points.front()), node_at(street.points.back())});
  return ends;
}

/// Groups of nodes that hang together.
class Groups {
 public:
  explicit Groups(std::size_t nodes) : up_(nodes) { std::iota(up_.begin(), up_.end(), std::size_t{0}); }
  std::size_t of(std::size_t node) {
    while (up_[node] != node) node = up_[node] = up_[up_[node]];
    return node;
  }
  /// Whether they were two groups.
  bool join(std::size_t a, std::size_t b) {
    a = of(a);
    b = of(b);
    up_[a] = b;
    return a != b;
  }

 private:
  std::vector<std::size_t> up_;
};

/// Adds pieces that connect groups of felt streets, the most important first, so that routes can be followed
/// where streets are near each other: their grooves merge (Kruskal 1956, without branches that lead nowhere).
void connect(const std::vector<std::array<std::size_t, 2>>& ends, const std::vector<std::size_t>& order,
             std::vector<bool>& felt) {
  Groups groups(2 * ends.size());
  std::vector<int> felt_at(2 * ends.size(), 0);
  for (std::size_t i = 0; i < ends.size(); ++i)
    if (felt[i]) {
      groups.join(ends[i][0], ends[i][1]);
      for (const std::size_t node : ends[i]) ++felt_at[node];
    }
  std::vector<std::size_t> added;
  for (const std::size_t i : order)
    if (!felt[i] && groups.join(ends[i][0], ends[i][1])) {
      added.push_back(i);
      for (const std::size_t node : ends[i]) ++felt_at[node];
    }
  for (bool changed = true; changed;) {
    changed = false;
    std::erase_if(added, [&](std::size_t i) {
      if (felt_at[ends[i][0]] > 1 && felt_at[ends[i][1]] > 1) return false;
      for (const std::size_t node : ends[i]) --felt_at[node];
      return changed = true;
    });
  }
  for (const std::size_t i : added) felt[i] = true;
}

/// Leaves out groups of felt pieces that hang together and are shorter than `least_px` in all, if there are
/// longer ones.
void drop_fragments(const StreetMap& map, const std::vector<std::array<std::size_t, 2>>& ends,
                    double least_px, std::vector<bool>& felt) {
  Groups groups(2 * ends.size());
  for (std::size_t i = 0; i < felt.size(); ++i)
    if (felt[i]) groups.join(ends[i][0], ends[i][1]);
  std::map<std::size_t, double> lengths;
  double longest = 0.0;
  for (std::size_t i = 0; i < felt.size(); ++i)
    if (felt[i])
      longest = std::max(longest, lengths[groups.of(ends[i][0])] += line_length_px(map.streets[i]));
  for (std::size_t i = 0; i < felt.size(); ++i)
    if (felt[i]) {
      const double length = lengths[groups.of(ends[i][0])];
      felt[i] = length >= least_px || length == longest;
    }
}

}  // namespace

std::vector<Parameter> parameters_of(StreetSelectionOptions& o) {
  return {{"width_step_px", &o.width_step_px, {0.1, 50}, "px", "widths that differ less count as one"},
          {"join_px", &o.join_px, {0.1, 50}, "px", "ends of streets this near meet"},
          {"step_m", &o.step_m, {1e-5, 0.01}, "m", "steps in which the land beside a street is looked at"},
          {"most_crowded", &o.most_crowded, {0, 1}, "", "part of a piece with others too near beside it"}};
}

double groove_width_m(const MapStreet& street, const MapGrid& grid, const GrooveWidths& widths) {
  return std::clamp(street.width_px * grid.of_pixel / grid.of_metre, widths.narrowest_m, widths.widest_m);
}

StreetSelection select_streets(const StreetMap& map, const MapGrid& grid, const GrooveWidths& widths,
                               const TactileRules& rules, const StreetSelectionOptions& options) {
  StreetSelection out;
  std::map<std::string, double> lengths;
  for (const MapStreet& street : map.streets) lengths[street.name] += line_length_px(street);
  out.felt.assign(map.streets.size(), false);
  std::vector<bool> stands_for(map.streets.size(), false);
  Chosen chosen(map, grid, widths, rules.least_gap_m * grid.of_metre, options.step_m);
  const auto order = by_importance(map, lengths, options.width_step_px);
  for (const std::size_t piece : order) {
    const auto crowding = chosen.crowding_of(piece);
    if (crowding.part <= options.most_crowded) {
      chosen.add(piece);
      out.felt[piece] = true;
    } else if (!map.streets[piece].name.empty() &&
               map.streets[static_cast<std::size_t>(crowding.by)].name == map.streets[piece].name) {
      stands_for[piece] = true;
    }
  }
  // A line shorter than two grooves and the gap between them leads nowhere.
  const double least_px = (2.0 * widths.narrowest_m + rules.least_gap_m) * grid.of_metre / grid.of_pixel;
  const auto ends = nodes_of(map, options.join_px);
  connect(ends, order, out.felt);
  drop_fragments(map, ends, least_px, out.felt);
  std::set<std::string> names, felt_names;
  for (std::size_t i = 0; i < out.felt.size(); ++i) {
    if (out.felt[i]) felt_names.insert(map.streets[i].name);
    if (!map.streets[i].name.empty()) names.insert(map.streets[i].name);
    if (out.felt[i]) continue;
    if (stands_for[i])
      ++out.merged;
    else
      ++out.left_out;
  }
  for (const std::string& name : names)
    if (!felt_names.contains(name)) out.left_out_names.push_back(name);
  std::sort(out.left_out_names.begin(), out.left_out_names.end(),
            [&](const std::string& a, const std::string& b) { return lengths[a] > lengths[b]; });
  return out;
}

}  // namespace palpable::sculpt
