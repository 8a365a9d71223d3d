// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/formats/tactile/braille_page.hpp"
#include "palpable/formats/tactile/line_spacing.hpp"
#include "palpable/formats/tactile/tactile_sheet.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

namespace palpable::formats {
namespace {

/// Whether a key fits there with a blank cell before and after it.
bool has_room(const BraillePage& page, const BrailleLine& key, int column, int row) {
  for (int k = -1; k <= static_cast<int>(key.size()); ++k)
    if (!page.is_free(column + k, row)) return false;
  return true;
}

/// Writes a stroke's key near its longest line.
bool write_beside(BraillePage& page, const SheetStroke& stroke, const BrailleView& view) {
  constexpr std::array kParts{0.5, 0.4, 0.6, 0.3, 0.7, 0.2, 0.8};
  const int length = static_cast<int>(stroke.key.size());
  for (const Polyline& line : stroke.lines)
    for (const double part : kParts) {
      const Vec3 at =
          line.points[static_cast<std::size_t>(part * static_cast<double>(line.points.size() - 1))];
      const int column = page.column_of(view.right_m(at.x)), row = page.row_of(view.down_m(at.y));
      for (const auto& [right, down] : {std::pair{2, 0}, {-1 - length, 0}, {0, -1}, {0, 1}, {1, -1}, {1, 1}})
        if (has_room(page, stroke.key, column + right, row + down)) {
          page.write(column + right, row + down, stroke.key);
          return true;
        }
    }
  return false;
}

/// Writes a place's key into the nearest free cells: in its region if there is room, else near it.
bool write_near(BraillePage& page, const SheetPlace& place, const BrailleView& view,
                const BrailleOptions& options) {
  constexpr double kFarther = 1e3;
  const double reach_m = key_reach_m(std::hypot(page.width_m(), page.height_m()));
  const Vec3 at{view.right_m(place.at.x), view.down_m(place.at.y), 0.0};
  double least = kFarther * kFarther;
  std::optional<std::pair<int, int>> best;
  for (int row = 0; row < options.rows; ++row)
    for (int column = 0; column < options.columns; ++column) {
      const double width_m = static_cast<double>(place.key.size()) * options.cell_m;
      const Vec3 middle{column * options.cell_m + 0.5 * width_m, row * options.line_m + options.dot_m, 0.0};
      const double distance_m = norm(middle - at);
      const bool is_inside =
          place.contains && place.contains({(middle.x - view.middle_right_m) / view.scale,
                                            (view.middle_down_m - middle.y) / view.scale, 0.0});
      if (!is_inside && distance_m > reach_m) continue;
      const double cost = is_inside ? distance_m : distance_m + kFarther;
      if (cost >= least || !has_room(page, place.key, column, row)) continue;
      least = cost;
      best = {column, row};
    }
  if (best) page.write(best->first, best->second, place.key);
  return best.has_value();
}

/// The strokes' lines, two dots apart if that is asked for.
std::vector<Polyline> dotted_lines(const TactileSheet& sheet, const BraillePage& page,
                                   const BrailleOptions& options) {
  auto lines = lines_of(sheet);
  if (options.spacing == LineSpacing::as_they_are) return lines;
  // The widest distance of two dots is that between lines of text.
  const double widest_m = std::max(options.cell_m - options.dot_m, options.line_m - 2.0 * options.dot_m);
  const double scale = std::min(page.width_m() / sheet.width_m, page.height_m() / sheet.height_m);
  std::vector<Polyline> apart;
  for (auto& pieces : spaced_lines(lines, (widest_m + options.dot_m) / scale))
    apart.insert(apart.end(), pieces.begin(), pieces.end());
  return apart;
}

}  // namespace

Result<SheetDrawing> encode_braille_sheet(const TactileSheet& sheet, const std::vector<BrailleLine>& lines,
                                          const BrailleOptions& options) {
  if (auto checked = check_braille(options); !checked) return checked.error();
  BraillePage page(options);
  const BrailleView view =
      draw_dots(page, dotted_lines(sheet, page, options), sheet.width_m, sheet.height_m, options);
  SheetDrawing out;
  std::size_t key = 0;
  for (const SheetStroke& stroke : sheet.strokes) {
    if (stroke.key.empty()) continue;
    if (!write_beside(page, stroke, view)) out.without_room.push_back(key);
    ++key;
  }
  for (const SheetPlace& place : sheet.places) {
    if (!write_near(page, place, view, options)) out.without_room.push_back(key);
    ++key;
  }
  out.text = page.text() + braille_text(lines, options);
  return out;
}

}  // namespace palpable::formats
