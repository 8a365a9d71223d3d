// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/formats/tactile/braille_page.hpp"

#include "palpable/formats/tactile/walked_line.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace palpable::formats {
namespace {

/// The cell, and the dot in it, nearest to a position on an axis.
std::pair<int, int> nearest_dot(double at_m, double pitch_m, double dot_m, int dots, int cells) {
  std::pair<int, int> best{0, 0};
  double least = 1e9;
  const int near = static_cast<int>(at_m / pitch_m);
  for (int cell = std::max(0, near - 1); cell <= std::min(cells - 1, near + 1); ++cell)
    for (int dot = 0; dot < dots; ++dot)
      if (const double off = std::abs(cell * pitch_m + dot * dot_m - at_m); off < least) {
        least = off;
        best = {cell, dot};
      }
  return best;
}

/// Whether a line may be divided before cell `k` of a word: not within a sign of several cells, which begins
/// with dots of the right column alone (capital, accent and other prefixes), or within a number.
bool may_divide(const BrailleLine& line, std::size_t k) {
  constexpr unsigned kLeft = 0b000111;
  constexpr BrailleCell kNumberSign = 0b111100, kAccent = 0b011000;
  const auto is_prefix = [](BrailleCell cell) { return cell != 0 && (cell & kLeft) == 0; };
  if (is_prefix(line[k - 1]) || (k > 1 && line[k - 2] == kAccent)) return false;
  std::size_t begin = k;
  while (begin > 0 && line[begin - 1] != 0 && line[begin - 1] != kNumberSign) --begin;
  if (begin == 0 || line[begin - 1] != kNumberSign) return true;
  // Digits are the letters a to j, in the upper rows; a number has commas and points.
  constexpr BrailleCell kLow = 0b100100, kComma = 0b000010, kPoint = 0b110010;
  const auto is_of_number = [](BrailleCell cell) {
    return (cell != 0 && (cell & kLow) == 0) || cell == kComma || cell == kPoint;
  };
  for (std::size_t i = begin; i <= k; ++i)
    if (!is_of_number(line[i])) return true;
  return false;
}

bool within(double value, double least, double most) { return value >= least && value <= most; }

/// The last of the places from `most` down that suits; `least` if none above it does.
template <class Suits>
std::size_t last_end(std::size_t most, std::size_t least, const Suits& suits) {
  std::size_t end = most;
  while (end > least && !suits(end)) --end;
  return end;
}

}  // namespace

BraillePage::BraillePage(const BrailleOptions& options)
    : options_(options),
      cells_(static_cast<std::size_t>(options.columns) * static_cast<std::size_t>(options.rows)) {}

std::size_t BraillePage::index_of(int column, int row) const {
  return static_cast<std::size_t>(row) * static_cast<std::size_t>(options_.columns) +
         static_cast<std::size_t>(column);
}

void BraillePage::raise(double right_m, double down_m) {
  const auto [column, dot_column] =
      nearest_dot(right_m, options_.cell_m, options_.dot_m, 2, options_.columns);
  const auto [row, dot_row] = nearest_dot(down_m, options_.line_m, options_.dot_m, 3, options_.rows);
  cells_[index_of(column, row)] |=
      static_cast<BrailleCell>(1U << static_cast<unsigned>(3 * dot_column + dot_row));
}

bool BraillePage::is_free(int column, int row) const {
  return column >= 0 && row >= 0 && column < options_.columns && row < options_.rows &&
         cells_[index_of(column, row)] == 0;
}

void BraillePage::write(int column, int row, const BrailleLine& cells) {
  for (std::size_t k = 0; k < cells.size(); ++k)
    cells_[index_of(column + static_cast<int>(k), row)] = cells[k];
}

int BraillePage::column_of(double right_m) const {
  return std::clamp(static_cast<int>(std::lround(right_m / options_.cell_m)), 0, options_.columns - 1);
}

int BraillePage::row_of(double down_m) const {
  return std::clamp(static_cast<int>(std::lround(down_m / options_.line_m)), 0, options_.rows - 1);
}

std::string BraillePage::text() const {
  std::string out;
  for (int row = 0; row < options_.rows; ++row) {
    std::string line = braille_ascii(
        std::span(cells_).subspan(index_of(0, row), static_cast<std::size_t>(options_.columns)));
    line.erase(line.find_last_not_of(' ') + 1);
    out += line + "\r\n";
  }
  return out + "\f";
}

BrailleView draw_dots(BraillePage& page, std::span<const Polyline> lines, double width_m, double height_m,
                      const BrailleOptions& options) {
  const BrailleView view{std::min(page.width_m() / width_m, page.height_m() / height_m), 0.5 * page.width_m(),
                         0.5 * page.height_m()};
  for (const Polyline& line : lines)
    walk_along(line, 0.25 * options.dot_m / view.scale,
               [&](Vec3 p) { page.raise(view.right_m(p.x), view.down_m(p.y)); });
  return view;
}

Result<void> check_braille(const BrailleOptions& options) {
  if (options.columns < 10 || options.columns > 100 || options.rows < 5 || options.rows > 100)
    return Error{ErrorCode::usage, "a braille page must have 10 to 100 columns and 5 to 100 rows", {}};
  for (const double distance : {options.dot_m, options.cell_m, options.line_m})
    if (!within(distance, 0.001, 0.02))
      return Error{ErrorCode::usage, "the distances of braille dots must be 1 to 20 mm", {}};
  return {};
}

std::vector<BrailleLine> wrapped(const std::vector<BrailleLine>& lines, int columns) {
  constexpr std::size_t kIndent = 2;
  const auto most = static_cast<std::size_t>(columns);
  std::vector<BrailleLine> out;
  for (BrailleLine rest : lines) {
    while (rest.size() > most) {
      // The last blank that leaves more than the indent before it; a long word is divided between signs.
      std::size_t end = last_end(most, kIndent, [&](std::size_t k) { return rest[k] == 0; });
      if (end == kIndent) end = last_end(most, kIndent, [&](std::size_t k) { return may_divide(rest, k); });
      if (end == kIndent) end = most;
      out.emplace_back(rest.begin(), rest.begin() + static_cast<std::ptrdiff_t>(end));
      const std::size_t next = rest[end] == 0 ? end + 1 : end;
      BrailleLine further(kIndent, 0);
      further.insert(further.end(), rest.begin() + static_cast<std::ptrdiff_t>(next), rest.end());
      rest = std::move(further);
    }
    out.push_back(std::move(rest));
  }
  return out;
}

std::string braille_text(const std::vector<BrailleLine>& lines, const BrailleOptions& options) {
  std::string text;
  const auto rows = static_cast<std::size_t>(options.rows);
  const auto all = wrapped(lines, options.columns);
  for (std::size_t begin = 0; begin < all.size(); begin += rows) {
    BraillePage page(options);
    for (std::size_t k = begin; k < std::min(all.size(), begin + rows); ++k)
      page.write(0, static_cast<int>(k - begin), all[k]);
    text += page.text();
  }
  return text;
}

}  // namespace palpable::formats
