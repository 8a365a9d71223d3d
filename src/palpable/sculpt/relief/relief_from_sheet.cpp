// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sculpt/relief/relief_from_sheet.hpp"

#include "palpable/models/relief/relief_shaping.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

namespace palpable::sculpt {
namespace {

using Corners = std::array<Vec3, 3>;

/// nullopt if a vertex is missing or not finite.
std::optional<Corners> corners_of(const Mesh& mesh, const std::array<std::uint32_t, 3>& triangle) {
  Corners corners;
  for (std::size_t k = 0; k < 3; ++k) {
    if (triangle[k] >= mesh.vertices_m.size() || !is_finite(mesh.vertices_m[triangle[k]]))
      return std::nullopt;
    corners[k] = mesh.vertices_m[triangle[k]];
  }
  return corners;
}

struct Extent {
  Vec3 least_m;
  Vec3 most_m;
};

std::optional<Extent> extent_of(const Mesh& mesh) {
  std::optional<Extent> extent;
  for (const auto& triangle : mesh.triangles)
    if (const auto corners = corners_of(mesh, triangle))
      for (const Vec3 p : *corners) {
        if (!extent) extent = {p, p};
        Vec3 &low = extent->least_m, &high = extent->most_m;
        low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
        high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
      }
  return extent;
}

/// Twice the signed area of (a, b, p) in the plane z = 0. (b, a, p) gives exactly the opposite number, so
/// two triangles leave no gap along a shared edge.
double edge(Vec3 a, Vec3 b, double x, double y) {
  const bool swapped = b.x < a.x || (b.x == a.x && b.y < a.y);
  if (swapped) std::swap(a, b);
  const double area = (b.x - a.x) * (y - a.y) - (b.y - a.y) * (x - a.x);
  return swapped ? -area : area;
}

/// Rasterises triangles: the greatest height on the vertical line through each pixel.
struct TriangleRasteriser {
  Raster<float>& heights;
  double left_m, top_m, pixel_m;

  double x_m(int column) const { return left_m + (column + 0.5) * pixel_m; }
  double y_m(int row) const { return top_m - (row + 0.5) * pixel_m; }
  /// The first and one past the last pixel whose centre lies between from_m and to_m, with a margin of one
  /// pixel for rounding.
  std::pair<int, int> pixels(double from_m, double to_m, int count) const {
    const auto clamped = [&](double pixel) {
      return static_cast<int>(std::clamp(pixel, 0.0, static_cast<double>(count)));
    };
    return {clamped(std::floor(from_m / pixel_m - 0.5)), clamped(std::ceil(to_m / pixel_m - 0.5) + 1.0)};
  }

  void to(Corners t, int first_row, int last_row) const {
    double area = edge(t[0], t[1], t[2].x, t[2].y);
    if (area == 0.0) return;
    if (area < 0.0) {
      std::swap(t[1], t[2]);
      area = -area;
    }
    const auto [low_x, high_x] = std::minmax({t[0].x, t[1].x, t[2].x});
    const auto [low_y, high_y] = std::minmax({t[0].y, t[1].y, t[2].y});
    const auto columns = pixels(low_x - left_m, high_x - left_m, heights.width());
    const auto rows = pixels(top_m - high_y, top_m - low_y, heights.height());
    for (int j = std::max(rows.first, first_row); j < std::min(rows.second, last_row); ++j)
      for (int i = columns.first; i < columns.second; ++i) {
        const double x = x_m(i), y = y_m(j);
        const double a = edge(t[1], t[2], x, y), b = edge(t[2], t[0], x, y), c = edge(t[0], t[1], x, y);
        if (!(a >= 0.0 && b >= 0.0 && c >= 0.0)) continue;
        const auto z = static_cast<float>((a * t[0].z + b * t[1].z + c * t[2].z) / (a + b + c));
        float& clamped = heights(i, j);
        if (!(clamped >= z)) clamped = z;
      }
  }
};

/// The sheet's rim is not compared: that it ends in a ramp to the base is no error of the sheet.
SheetRamps ramps_between(const Raster<float>& before, const Raster<float>& after, const Raster<float>& sheet,
                         int rim) {
  SheetRamps ramps;
  std::size_t all = 0, changed = 0;
  const auto is_inside = [&](int x, int y) {
    for (const Pixel p :
         {Pixel{x, y}, Pixel{x - rim, y}, Pixel{x + rim, y}, Pixel{x, y - rim}, Pixel{x, y + rim}})
      if (sheet.contains(p.x, p.y) && std::isnan(sheet(p.x, p.y))) return false;
    return true;
  };
  for (int y = 0; y < before.height(); ++y)
    for (int x = 0; x < before.width(); ++x) {
      if (!is_inside(x, y)) continue;
      ++all;
      const double change_m = std::abs(double{after(x, y)} - double{before(x, y)});
      changed += change_m > SheetRamps::kFelt_m ? 1 : 0;
      ramps.most_m = std::max(ramps.most_m, change_m);
    }
  ramps.share = all == 0 ? 0.0 : static_cast<double>(changed) / static_cast<double>(all);
  return ramps;
}

}  // namespace

std::vector<Parameter> parameters_of(SheetOptions& o) {
  return {
      {"samples_on_a_side", &o.samples_on_a_side, {2, 4096}, "", "samples along the longer side"},
      {"thickness_m", &o.thickness_m, {0.0, 0.01}, "m", "height of the sheet's lowest point above the base"},
      {"steepest_slope", &o.steepest_slope, {0.1, 100.0}, "", "the steepest slope, rise over run"},
      {"least_facing", &o.least_facing, {0.5, 1.0}, "", "mean facing beyond which a mesh is an open sheet"},
      {"faces_one_way", &o.faces_one_way, {0.0, 1.0}, "", "mean facing beyond which that side is seen"}};
}

Vec3 mean_facing(const Mesh& mesh) {
  Vec3 sum;
  double area = 0.0;
  for (const auto& triangle : mesh.triangles)
    if (const auto t = corners_of(mesh, triangle)) {
      const Vec3 twice = cross((*t)[1] - (*t)[0], (*t)[2] - (*t)[0]);
      sum += twice;
      area += norm(twice);
    }
  return area > 0.0 ? sum / area : Vec3{};
}

bool is_open_sheet(const Mesh& mesh, const SheetOptions& options) {
  constexpr double kFlat = 1e-6;
  const auto extent = extent_of(mesh);
  if (!extent) return false;
  const Vec3 size = extent->most_m - extent->least_m;
  const double longest = std::max({size.x, size.y, size.z});
  return std::min({size.x, size.y, size.z}) <= kFlat * longest ||
         norm(mean_facing(mesh)) > options.least_facing;
}

Result<Raster<float>> heights_from_above(const Mesh& mesh, double left_m, double top_m, double pixel_m,
                                         int width, int height, const Work& work) {
  Raster<float> heights(width, height, std::numeric_limits<float>::quiet_NaN());
  const TriangleRasteriser rasteriser{heights, left_m, top_m, pixel_m};
  // Each thread has its own rows. The greatest height does not depend on the order of triangles.
  constexpr int kRows = 64;
  parallel_for(work, height, kRows, [&](int begin, int end) {
    for (const auto& triangle : mesh.triangles)
      if (const auto corners = corners_of(mesh, triangle)) rasteriser.to(*corners, begin, end);
  });
  if (work.cancelled()) return Work::interrupted();
  return heights;
}

Result<models::Relief> relief_from_sheet(const Mesh& mesh, const SheetOptions& options, const Work& work,
                                         SheetRamps* ramps) {
  if (const auto valid = check_ranges(options); !valid) return valid.error();
  const auto extent = extent_of(mesh);
  if (!extent) return invalid_input("is a mesh without a finite triangle");
  const double half_x = std::max(std::abs(extent->least_m.x), std::abs(extent->most_m.x)),
               half_y = std::max(std::abs(extent->least_m.y), std::abs(extent->most_m.y));
  if (!(half_x > 0.0 && half_y > 0.0)) return invalid_input("is a mesh that is seen edge-on from above");
  const double pixel_m = 2.0 * std::max(half_x, half_y) / options.samples_on_a_side;
  const auto count = [&](double half) {
    return std::max(2, static_cast<int>(std::ceil(2.0 * half / pixel_m - 1e-9)));
  };
  const int width = count(half_x), height = count(half_y);
  work.report(0.1, "casting rays from above");
  auto heights =
      heights_from_above(mesh, -0.5 * width * pixel_m, 0.5 * height * pixel_m, pixel_m, width, height, work);
  if (!heights) return heights.error();
  const Raster<float> sheet = ramps != nullptr ? *heights : Raster<float>();
  const double lift_m = options.thickness_m - extent->least_m.z;
  for (float& z : heights->values()) z = std::isnan(z) ? 0.0F : static_cast<float>(z + lift_m);
  work.report(0.8, "limiting slopes");
  const Raster<float> before = ramps != nullptr ? *heights : Raster<float>();
  models::limit_slope(*heights, pixel_m, options.steepest_slope);
  if (ramps != nullptr) {
    const double reach_m = (extent->most_m.z + lift_m) / options.steepest_slope;
    *ramps = ramps_between(before, *heights, sheet, static_cast<int>(std::ceil(reach_m / pixel_m)));
  }
  return models::Relief::from_samples(*std::move(heights), pixel_m);
}

}  // namespace palpable::sculpt
