// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "map_details.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <pango/pangocairo.h>

namespace palpable::bench {
namespace {

using Random = std::mt19937_64;

double uniform(Random& random, double low, double high) {
  return std::uniform_real_distribution<>(low, high)(random);
}
bool chance(Random& random, double p) { return uniform(random, 0.0, 1.0) < p; }

MapPoint any_place(Random& random, int side) {
  const double x = uniform(random, 0.0, side);
  return {x, uniform(random, 0.0, side)};
}

/// A turned rectangle whose corners are moved a little.
std::vector<MapPoint> any_quad(Random& random, int side, double least_px, double most_px) {
  const MapPoint middle = any_place(random, side);
  const double turn = uniform(random, 0.0, std::numbers::pi);
  const double a = 0.5 * uniform(random, least_px, most_px);
  const double b = 0.5 * uniform(random, least_px, most_px);
  std::vector<MapPoint> out;
  for (const auto [u, v] : {std::array{-a, -b}, {a, -b}, {a, b}, {-a, b}}) {
    const double x = u * uniform(random, 0.8, 1.2);
    const double y = v * uniform(random, 0.8, 1.2);
    out.push_back({middle.x + std::cos(turn) * x - std::sin(turn) * y,
                   middle.y + std::sin(turn) * x + std::cos(turn) * y});
  }
  return out;
}

void fill(cairo_t* cr, const std::vector<MapPoint>& ring, Rgb8 colour, Rgb8 line) {
  add_path(cr, ring);
  cairo_close_path(cr);
  set_colour(cr, colour);
  cairo_fill_preserve(cr);
  set_colour(cr, line);
  cairo_set_line_width(cr, 0.5);
  cairo_set_dash(cr, nullptr, 0, 0.0);
  cairo_stroke(cr);
}

/// Small round trees on a grid.
void draw_trees(cairo_t* cr, const std::vector<MapPoint>& quad, Rgb8 colour) {
  add_path(cr, quad);
  cairo_close_path(cr);
  cairo_save(cr);
  cairo_clip(cr);
  set_colour(cr, colour);
  cairo_set_line_width(cr, 0.8);
  constexpr int kStep_px = 22;
  for (int y = 0; y < 2000; y += kStep_px)
    for (int x = y / kStep_px % 2 * kStep_px / 2; x < 2000; x += kStep_px) {
      cairo_new_path(cr);
      cairo_arc(cr, x, y, 2.5, 0.0, 2.0 * std::numbers::pi);
      cairo_move_to(cr, x, y + 2.5);
      cairo_line_to(cr, x, y + 6.0);
      cairo_stroke(cr);
    }
  cairo_restore(cr);
}

/// The wide pale line and the dashes of a border, bent, across the picture.
void draw_border(cairo_t* cr, int side, Random& random) {
  std::vector<MapPoint> line;
  const double slope = uniform(random, -0.8, 0.8);
  const double at = uniform(random, 0.0, side);
  const double sway = uniform(random, 10.0, 60.0);
  for (int x = -10; x < side + 10; x += 12)
    line.push_back({x * 1.0, at + slope * x + sway * std::sin(x / 90.0)});
  add_path(cr, line);
  cairo_set_source_rgba(cr, 0.55, 0.4, 0.65, 0.35);
  cairo_set_line_width(cr, uniform(random, 4.0, 9.0));
  cairo_set_dash(cr, nullptr, 0, 0.0);
  cairo_stroke(cr);
  stroke(cr, line, {140, 105, 165}, 1.2, {12.0, 3.0, 2.0, 3.0});
}

/// The rim inside of a protected area's border: wide and pale, darker on one side.
void draw_rim(cairo_t* cr, const std::vector<MapPoint>& ring, Rgb8 colour) {
  cairo_save(cr);
  add_path(cr, ring);
  cairo_close_path(cr);
  cairo_clip_preserve(cr);
  set_colour(cr, colour);
  cairo_set_line_width(cr, 12.0);
  cairo_set_dash(cr, nullptr, 0, 0.0);
  cairo_stroke_preserve(cr);
  set_colour(cr, mixed(colour, {150, 130, 250}, 0.3));
  cairo_set_line_width(cr, 4.0);
  cairo_stroke(cr);
  cairo_restore(cr);
}

/// The place and direction after a length of a line.
struct Along {
  MapPoint at;
  double angle = 0.0;
};
Along along(const std::vector<MapPoint>& p, double length) {
  for (std::size_t i = 1; i < p.size(); ++i) {
    const double d = std::hypot(p[i].x - p[i - 1].x, p[i].y - p[i - 1].y);
    if (d > 0.0 && length <= d) {
      const double t = length / d;
      return {{p[i - 1].x + t * (p[i].x - p[i - 1].x), p[i - 1].y + t * (p[i].y - p[i - 1].y)},
              std::atan2(p[i].y - p[i - 1].y, p[i].x - p[i - 1].x)};
    }
    length -= d;
  }
  return {p.back(), 0.0};
}

void draw_arrow(cairo_t* cr, const Along& place, Rgb8 colour) {
  cairo_save(cr);
  cairo_translate(cr, place.at.x, place.at.y);
  cairo_rotate(cr, place.angle);
  set_colour(cr, colour);
  cairo_new_path(cr);
  cairo_rectangle(cr, -5.0, -0.6, 6.0, 1.2);
  cairo_move_to(cr, 1.0, -2.2);
  cairo_line_to(cr, 5.5, 0.0);
  cairo_line_to(cr, 1.0, 2.2);
  cairo_close_path(cr);
  cairo_fill(cr);
  cairo_restore(cr);
}

/// Words in up to two lines, upright, with a pale halo.
void draw_label(cairo_t* cr, MapPoint middle, const char* words, const char* font, double size_px, Rgb8 ink) {
  PangoLayout* layout = pango_cairo_create_layout(cr);
  PangoFontDescription* description = pango_font_description_from_string(font);
  pango_font_description_set_absolute_size(description, size_px * PANGO_SCALE);
  pango_layout_set_font_description(layout, description);
  pango_font_description_free(description);
  pango_layout_set_alignment(layout, PANGO_ALIGN_CENTER);
  pango_layout_set_text(layout, words, -1);
  int width = 0;
  int height = 0;
  pango_layout_get_pixel_size(layout, &width, &height);
  cairo_move_to(cr, middle.x - 0.5 * width, middle.y - 0.5 * height);
  cairo_new_path(cr);
  cairo_move_to(cr, middle.x - 0.5 * width, middle.y - 0.5 * height);
  pango_cairo_layout_path(cr, layout);
  cairo_set_source_rgba(cr, 1.0, 1.0, 1.0, 0.6);
  cairo_set_line_width(cr, 3.0);
  cairo_set_dash(cr, nullptr, 0, 0.0);
  cairo_stroke(cr);
  cairo_move_to(cr, middle.x - 0.5 * width, middle.y - 0.5 * height);
  set_colour(cr, ink);
  pango_cairo_show_layout(cr, layout);
  g_object_unref(layout);
}

bool is_numbered(const std::string& kind) {
  return kind.starts_with("motorway") || kind.starts_with("trunk") || kind.starts_with("primary") ||
         kind.starts_with("secondary");
}

/// The number of a road on a box in a pale shade of its colour, upright.
void draw_plate(cairo_t* cr, MapPoint at, const char* number, const StreetPaint& paint) {
  constexpr double kLetterWidth = 6.5, kHeight = 15.0, kMargin = 8.0;
  const double width = kMargin + kLetterWidth * static_cast<double>(std::string_view(number).size());
  cairo_new_path(cr);
  cairo_rectangle(cr, std::round(at.x - 0.5 * width), std::round(at.y - 0.5 * kHeight), std::round(width),
                  kHeight);
  set_colour(cr, mixed(paint.fill, {255, 255, 255}, 0.5));
  cairo_fill_preserve(cr);
  set_colour(cr, mixed(paint.fill, paint.casing, 0.5));
  cairo_set_dash(cr, nullptr, 0, 0.0);
  cairo_set_line_width(cr, 1.0);
  cairo_stroke(cr);
  draw_label(cr, at, number, "DejaVu Sans Condensed", 10.0, mixed(paint.casing, {0, 0, 0}, 0.5));
}

void draw_bus_stop(cairo_t* cr, MapPoint at, double half_px) {
  set_colour(cr, {0, 146, 218});
  cairo_rectangle(cr, std::round(at.x) - half_px, std::round(at.y) - half_px, 2.0 * half_px, 2.0 * half_px);
  cairo_fill(cr);
}

}  // namespace

void set_colour(cairo_t* cr, Rgb8 c) { cairo_set_source_rgb(cr, c.r / 255.0, c.g / 255.0, c.b / 255.0); }

void add_path(cairo_t* cr, const std::vector<MapPoint>& points) {
  cairo_new_path(cr);
  for (const MapPoint p : points) cairo_line_to(cr, p.x + 0.5, p.y + 0.5);
}

void stroke(cairo_t* cr, const std::vector<MapPoint>& points, Rgb8 colour, double width,
            const std::vector<double>& dashes) {
  add_path(cr, points);
  set_colour(cr, colour);
  cairo_set_line_width(cr, width);
  cairo_set_dash(cr, dashes.data(), static_cast<int>(dashes.size()), 0.0);
  cairo_stroke(cr);
}

Rgb8 mixed(Rgb8 a, Rgb8 b, double part) {
  const auto mix = [part](std::uint8_t u, std::uint8_t v) {
    return static_cast<std::uint8_t>(std::lround((1.0 - part) * u + part * v));
  };
  return {mix(a.r, b.r), mix(a.g, b.g), mix(a.b, b.b)};
}

double length_of(const std::vector<MapPoint>& line) {
  double sum = 0.0;
  for (std::size_t i = 1; i < line.size(); ++i)
    sum += std::hypot(line[i].x - line[i - 1].x, line[i].y - line[i - 1].y);
  return sum;
}

void draw_areas_of_use(cairo_t* cr, const DrawnMapStyle& style, int side, Random& random) {
  struct Use {
    Rgb8 colour, line;
    int count;
    double least_px, most_px;
  };
  const std::array<Use, 6> uses{{{{224, 223, 223}, {185, 185, 185}, 4, 120, 400},
                                 {{255, 214, 209}, {217, 156, 149}, 2, 80, 250},
                                 {{255, 255, 229}, {200, 200, 150}, 2, 60, 180},
                                 {{238, 238, 238}, {180, 180, 190}, 5, 30, 110},
                                 {style.pedestrian.fill, style.pedestrian.casing, 4, 25, 110},
                                 {{205, 235, 176}, {180, 210, 150}, 5, 40, 160}}};
  for (const Use& use : uses)
    for (int i = 0; i < use.count; ++i)
      fill(cr, any_quad(random, side, use.least_px, use.most_px), use.colour, use.line);
  constexpr Rgb8 kWood{173, 209, 158};
  const auto wood = any_quad(random, side, 120.0, 350.0);
  fill(cr, wood, kWood, kWood);
  draw_trees(cr, wood, {125, 170, 115});
  // A quay: an area with a pale rim in the colour of squares.
  const auto quay = any_quad(random, side, 150.0, 400.0);
  fill(cr, quay, style.land, style.land);
  add_path(cr, quay);
  cairo_close_path(cr);
  set_colour(cr, mixed(style.pedestrian.fill, {150, 140, 190}, 0.3));
  cairo_set_line_width(cr, 4.0);
  cairo_stroke(cr);
  for (int i = 0; i < 2; ++i) draw_rim(cr, any_quad(random, side, 150.0, 400.0), style.pedestrian.fill);
}

std::vector<TakenPlace> draw_symbols(cairo_t* cr, const std::vector<ProjectedWay>& ways,
                                     const DrawnMapStyle& style, int side, Random& random) {
  std::vector<TakenPlace> taken;
  const auto take = [&taken](MapPoint middle, double half_x, double half_y) {
    for (double x = -half_x; x <= half_x; x += 6.0)
      for (double y = -half_y; y <= half_y; y += 6.0) taken.push_back({{middle.x + x, middle.y + y}});
  };
  if (chance(random, 0.6)) draw_border(cr, side, random);
  for (const ProjectedWay& w : ways) {
    const double length = length_of(w.points);
    const bool is_main = w.way->kind.starts_with("primary") || w.way->kind.starts_with("secondary");
    const bool is_street = is_main || w.way->kind == "residential" || w.way->kind == "unclassified" ||
                           w.way->kind.starts_with("tertiary") || w.way->kind.starts_with("trunk");
    if (!is_street) continue;
    if (is_main && !w.way->tunnel && length < 60.0 && chance(random, 0.3)) {
      const StreetPaint& paint = paint_of(w.way->kind, style);
      cairo_set_line_cap(cr, CAIRO_LINE_CAP_BUTT);
      stroke(cr, w.points, {0, 0, 0}, paint.width_px + 2.0);
      stroke(cr, w.points, paint.fill, paint.width_px);
    }
    if (chance(random, 0.4))
      for (double u = 30.0; u < length - 10.0; u += uniform(random, 60.0, 160.0)) {
        const Along arrow = along(w.points, u);
        draw_arrow(cr, arrow, {60, 55, 40});
        taken.push_back({arrow.at, 0.9});
      }
    if (length > 40.0 && chance(random, is_main ? 0.5 : 0.12)) {
      const Along stop = along(w.points, 0.5 * length);
      draw_bus_stop(cr, stop.at, style.font_px < 10.0 ? 3.0 : 5.0);
      take(stop.at, 6.0, 6.0);
    }
  }
  constexpr std::array<const char*, 16> kPlaces{
      "Hôtel\nBelvédère", "St. Mary's\nChurch", "Novotel", "Museum",
      "City Library",     "Playhouse\nGardens", "P",       "Restaurant\nSeeblick",
      "Parking\nCentre",  "La Poste",           "17",      "The Annexe",
      "Theatre",          "Pharmacie\ndu Port", "H",       "29"};
  constexpr std::array<Rgb8, 5> kInks{
      {{115, 74, 8}, {0, 146, 218}, {102, 102, 102}, {68, 68, 130}, {0, 0, 0}}};
  constexpr int kLabels = 45;
  for (int i = 0; i < kLabels; ++i) {
    const MapPoint at = any_place(random, side);
    const char* words = kPlaces[std::uniform_int_distribution<std::size_t>(0, kPlaces.size() - 1)(random)];
    const Rgb8 ink = kInks[std::uniform_int_distribution<std::size_t>(0, kInks.size() - 1)(random)];
    const double size = uniform(random, 9.0, 12.0);
    draw_label(cr, at, words, chance(random, 0.3) ? "DejaVu Sans Condensed Oblique" : "DejaVu Sans Condensed",
               size, ink);
    take(at, 32.0, 12.0);
  }
  constexpr std::array<const char*, 4> kQuarters{"Old Town", "Les Moulins", "Nordend", "Harbour"};
  for (const char* quarter : kQuarters) {
    const MapPoint at = any_place(random, side);
    draw_label(cr, at, quarter, "DejaVu Sans Condensed", 14.0, {119, 119, 119});
    take(at, 45.0, 10.0);
  }
  constexpr std::array<const char*, 6> kNumbers{"A64(M)", "A61", "M1", "D 6007", "N 7", "B 312"};
  constexpr double kLeastLength = 70.0;
  for (const ProjectedWay& w : ways) {
    const double length = length_of(w.points);
    if (w.way->tunnel || length < kLeastLength || !is_numbered(w.way->kind) || !chance(random, 0.6)) continue;
    const Along place = along(w.points, uniform(random, 0.3, 0.7) * length);
    const char* number = kNumbers[std::uniform_int_distribution<std::size_t>(0, kNumbers.size() - 1)(random)];
    draw_plate(cr, place.at, number, paint_of(w.way->kind, style));
    take(place.at, 30.0, 12.0);
  }
  return taken;
}

}  // namespace palpable::bench
