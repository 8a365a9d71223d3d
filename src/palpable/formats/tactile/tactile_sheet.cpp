// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/formats/tactile/tactile_sheet.hpp"

#include "palpable/core/geometry/segment.hpp"
#include "palpable/formats/tactile/braille_page.hpp"
#include "palpable/formats/tactile/label_space.hpp"
#include "palpable/formats/tactile/line_spacing.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include <fmt/format.h>

namespace palpable::formats {
namespace {

/// The title of the sheets of keys.
constexpr const char* kKeyTitle = "Key of a tactile drawing";

constexpr double kInMm = 1000.0;

std::string svg_begin(double width_mm, double height_mm, const std::string& title) {
  return fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.3f}mm\" height=\"{1:.3f}mm\" viewBox=\"0 0 "
      "{0:.3f} {1:.3f}\">\n<title>{2}</title>\n<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n",
      width_mm, height_mm, title);
}

/// Dots of braille cells whose first dot is at a place of the sheet, mm.
void add_dots(std::string& svg, const BrailleLine& cells, double left_mm, double top_mm,
              const SheetOptions& options) {
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
                                    const std::vector<SheetStroke>& streets, double half_height_m,
                                    const SheetOptions& options) {
  const double pitch_m = 1.5 * options.gap_m, step_m = 0.001, least_m = options.gap_m;
  const double clear_m = 0.5 * options.line_m + options.gap_m;
  const auto is_clear = [&](Vec3 p) {
    return std::none_of(streets.begin(), streets.end(), [&](const SheetStroke& street) {
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

Result<void> check(const SheetOptions& o) {
  if (!(o.paper || (o.width_m >= 0.01 && o.width_m <= 1.0)))
    return Error{ErrorCode::usage, "a printed drawing must be 10 to 1000 mm wide", {}};
  for (const double length_m : {o.line_m, o.gap_m, o.dot_diameter_m, o.dot_m, o.cell_m, o.row_m})
    if (!(length_m >= 0.0005 && length_m <= 0.02))
      return Error{ErrorCode::usage, "lines, gaps and braille of a drawing must be 0.5 to 20 mm", {}};
  return {};
}

/// The strokes at the size of the sheet, as far apart as the options say.
std::vector<SheetStroke> strokes_on_paper(const TactileSheet& sheet, double factor,
                                          const SheetOptions& options) {
  std::vector<SheetStroke> strokes;
  std::vector<Polyline> lines;
  for (const SheetStroke& stroke : sheet.strokes) {
    strokes.push_back({{}, stroke.key, stroke.weight});
    for (const Polyline& line : stroke.lines) {
      strokes.back().lines.push_back(scaled(line, factor));
      lines.push_back(strokes.back().lines.back());
    }
  }
  if (options.spacing == LineSpacing::as_they_are) return strokes;
  // Lines may be a little nearer to each other than braille, which is read.
  constexpr double kOfGap = 0.8;
  const auto spaced = spaced_lines(lines, options.line_m + kOfGap * options.gap_m);
  auto next = spaced.begin();
  for (SheetStroke& stroke : strokes) {
    std::vector<Polyline> pieces;
    for (std::size_t k = 0; k < stroke.lines.size(); ++k, ++next)
      pieces.insert(pieces.end(), next->begin(), next->end());
    stroke.lines = std::move(pieces);
  }
  return strokes;
}

/// A sheet's text; places in metres from its middle.
class SheetSvg {
 public:
  SheetSvg(double width_m, double height_m, const std::string& title)
      : text_(svg_begin(kInMm * width_m, kInMm * height_m, title)),
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
    text_ += line.closed ? "Z\"/>\n" : "\"/>\n";
  }
  void add_disc(Vec3 middle, double radius_m) {
    text_ += fmt::format("<circle cx=\"{:.3f}\" cy=\"{:.3f}\" r=\"{:.3f}\"/>\n", right_mm(middle.x),
                         down_mm(middle.y), kInMm * radius_m);
  }
  /// `first`: the centre of the dot at the upper left.
  void add_key(const BrailleLine& key, Vec3 first, const SheetOptions& options) {
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

void add_strokes(const std::vector<SheetStroke>& strokes, double line_m, SheetSvg& svg, LabelSpace& space) {
  for (std::size_t i = 0; i < strokes.size(); ++i) {
    if (strokes[i].lines.empty()) continue;
    const double width_m = strokes[i].weight * line_m;
    svg.begin_lines(width_m);
    for (const Polyline& line : strokes[i].lines) {
      svg.add_line(line);
      space.add_line(line, 0.5 * width_m, i);
    }
    svg.end_group();
  }
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

/// The size of a key with its dots.
struct KeyBox {
  double width_m, height_m;
};
KeyBox box_of(const BrailleLine& key, const SheetOptions& o) {
  return {static_cast<double>(key.size() - 1) * o.cell_m + o.dot_m + o.dot_diameter_m,
          2.0 * o.dot_m + o.dot_diameter_m};
}

void add_key_at(Vec3 middle, const BrailleLine& key, const SheetOptions& options, SheetSvg& svg) {
  const KeyBox box = box_of(key, options);
  const double edge_m = 0.5 * options.dot_diameter_m;
  svg.add_key(key, {middle.x - 0.5 * box.width_m + edge_m, middle.y + 0.5 * box.height_m - edge_m, 0.0},
              options);
}

/// Returns how many keys strokes have; those that find no room are added to `without_room`.
std::size_t add_stroke_keys(const std::vector<SheetStroke>& strokes, const SheetOptions& options,
                            SheetSvg& svg, LabelSpace& space, std::vector<std::size_t>& without_room) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < strokes.size(); ++i) {
    const BrailleLine& key = strokes[i].key;
    if (key.empty()) continue;
    const KeyBox box = box_of(key, options);
    const auto middle = space.take_room(strokes[i].lines, 0.5 * strokes[i].weight * options.line_m, i,
                                        box.width_m, box.height_m);
    if (middle)
      add_key_at(*middle, key, options, svg);
    else
      without_room.push_back(count);
    ++count;
  }
  return count;
}

/// Keys of places in their regions, or beside their points, which get their marks before any key.
void add_places(const TactileSheet& sheet, double factor, std::size_t first, const SheetOptions& options,
                SheetSvg& svg, LabelSpace& space, std::vector<std::size_t>& without_room) {
  constexpr double kMark_m = 0.004;
  for (const SheetPlace& place : sheet.places)
    if (place.mark == SheetPlace::Mark::disc) {
      svg.add_disc(factor * place.at, 0.5 * kMark_m);
      const double kept_m = kMark_m + 2.0 * options.gap_m;
      space.block(factor * place.at, kept_m, kept_m);
    }
  const double whole_m = factor * std::hypot(sheet.width_m, sheet.height_m);
  const double reach_m = key_reach_m(whole_m);
  for (std::size_t k = 0; k < sheet.places.size(); ++k) {
    const SheetPlace& place = sheet.places[k];
    const KeyBox box = box_of(place.key, options);
    const auto is_inside = [&](Vec3 middle) {
      for (const double x : {-0.5, 0.0, 0.5})
        for (const double y : {-0.5, 0.0, 0.5})
          if (!place.contains((1.0 / factor) * (middle + Vec3{x * box.width_m, y * box.height_m, 0.0})))
            return false;
      return true;
    };
    std::optional<Vec3> middle;
    if (place.contains)
      middle = space.take_room_near(factor * place.at, whole_m, box.width_m, box.height_m, is_inside);
    if (!middle)
      middle = space.take_room_near(factor * place.at, reach_m, box.width_m, box.height_m,
                                    [](Vec3) { return true; });
    if (middle)
      add_key_at(*middle, place.key, options, svg);
    else
      without_room.push_back(first + k);
  }
}

constexpr double kMargin_m = 0.015;

/// Between the border of the paper and the drawing: no ink of its outermost lines, the widest of which are
/// half as wide again, enters the margin.
double border_m(const SheetOptions& options) { return kMargin_m + 0.5 * 1.5 * options.line_m; }

}  // namespace

double key_reach_m(double diagonal_m) {
  constexpr double kReach_m = 0.025, kOnA4_m = 0.322;
  return kReach_m * std::max(1.0, diagonal_m / kOnA4_m);
}

double printed_width_m(double width, double height, const SheetOptions& options) {
  if (!options.paper) return options.width_m;
  const PaperSize paper = paper_for(*options.paper, width, height, border_m(options));
  return std::min(paper.width_m - 2.0 * border_m(options),
                  (paper.height_m - 2.0 * border_m(options)) * width / height);
}

Result<SheetDrawing> encode_sheet(const TactileSheet& sheet, const SheetOptions& options) {
  if (auto checked = check(options); !checked) return checked.error();
  const double width_m = printed_width_m(sheet.width_m, sheet.height_m, options);
  const double factor = width_m / sheet.width_m, height_m = factor * sheet.height_m;
  const PaperSize paper = options.paper ? paper_for(*options.paper, width_m, height_m, border_m(options))
                                        : PaperSize{width_m, height_m};
  const auto strokes = strokes_on_paper(sheet, factor, options);
  std::vector<Polyline> waters;
  for (const Polyline& water : sheet.waters) waters.push_back(scaled(water, factor));

  SheetSvg svg(paper.width_m, paper.height_m, sheet.title);
  LabelSpace space(width_m, height_m, options.gap_m);
  add_strokes(strokes, options.line_m, svg, space);
  if (!waters.empty())
    add_waters(water_strokes(waters, strokes, 0.5 * height_m, options), options.gap_m, svg, space);
  SheetDrawing out;
  svg.begin_dots();
  const std::size_t keys = add_stroke_keys(strokes, options, svg, space, out.without_room);
  add_places(sheet, factor, keys, options, svg, space, out.without_room);
  svg.end_group();
  out.text = std::move(svg).finish();
  return out;
}

std::vector<Polyline> lines_of(const TactileSheet& sheet) {
  std::vector<Polyline> lines;
  for (const SheetStroke& stroke : sheet.strokes)
    lines.insert(lines.end(), stroke.lines.begin(), stroke.lines.end());
  return lines;
}

std::vector<std::string> encode_key_sheets(const std::vector<BrailleLine>& lines,
                                           const SheetOptions& options) {
  constexpr double kWidth_m = 0.210, kHeight_m = 0.297;
  const int columns = whole_steps(kWidth_m - 2.0 * kMargin_m, options.cell_m);
  const auto rows = static_cast<std::size_t>(whole_steps(kHeight_m - 2.0 * kMargin_m, options.row_m));
  const auto all = wrapped(lines, columns);
  std::vector<std::string> pages;
  for (std::size_t begin = 0; begin < all.size(); begin += rows) {
    std::string svg = svg_begin(kInMm * kWidth_m, kInMm * kHeight_m, kKeyTitle);
    svg += "<g fill=\"black\">\n";
    for (std::size_t k = begin; k < std::min(all.size(), begin + rows); ++k)
      add_dots(svg, all[k], kInMm * kMargin_m,
               kInMm * (kMargin_m + static_cast<double>(k - begin) * options.row_m), options);
    pages.push_back(svg + "</g>\n</svg>\n");
  }
  return pages;
}

bool is_key_sheet(std::string_view svg) {
  return svg.starts_with("<svg ") && svg.find("<title>Key of a ") != svg.npos;
}

}  // namespace palpable::formats
