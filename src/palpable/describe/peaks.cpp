// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/describe/peaks.hpp"

#include "palpable/core/picture/raster.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>

namespace palpable::describe {
namespace {

// A surface with a smaller height range is level.
constexpr double kLevel_m = 1e-5;

/// Heights on a coarse grid, with its sign, and above the ground's plane.
struct HeightGrid {
  Raster<float> height_m;
  double cell_x_m = 0.0, cell_y_m = 0.0;

  GroundPlane ground = {};

  double above_ground_m(const models::Relief& surface, Place p, double sign) const {
    return sign * surface.sample(p.x_m, p.y_m).z_m - ground.height_m(p.x_m, p.y_m);
  }
  Place place_of(int column, int row) const {
    return {(column + 0.5 - 0.5 * height_m.width()) * cell_x_m,
            (0.5 * height_m.height() - row - 0.5) * cell_y_m};
  }
};

HeightGrid grid_of(const models::Relief& surface, double sign, int longest_side) {
  const auto& samples = surface.samples_m();
  const int longest = std::max(samples.width(), samples.height());
  const double shrink = std::min(1.0, static_cast<double>(longest_side) / longest);
  const auto side = [&](int n) { return std::max(2, static_cast<int>(std::lround(n * shrink))); };
  HeightGrid grid{Raster<float>(side(samples.width()), side(samples.height()))};
  grid.cell_x_m = surface.size_x_m() / grid.height_m.width();
  grid.cell_y_m = surface.size_y_m() / grid.height_m.height();
  for (int row = 0; row < grid.height_m.height(); ++row)
    for (int column = 0; column < grid.height_m.width(); ++column) {
      const Place p = grid.place_of(column, row);
      grid.height_m(column, row) = static_cast<float>(sign * surface.sample(p.x_m, p.y_m).z_m);
    }
  return grid;
}

/// The plane of a ground that rises by at least `least_rise_m` from one side of the grid to the other.
std::optional<GroundPlane> tilt_of(const HeightGrid& grid, double least_rise_m) {
  const auto plane = ground_plane_of(grid.height_m, grid.cell_x_m, grid.cell_y_m);
  if (!plane) return std::nullopt;
  const double rise_m = std::abs(plane->dzdx) * grid.cell_x_m * grid.height_m.width() +
                        std::abs(plane->dzdy) * grid.cell_y_m * grid.height_m.height();
  return rise_m < least_rise_m ? std::nullopt : plane;
}

double range_of(const HeightGrid& grid) {
  const auto [low, high] = std::minmax_element(grid.height_m.values().begin(), grid.height_m.values().end());
  return double{*high} - double{*low};
}

/// Subtracts the plane of a tilted ground from the heights.
void level_ground(HeightGrid& grid, double least_rise_m) {
  const auto plane = tilt_of(grid, least_rise_m);
  if (!plane) return;
  grid.ground = *plane;
  for (int row = 0; row < grid.height_m.height(); ++row)
    for (int column = 0; column < grid.height_m.width(); ++column) {
      const Place p = grid.place_of(column, row);
      grid.height_m(column, row) -= static_cast<float>(plane->height_m(p.x_m, p.y_m));
    }
}

/// The grid of a surface above its ground, and the least prominence of a peak of it.
struct LevelledGrid {
  HeightGrid grid;
  double least_m = 0.0;
};

LevelledGrid levelled_grid(const models::Relief& surface, const PeakOptions& options) {
  const double range_m = surface.highest_m() - surface.lowest_m();
  LevelledGrid out{grid_of(surface, options.turned_over ? -1.0 : 1.0, options.longest_side),
                   options.least_prominence * range_m};
  if (!options.above_ground) return out;
  level_ground(out.grid, out.least_m);
  // The tilt is no height of an object; what lies on the plane within its tolerance is ground.
  if (out.grid.ground.dzdx != 0.0 || out.grid.ground.dzdy != 0.0)
    out.least_m = std::min(out.least_m, std::max(options.least_prominence * range_of(out.grid),
                                                 GroundTiltOptions{}.tolerance * range_m));
  return out;
}

/// The regions above a falling level (a merge tree by union-find): each grows around its summit until it
/// meets the region of a higher one.
class Basins {
 public:
  explicit Basins(std::size_t cells) : parent_(cells, kNone), next_(cells, kNone), last_(cells, kNone) {}

  bool contains(std::size_t cell) const { return parent_[cell] != kNone; }
  void add(std::size_t cell) { parent_[cell] = last_[cell] = cell; }
  std::size_t summit_of(std::size_t cell) {
    while (parent_[cell] != cell) cell = parent_[cell] = parent_[parent_[cell]];
    return cell;
  }
  /// Calls visit(cell) for the cells of a summit.
  template <class Visit>
  void visit_cells(std::size_t summit, Visit&& visit) const {
    for (std::size_t cell = summit; cell != kNone; cell = next_[cell]) visit(cell);
  }
  /// A summit that counts keeps its cells.
  enum class Cells { go_along, stay };
  void merge(std::size_t keeps, std::size_t ends, Cells cells) {
    parent_[ends] = keeps;
    if (cells == Cells::stay) return;
    next_[last_[keeps]] = ends;
    last_[keeps] = last_[ends];
  }

 private:
  static constexpr std::size_t kNone = static_cast<std::size_t>(-1);
  std::vector<std::size_t> parent_;
  /// The cells of a summit as a list that begins with it; its last cell, for each summit.
  std::vector<std::size_t> next_, last_;
};

struct Summit {
  std::size_t cell;
  /// The cell nearest to the middle of its top: the region connected to the summit and at most a fiftieth of
  /// the prominence lower.
  std::size_t middle;
  double prominence_m;
  /// The cells above half of the prominence.
  std::size_t cells;
};

/// The middle of a summit's top; the summit itself if that middle is not on the top, as on a rim.
std::size_t middle_of_top(const Raster<float>& height_m, std::size_t summit, double least_m) {
  const int width = height_m.width();
  Raster<std::uint8_t> seen(width, height_m.height(), 0);
  const auto pixel = [&](std::size_t cell) {
    return Pixel{static_cast<int>(cell) % width, static_cast<int>(cell) / width};
  };
  std::vector<Pixel> top{pixel(summit)};
  seen(top[0].x, top[0].y) = 1;
  double sum_x = 0.0, sum_y = 0.0;
  for (std::size_t k = 0; k < top.size(); ++k) {
    const Pixel at = top[k];
    sum_x += at.x;
    sum_y += at.y;
    for (const Pixel step : {Pixel{-1, 0}, Pixel{1, 0}, Pixel{0, -1}, Pixel{0, 1}}) {
      const Pixel next{at.x + step.x, at.y + step.y};
      if (!height_m.contains(next.x, next.y) || seen(next.x, next.y) != 0) continue;
      if (double{height_m(next.x, next.y)} < least_m) continue;
      seen(next.x, next.y) = 1;
      top.push_back(next);
    }
  }
  const double count = static_cast<double>(top.size());
  const Pixel middle{static_cast<int>(std::lround(sum_x / count)),
                     static_cast<int>(std::lround(sum_y / count))};
  if (seen(middle.x, middle.y) == 0) return summit;
  return static_cast<std::size_t>(middle.y) * static_cast<std::size_t>(width) +
         static_cast<std::size_t>(middle.x);
}

/// The summits of at least that prominence, by flooding from the top: two regions meet at the saddle of the
/// lower summit.
std::vector<Summit> summits_of(const Raster<float>& height_m, double least_m) {
  const auto& heights = height_m.values();
  std::vector<std::size_t> order(heights.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return heights[a] > heights[b]; });
  // Places in that order, to compare summits of the same height.
  std::vector<std::size_t> rank(heights.size());
  for (std::size_t k = 0; k < order.size(); ++k) rank[order[k]] = k;
  Basins basins(heights.size());
  std::vector<Summit> summits;
  const auto close = [&](std::size_t summit, float saddle_m) {
    const double prominence_m = double{heights[summit]} - double{saddle_m};
    if (prominence_m < least_m) return Basins::Cells::go_along;
    const double half_m = double{heights[summit]} - 0.5 * prominence_m;
    std::size_t above = 0;
    basins.visit_cells(summit, [&](std::size_t cell) { above += double{heights[cell]} >= half_m ? 1 : 0; });
    constexpr double kTop = 0.02;
    const std::size_t middle = middle_of_top(height_m, summit, double{heights[summit]} - kTop * prominence_m);
    summits.push_back({summit, middle, prominence_m, above});
    return Basins::Cells::stay;
  };
  const int width = height_m.width(), height = height_m.height();
  for (const std::size_t cell : order) {
    basins.add(cell);
    const int column = static_cast<int>(cell) % width, row = static_cast<int>(cell) / width;
    for (const auto& [dx, dy] : std::array<std::pair<int, int>, 4>{{{-1, 0}, {1, 0}, {0, -1}, {0, 1}}}) {
      const int x = column + dx, y = row + dy;
      if (x < 0 || y < 0 || x >= width || y >= height) continue;
      const auto other =
          static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
      if (!basins.contains(other)) continue;
      std::size_t keeps = basins.summit_of(cell), ends = basins.summit_of(other);
      if (keeps == ends) continue;
      if (rank[keeps] > rank[ends]) std::swap(keeps, ends);
      basins.merge(keeps, ends, close(ends, heights[cell]));
    }
  }
  close(basins.summit_of(order.front()), heights[order.back()]);
  return summits;
}

/// The highest of the surface's own samples within a cell of `near`; of those on a level top, the nearest.
Peak highest_near(const models::Relief& surface, const HeightGrid& grid, Place near, double sign) {
  const auto& samples = surface.samples_m();
  const auto column_of = [&](double x_m) {
    return std::clamp(static_cast<int>(std::lround((x_m / surface.size_x_m() + 0.5) * samples.width() - 0.5)),
                      0, samples.width() - 1);
  };
  const auto row_of = [&](double y_m) {
    return std::clamp(
        static_cast<int>(std::lround((0.5 - y_m / surface.size_y_m()) * samples.height() - 0.5)), 0,
        samples.height() - 1);
  };
  Peak best{near, -1e9};
  double best_away_m = 0.0;
  for (int j = row_of(near.y_m + grid.cell_y_m); j <= row_of(near.y_m - grid.cell_y_m); ++j)
    for (int i = column_of(near.x_m - grid.cell_x_m); i <= column_of(near.x_m + grid.cell_x_m); ++i) {
      const Place place{((i + 0.5) / samples.width() - 0.5) * surface.size_x_m(),
                        (0.5 - (j + 0.5) / samples.height()) * surface.size_y_m()};
      const double z_m = grid.above_ground_m(surface, place, sign);
      const double away_m = std::hypot(place.x_m - near.x_m, place.y_m - near.y_m);
      const bool is_level = std::abs(z_m - best.height_m) < kLevel_m;
      if (is_level ? away_m < best_away_m : z_m > best.height_m) {
        best = {place, z_m};
        best_away_m = away_m;
      }
    }
  return best;
}

}  // namespace

std::vector<Peak> find_peaks(const models::Relief& surface, const PeakOptions& options) {
  const double range_m = surface.highest_m() - surface.lowest_m();
  if (range_m < kLevel_m) return {};
  const double sign = options.turned_over ? -1.0 : 1.0;
  const auto [grid, least_m] = levelled_grid(surface, options);
  const double cell_m2 = grid.cell_x_m * grid.cell_y_m;
  std::vector<Peak> peaks;
  for (const Summit& summit : summits_of(grid.height_m, least_m)) {
    const double area = static_cast<double>(summit.cells) / static_cast<double>(grid.height_m.count());
    if (area < options.least_area) continue;
    const int width = grid.height_m.width(), cell = static_cast<int>(summit.middle);
    Peak peak = highest_near(surface, grid, grid.place_of(cell % width, cell / width), sign);
    peak.height_m = surface.sample(peak.place.x_m, peak.place.y_m).z_m;
    peak.prominence_m = summit.prominence_m;
    peak.area_m2 = cell_m2 * static_cast<double>(summit.cells);
    peaks.push_back(peak);
  }
  std::stable_sort(peaks.begin(), peaks.end(),
                   [](const Peak& a, const Peak& b) { return a.prominence_m > b.prominence_m; });
  return peaks;
}

double least_prominence_m(const models::Relief& surface, const PeakOptions& options) {
  return levelled_grid(surface, options).least_m;
}

std::optional<GroundPlane> tilted_ground(const models::Relief& surface, const PeakOptions& options) {
  const double sign = options.turned_over ? -1.0 : 1.0;
  const double least_m = options.least_prominence * (surface.highest_m() - surface.lowest_m());
  auto plane = tilt_of(grid_of(surface, sign, options.longest_side), std::max(least_m, kLevel_m));
  if (plane) *plane = {sign * plane->z_m, sign * plane->dzdx, sign * plane->dzdy};
  return plane;
}

}  // namespace palpable::describe
