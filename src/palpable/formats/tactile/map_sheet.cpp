// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/formats/tactile/map_sheet.hpp"

#include "palpable/core/geometry/segment.hpp"
#include "palpable/formats/tactile/braille_page.hpp"
#include "palpable/formats/tactile/label_space.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <fmt/format.h>

namespace palpable::formats {
namespace {

/// The title of the sheets of keys.
constexpr const char* kKeyTitle = "Key of a street map";

constexpr double kInMm = 1000.0;

std::string svg_begin(double width_mm, double height_mm, const std::string& title) {
  return fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.3f}mm\" height=\"{1:.3f}mm\" viewBox=\"0 0 "
      "{0:.3f} {1:.3f}\">\n<title>{2}</title>\n<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n",
      width_mm, height_mm, title);
}

/// Dots of braille cells whose first dot is at a place of the sheet, mm.
void add_dots(std::string& svg, const BrailleLine& cells, double left_mm, double top_mm,
              const MapSheetOptions& options) {
  for (std::size_t k = 0; k < cells.size(); ++k)
    for (unsigned dot = 0; dot < 6; ++dot) {
      if ((cells[k] >> dot & 1U) == 0) continue;
      svg +=
          fmt::format("<circle cx=\"{:.3f}\" cy=\"{:.3f}\" r=\"{:.3f}\"/>\n",
                      left_mm + kInMm * (static_cast<double>(k) * options.cell_m + (dot / 3) * options.dot_m),
                      top_mm + kInMm * (dot % 3) * options.dot_m, 0.5 * kInMm * options.dot_diameter_m);
    }
}

Polyline scaled(const Polyline& line, double factor) {
  Polyline out = line;
  for (Vec3& p : out.points) p = factor * p;
  return out;
}

/// Where a horizontal line crosses an outline, from left to right.
std::vector<double> crossings_of(const Polyline& outline, double y) {
  std::vector<double> crossings;
  const std::size_t count = outline.points.size();
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3 a = outline.points[i], b = outline.points[(i + 1) % count];
    if ((a.y <= y) == (b.y <= y)) continue;
    crossings.push_back(a.x + (y - a.y) / (b.y - a.y) * (b.x - a.x));
  }
  std::sort(crossings.begin(), crossings.end());
  return crossings;
}

double distance_to(const Polyline& line, Vec3 p) {
  double least = 1e9;
  for (std::size_t i = 1; i < line.points.size(); ++i)
    least = std::min(least, distance_to_segment(p, line.points[i - 1], line.points[i]));
  return least;
}

/// Horizontal strokes in the water that keep the gap from streets; points in metres on the sheet.
std::vector<Polyline> water_strokes(const std::vector<Polyline>& waters,
                                    const std::vector<SheetStreet>& streets, double half_height_m,
                                    const MapSheetOptions& options) {
  const double pitch_m = 1.5 * options.gap_m, step_m = 0.001, least_m = options.gap_m;
  const double clear_m = 0.5 * options.street_m + options.gap_m;
  const auto is_clear = [&](Vec3 p) {
    return std::none_of(streets.begin(), streets.end(), [&](const SheetStreet& street) {
      return std::any_of(street.lines.begin(), street.lines.end(),
                         [&](const Polyline& line) { return distance_to(line, p) < clear_m; });
    });
  };
  std::vector<Polyline> strokes;
  for (const Polyline& water : waters)
    for (double y = half_height_m - 0.5 * pitch_m; y > -half_height_m; y -= pitch_m) {
      const auto crossings = crossings_of(water, y);
      for (std::size_t k = 1; k < crossings.size(); k += 2) {
        Polyline stroke;
        const auto finish = [&] {
          if (stroke.points.size() > 1 && length_of(stroke) >= least_m) strokes.push_back(stroke);
          stroke.points.clear();
        };
        for (double x = crossings[k - 1]; x <= crossings[k]; x += step_m) {
          if (!is_clear({x, y, 0.0})) {
            finish();
          } else if (stroke.points.size() < 2) {
            stroke.points.push_back({x, y, 0.0});
          } else {
            stroke.points.back().x = x;
          }
        }
        finish();
      }
    }
  return strokes;
}

Result<void> check(const MapSheetOptions& o) {
  if (!(o.width_m >= 0.05 && o.width_m <= 1.0))
    return Error{ErrorCode::usage, "a printed map must be 50 to 1000 mm wide", {}};
  for (const double length_m : {o.street_m, o.gap_m, o.dot_diameter_m, o.dot_m, o.cell_m, o.line_m})
    if (!(length_m >= 0.0005 && length_m <= 0.02))
      return Error{ErrorCode::usage, "lines, gaps and braille of a map must be 0.5 to 20 mm", {}};
  return {};
}

/// Writes a street's key into free cells near its longest line, with a blank cell before and after it.
bool write_beside(BraillePage& page, const SheetStreet& street, const BrailleView& view) {
  constexpr std::array kParts{0.5, 0.4, 0.6, 0.3, 0.7, 0.2, 0.8};
  const int length = static_cast<int>(street.key.size());
  const auto has_room = [&](int column, int row) {
    for (int k = -1; k <= length; ++k)
      if (!page.is_free(column + k, row)) return false;
    return true;
  };
  for (const Polyline& line : street.lines)
    for (const double part : kParts) {
      const Vec3 at =
          line.points[static_cast<std::size_t>(part * static_cast<double>(line.points.size() - 1))];
      const int column = page.column_of(view.right_m(at.x)), row = page.row_of(view.down_m(at.y));
      for (const auto& [right, down] : {std::pair{2, 0}, {-1 - length, 0}, {0, -1}, {0, 1}, {1, -1}, {1, 1}})
        if (has_room(column + right, row + down)) {
          page.write(column + right, row + down, street.key);
          return true;
        }
    }
  return false;
}

/// The streets at the size of the sheet.
std::vector<SheetStreet> scaled_streets(const MapSheet& sheet, double factor) {
  std::vector<SheetStreet> streets;
  for (const SheetStreet& street : sheet.streets) {
    streets.push_back({{}, street.key});
    for (const Polyline& line : street.lines) streets.back().lines.push_back(scaled(line, factor));
  }
  return streets;
}

/// A sheet's text; places in metres from its middle.
class SheetSvg {
 public:
  SheetSvg(double width_m, double height_m)
      : text_(svg_begin(kInMm * width_m, kInMm * height_m, "Street map")),
        left_m_(-0.5 * width_m),
        top_m_(0.5 * height_m) {}

  void begin_lines(double line_m) {
    text_ += fmt::format(
        "<g fill=\"none\" stroke=\"black\" stroke-width=\"{:.3f}\" stroke-linejoin=\"round\" "
        "stroke-linecap=\"round\">\n",
        kInMm * line_m);
  }
  void begin_dots() { text_ += "<g fill=\"black\">\n"; }
  void end_group() { text_ += "</g>\n"; }
  void add_line(const Polyline& line) {
    text_ += "<path d=\"";
    for (std::size_t i = 0; i < line.points.size(); ++i)
      text_ += fmt::format("{}{:.3f} {:.3f}", i == 0 ? 'M' : 'L', right_mm(line.points[i].x),
                           down_mm(line.points[i].y));
    text_ += "\"/>\n";
  }
  /// `first`: the centre of the dot at the upper left.
  void add_key(const BrailleLine& key, Vec3 first, const MapSheetOptions& options) {
    add_dots(text_, key, right_mm(first.x), down_mm(first.y), options);
  }
  std::string finish() && {
    text_ += "</svg>\n";
    return std::move(text_);
  }

 private:
  double right_mm(double x) const { return kInMm * (x - left_m_); }
  double down_mm(double y) const { return kInMm * (top_m_ - y); }

  std::string text_;
  double left_m_, top_m_;
};

void add_streets(const std::vector<SheetStreet>& streets, double street_m, SheetSvg& svg, LabelSpace& space) {
  svg.begin_lines(street_m);
  for (std::size_t i = 0; i < streets.size(); ++i)
    for (const Polyline& line : streets[i].lines) {
      svg.add_line(line);
      space.add_line(line, 0.5 * street_m, i);
    }
  svg.end_group();
}

void add_waters(const std::vector<Polyline>& strokes, double gap_m, SheetSvg& svg, LabelSpace& space) {
  constexpr double kStroke_m = 0.0008;
  svg.begin_lines(kStroke_m);
  for (const Polyline& stroke : strokes) {
    svg.add_line(stroke);
    space.block(0.5 * (stroke.points.front() + stroke.points.back()), length_of(stroke) + 2.0 * gap_m,
                2.0 * gap_m);
  }
  svg.end_group();
}

/// Returns the streets whose keys found no room.
std::vector<std::size_t> add_keys(const std::vector<SheetStreet>& streets, const MapSheetOptions& options,
                                  SheetSvg& svg, LabelSpace& space) {
  std::vector<std::size_t> without_room;
  svg.begin_dots();
  for (std::size_t i = 0; i < streets.size(); ++i) {
    const BrailleLine& key = streets[i].key;
    if (key.empty()) continue;
    const double width_m =
        static_cast<double>(key.size() - 1) * options.cell_m + options.dot_m + options.dot_diameter_m;
    const double height_m = 2.0 * options.dot_m + options.dot_diameter_m;
    const auto middle = space.take_room(streets[i].lines, 0.5 * options.street_m, i, width_m, height_m);
    if (!middle) {
      without_room.push_back(i);
      continue;
    }
    const double edge_m = 0.5 * options.dot_diameter_m;
    svg.add_key(key, {middle->x - 0.5 * width_m + edge_m, middle->y + 0.5 * height_m - edge_m, 0.0}, options);
  }
  svg.end_group();
  return without_room;
}

}  // namespace

Result<SheetDrawing> encode_map_sheet(const MapSheet& sheet, const MapSheetOptions& options) {
  if (auto checked = check(options); !checked) return checked.error();
  const double factor = options.width_m / sheet.width_m, height_m = factor * sheet.height_m;
  const auto streets = scaled_streets(sheet, factor);
  std::vector<Polyline> waters;
  for (const Polyline& water : sheet.waters) waters.push_back(scaled(water, factor));

  SheetSvg svg(options.width_m, height_m);
  LabelSpace space(options.width_m, height_m, options.gap_m);
  add_streets(streets, options.street_m, svg, space);
  add_waters(water_strokes(waters, streets, 0.5 * height_m, options), options.gap_m, svg, space);
  SheetDrawing out;
  out.without_room = add_keys(streets, options, svg, space);
  out.text = std::move(svg).finish();
  return out;
}

std::vector<std::string> encode_key_sheets(const std::vector<BrailleLine>& lines,
                                           const MapSheetOptions& options) {
  constexpr double kWidth_m = 0.210, kHeight_m = 0.297, kMargin_m = 0.015;
  const int columns = static_cast<int>((kWidth_m - 2.0 * kMargin_m) / options.cell_m);
  const auto rows = static_cast<std::size_t>((kHeight_m - 2.0 * kMargin_m) / options.line_m);
  const auto all = wrapped(lines, columns);
  std::vector<std::string> pages;
  for (std::size_t begin = 0; begin < all.size(); begin += rows) {
    std::string svg = svg_begin(kInMm * kWidth_m, kInMm * kHeight_m, kKeyTitle);
    svg += "<g fill=\"black\">\n";
    for (std::size_t k = begin; k < std::min(all.size(), begin + rows); ++k)
      add_dots(svg, all[k], kInMm * kMargin_m,
               kInMm * (kMargin_m + static_cast<double>(k - begin) * options.line_m), options);
    pages.push_back(svg + "</g>\n</svg>\n");
  }
  return pages;
}

bool is_key_sheet(std::string_view svg) {
  return svg.starts_with("<svg ") && svg.find(fmt::format("<title>{}</title>", kKeyTitle)) != svg.npos;
}

Result<SheetDrawing> encode_map_braille(const MapSheet& sheet, const std::vector<BrailleLine>& lines,
                                        const BrailleOptions& options) {
  if (auto checked = check_braille(options); !checked) return checked.error();
  BraillePage page(options);
  std::vector<Polyline> all;
  for (const SheetStreet& street : sheet.streets)
    all.insert(all.end(), street.lines.begin(), street.lines.end());
  const BrailleView view = draw_dots(page, all, sheet.width_m, sheet.height_m, options);
  SheetDrawing out;
  for (std::size_t i = 0; i < sheet.streets.size(); ++i) {
    const SheetStreet& street = sheet.streets[i];
    if (street.key.empty()) continue;
    if (!write_beside(page, street, view)) out.without_room.push_back(i);
  }
  out.text = page.text() + braille_text(lines, options);
  return out;
}

}  // namespace palpable::formats
