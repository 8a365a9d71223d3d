// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sculpt/streets/street_selection.hpp"

#include <algorithm>
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
std::vector<std::size_t> by_importance(const StreetMap& map, const std::map<std::string, double>& lengths) {
  std::vector<std::size_t> order(map.streets.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto rank = [&](std::size_t i) {
    const MapStreet& street = map.streets[i];
    // Widths in steps, so that of streets of about one width the longer one counts.
    constexpr double kStep_px = 2.0;
    return std::tuple(-std::floor(street.width_px / kStep_px), street.name.empty(),
                      street.name.empty() ? -line_length_px(street) : -lengths.at(street.name), street.name,
                      i);
  };
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return rank(a) < rank(b); });
  return order;
}

/// The streets that were chosen so far, as the piece at each sample of their grooves.
class Chosen {
 public:
  Chosen(const StreetMap& map, const MapGrid& grid, const GrooveWidths& widths, double gap)
      : map_(map), grid_(grid), widths_(widths), gap_(gap), owner_(grid.columns, grid.rows, -1) {}

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
      const int steps = std::max(1, static_cast<int>(length / step()));
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
  double step() const { return std::max(1.0, 0.0004 * grid_.of_metre); }

  std::int32_t owner_at(MapPoint p) const {
    const int x = static_cast<int>(std::lround(p.x)), y = static_cast<int>(std::lround(p.y));
    return x < 0 || y < 0 || x >= grid_.columns || y >= grid_.rows ? -1 : owner_(x, y);
  }

  /// The first groove within the gap on either side of a place.
  std::int32_t beside(MapPoint p, MapPoint across, double own_half) const {
    for (double reach = step(); reach <= own_half + gap_; reach += step())
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
  Raster<std::int32_t> owner_;
};

/// Leaves out groups of felt pieces that hang together and are shorter than `least_px` in all, if there are
/// longer ones.
void drop_fragments(const StreetMap& map, double least_px, std::vector<bool>& felt) {
  constexpr double kJoin_px = 2.0;
  std::map<std::pair<long, long>, std::vector<std::size_t>> at;
  const auto cell = [](MapPoint p) {
    return std::pair(std::lround(p.x / kJoin_px), std::lround(p.y / kJoin_px));
  };
  for (std::size_t i = 0; i < felt.size(); ++i)
    if (felt[i])
      for (const MapPoint end : {map.streets[i].points.front(), map.streets[i].points.back()})
        at[cell(end)].push_back(i);
  std::vector<int> group(felt.size(), -1);
  std::vector<double> lengths;
  for (std::size_t begin = 0; begin < felt.size(); ++begin) {
    if (!felt[begin] || group[begin] >= 0) continue;
    const int number = static_cast<int>(lengths.size());
    lengths.push_back(0.0);
    std::vector<std::size_t> open{begin};
    group[begin] = number;
    while (!open.empty()) {
      const std::size_t piece = open.back();
      open.pop_back();
      lengths.back() += line_length_px(map.streets[piece]);
      for (const MapPoint end : {map.streets[piece].points.front(), map.streets[piece].points.back()}) {
        const auto [x, y] = cell(end);
        for (long j = y - 1; j <= y + 1; ++j)
          for (long i = x - 1; i <= x + 1; ++i) {
            const auto found = at.find({i, j});
            if (found == at.end()) continue;
            for (const std::size_t next : found->second)
              if (group[next] < 0) {
                group[next] = number;
                open.push_back(next);
              }
          }
      }
    }
  }
  if (lengths.empty()) return;
  const double longest = *std::max_element(lengths.begin(), lengths.end());
  for (std::size_t i = 0; i < felt.size(); ++i)
    if (felt[i]) {
      const double length = lengths[static_cast<std::size_t>(group[i])];
      felt[i] = length >= least_px || length == longest;
    }
}

}  // namespace

double groove_width_m(const MapStreet& street, const MapGrid& grid, const GrooveWidths& widths) {
  return std::clamp(street.width_px * grid.of_pixel / grid.of_metre, widths.narrowest_m, widths.widest_m);
}

StreetSelection select_streets(const StreetMap& map, const MapGrid& grid, const GrooveWidths& widths,
                               const TactileRules& rules) {
  StreetSelection out;
  std::map<std::string, double> lengths;
  for (const MapStreet& street : map.streets) lengths[street.name] += line_length_px(street);
  out.felt.assign(map.streets.size(), false);
  std::vector<bool> stands_for(map.streets.size(), false);
  Chosen chosen(map, grid, widths, rules.least_gap_m * grid.of_metre);
  constexpr double kMostCrowded = 0.5;
  for (const std::size_t piece : by_importance(map, lengths)) {
    const auto crowding = chosen.crowding_of(piece);
    if (crowding.part <= kMostCrowded) {
      chosen.add(piece);
      out.felt[piece] = true;
    } else if (!map.streets[piece].name.empty() &&
               map.streets[static_cast<std::size_t>(crowding.by)].name == map.streets[piece].name) {
      stands_for[piece] = true;
    }
  }
  // A line shorter than two grooves and the gap between them leads nowhere.
  const double least_px = (2.0 * widths.narrowest_m + rules.least_gap_m) * grid.of_metre / grid.of_pixel;
  drop_fragments(map, least_px, out.felt);
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
