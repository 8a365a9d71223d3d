// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/draw/view/field_view.hpp"

#include "palpable/draw/canvas/plot.hpp"
#include "palpable/draw/canvas/sheet.hpp"

#include <algorithm>
#include <cmath>
#include <type_traits>
#include <utility>

#include <fmt/format.h>

namespace palpable::draw {
namespace {

using models::DistanceField;

constexpr double kWidth_px = 1000.0;
constexpr double kLeft_px = 92.0;
constexpr double kTop_px = 110.0;
/// The colours saturate at this number of iso-distance lines from the surface.
constexpr double kColourLines = 5.0;

/// Spacing of the iso-distance lines: a round number, 1 mm in a section 100 mm wide.
double line_spacing_mm(const Plot& plot) {
  constexpr double kMostLines = 120.0;
  const double least = (plot.right - plot.left) / kMostLines;
  const double decade = std::pow(10.0, std::floor(std::log10(least)));
  for (const double step : {1.0, 2.0, 5.0})
    if (step * decade >= least) return step * decade;
  return 10.0 * decade;
}

/// Tan inside, pale blue outside, white at the surface; stronger with the distance. `t` is -1 to 1.
Rgb8 distance_colour(double t) {
  const double strength = std::sqrt(std::min(std::abs(t), 1.0));
  const auto mix = [&](double to) {
    return static_cast<std::uint8_t>(std::lround(255.0 + strength * (to - 255.0)));
  };
  return t < 0.0 ? Rgb8{mix(214), mix(178), mix(130)} : Rgb8{mix(196), mix(217), mix(238)};
}
Rgb8 bar_colour(double t) { return distance_colour(2.0 * t - 1.0); }

template <models::DistanceSurface Distance>
Raster<Rgb8> distances(const Distance& field, double y_m, const Plot& plot) {
  Raster<Rgb8> picture(static_cast<int>(plot.area.width) * 2, static_cast<int>(plot.area.height) * 2);
  const double step_m = (plot.right - plot.left) / kMm / picture.width();
  const double spacing_m = line_spacing_mm(plot) / kMm;
  for (int j = 0; j < picture.height(); ++j)
    for (int i = 0; i < picture.width(); ++i) {
      const double x_m = plot.left / kMm + (i + 0.5) * step_m, z_m = plot.top / kMm - (j + 0.5) * step_m;
      const models::FieldSample s = field.sample({{x_m, y_m, z_m}});
      const double d = s.distance_m;
      // Lines have the same width where the surface crosses the plane obliquely.
      constexpr double kLeastSlope = 0.1;
      const double width_m = step_m * std::max(kLeastSlope, std::hypot(s.gradient.v.x, s.gradient.v.z));
      Rgb8 colour = distance_colour(d / (kColourLines * spacing_m));
      const double line = std::round(d / spacing_m);
      const bool near = std::abs(line) <= kColourLines;
      if (near && std::abs(d - spacing_m * line) < 0.6 * width_m) colour = {150, 150, 150};
      // The surface itself is black.
      if (std::abs(d) < 2.0 * width_m) colour = {0, 0, 0};
      picture(i, j) = colour;
    }
  return picture;
}

/// The leaves that the section intersects, if they are large enough to be visible.
void draw_cells(Canvas& canvas, const DistanceField& field, double y_m, const Plot& plot) {
  const models::FieldGrid& grid = field.grid();
  const int y = std::clamp(static_cast<int>((y_m - grid.origin_m.y) / grid.cell_m), 0, grid.cells(1) - 1);
  const double cell_px = kMm * grid.cell_m / (plot.right - plot.left) * plot.area.width;
  constexpr double kLeast_px = 2.5;
  for (int z = 0; z < grid.cells(2); ++z)
    for (int x = 0; x < grid.cells(0);) {
      const DistanceField::Leaf leaf = field.leaf_of(x, y, z);
      if (leaf.corner[2] == z && leaf.side * cell_px >= kLeast_px) {
        const CanvasPoint low = plot.at(kMm * (grid.origin_m.x + grid.cell_m * leaf.corner[0]),
                                        kMm * (grid.origin_m.z + grid.cell_m * (leaf.corner[2] + leaf.side)));
        canvas.frame({low.x, low.y, leaf.side * cell_px, leaf.side * cell_px}, {{40, 40, 40}, 0.4, 0.5});
      }
      x = leaf.corner[0] + leaf.side;
    }
}

/// A dense field's cells are all of one size, too small to be visible.
void draw_cells(Canvas& /*canvas*/, const models::DenseField& /*field*/, double /*y_m*/,
                const Plot& /*plot*/) {}

template <models::DistanceSurface Distance>
void draw_forces(Canvas& canvas, const Distance& field, double y_m, const Plot& plot) {
  constexpr double kArrowsAcross = 25.0, kPixelsALine = 8.0, kLongest_px = 26.0;
  const double spacing_mm = (plot.right - plot.left) / kArrowsAcross;
  for (double z = plot.bottom + 0.5 * spacing_mm; z < plot.top; z += spacing_mm)
    for (double x = plot.left + 0.5 * spacing_mm; x < plot.right; x += spacing_mm) {
      const models::FieldSample s = field.sample({{x / kMm, y_m, z / kMm}});
      // Deeper than the lines reach no hand gets.
      const double lines = -s.distance_m * kMm / line_spacing_mm(plot);
      if (lines <= 0.0 || lines > kColourLines) continue;
      const double length = std::min(kLongest_px, lines * kPixelsALine);
      const CanvasPoint from = plot.at(x, z);
      canvas.arrow(from, {from.x + length * s.gradient.v.x, from.y - length * s.gradient.v.z},
                   {{150, 20, 40}, 1.6});
    }
}

template <models::DistanceSurface Distance>
Figure section_of(std::shared_ptr<const models::SolidField<Distance>> field, double y_m,
                  const FieldSectionOptions& options, const FigureTitle& title) {
  const Vec3 origin = field->distance.origin_m(), size = field->distance.size_m();
  Plot plot;
  plot.left = kMm * origin.x;
  plot.right = kMm * (origin.x + size.x);
  plot.bottom = kMm * origin.z;
  plot.top = kMm * (origin.z + size.z);
  const double height_px = std::clamp(kWidth_px * size.z / size.x, 60.0, 1400.0);
  const double width_px = height_px * size.x / size.z;
  plot.area = {kLeft_px, kTop_px, width_px, height_px};
  const Rect bar{plot.area.right() + 30.0, kTop_px, 18.0, std::clamp(height_px, 60.0, 260.0)};
  const double spacing_mm = line_spacing_mm(plot);
  const double note_y = std::max(plot.area.bottom(), bar.bottom()) + 70.0;
  return {static_cast<int>(bar.right() + 110.0), static_cast<int>(note_y + 60.0),
          [=, field = std::move(field)](Canvas& canvas) {
            draw_title(canvas, title, kLeft_px, kWidth_px);
            canvas.picture(distances(field->distance, y_m, plot), plot.area);
            if (options.cells) draw_cells(canvas, field->distance, y_m, plot);
            draw_forces(canvas, field->distance, y_m, plot);
            draw_axes(canvas, plot, "to the right, mm", "towards the user, mm");
            draw_colour_bar(canvas, bar, -kColourLines * spacing_mm, kColourLines * spacing_mm,
                            "distance, mm", bar_colour);
            const bool has_cells = options.cells && std::is_same_v<Distance, DistanceField>;
            canvas.text(
                fmt::format(
                    "Cut at a height of {} mm. Black: the surface; tan: inside; grey lines: equal distance, "
                    "every {} mm, near the surface; {}arrows: the force of a spring on a point that deep.",
                    label_of(kMm * y_m, 0.1), label_of(spacing_mm, spacing_mm),
                    has_cells ? "thin squares: cells; " : ""),
                {kLeft_px, note_y}, {.size_px = 14.0, .wrap_px = width_px + 60.0});
          }};
}

}  // namespace

Figure field_section_figure(std::shared_ptr<const models::Field> field, double y_m,
                            const FieldSectionOptions& options, const FigureTitle& title) {
  return section_of(std::move(field), y_m, options, title);
}

Figure field_section_figure(std::shared_ptr<const models::FieldOnLattice> field, double y_m,
                            const FieldSectionOptions& options, const FigureTitle& title) {
  return section_of(std::move(field), y_m, options, title);
}

}  // namespace palpable::draw
