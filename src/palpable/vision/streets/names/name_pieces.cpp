// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/streets/names/name_pieces.hpp"

#include "palpable/core/geometry/map_place.hpp"
#include "palpable/vision/text/compared_form.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <span>
#include <string>

namespace palpable::vision {
namespace {

/// In compared form.
constexpr std::array<std::string_view, 41> kBeginnings{
    "rue",   "avenue", "av",     "boulevard", "bd",        "quai",  "chemin", "allee", "allees",
    "place", "ruelle", "square", "impasse",   "promenade", "route", "cours",  "rampe", "bretelle",
    "via",   "viale",  "piazza", "calle",     "plaza",     "de",    "du",     "des",   "d",
    "la",    "le",     "les",    "l",         "am",        "im",    "an",     "auf",   "zum",
    "zur",   "der",    "den",    "sankt",     "st"};
constexpr std::array<std::string_view, 18> kEndings{
    "street", "road",  "lane",     "close",   "avenue", "drive", "terrace", "row", "square",
    "place",  "court", "crescent", "gardens", "walk",   "1er",   "ii",      "iii", "strasse"};

/// Whether all words of a text are among these.
bool has_only(std::string_view text, std::span<const std::string_view> words) {
  bool any = false;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find_first_of(" '-"), text.size());
    const std::string word = compared_form(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
    if (word.empty()) continue;
    any = true;
    if (std::find(words.begin(), words.end(), word) == words.end()) return false;
  }
  return any;
}

struct Heading {
  double x = 0.0;
  double y = 0.0;
};
double size_of_heading(Heading v) { return std::hypot(v.x, v.y); }
double product_of(Heading a, Heading b) { return a.x * b.x + a.y * b.y; }

/// Makes a line run in its reading direction.
void orient(TextLine& line, ReadLine& read) {
  if (read.reversed) std::reverse(line.centre.begin(), line.centre.end());
  read.reversed = false;
}

/// The direction in which a line ends or begins.
Heading heading_at(const TextLine& line, bool end) {
  const auto& p = line.centre;
  const std::size_t reach = std::min(p.size() - 1, static_cast<std::size_t>(1.5 * line.height_px));
  const MapPoint a = end ? p[p.size() - 1 - reach] : p.front();
  const MapPoint b = end ? p.back() : p[reach];
  return {b.x - a.x, b.y - a.y};
}

/// The gap between a piece and the one that is read after it, in heights; nullopt if it does not follow.
std::optional<double> gap_after(const TextLine& a, const TextLine& b, const NamePiecesOptions& options) {
  const double height = std::max(a.height_px, b.height_px);
  if (height > options.most_height_ratio * std::min(a.height_px, b.height_px)) return std::nullopt;
  const Heading out = heading_at(a, true), in = heading_at(b, false);
  const Heading gap{b.centre.front().x - a.centre.back().x, b.centre.front().y - a.centre.back().y};
  const double least = std::cos(options.most_turn_deg * std::numbers::pi / 180.0);
  const bool goes_on = product_of(out, in) >= least * size_of_heading(out) * size_of_heading(in);
  constexpr double kOverlap = 0.5;
  const bool is_ahead = product_of(out, gap) >= -kOverlap * height * size_of_heading(out);
  if (!goes_on || !is_ahead || size_of_heading(gap) > options.most_gap * height) return std::nullopt;
  return size_of_heading(gap) / height;
}

/// The first piece goes on with the second one.
void append_piece(TextLine& a, ReadLine& a_read, const TextLine& b, const ReadLine& b_read) {
  const auto n = static_cast<double>(a_read.text.size()), m = static_cast<double>(b_read.text.size());
  a_read.confidence = (n * a_read.confidence + m * b_read.confidence) / (n + m);
  a_read.text += " " + b_read.text;
  a_read.others.push_back(a_read.text);
  a.centre.insert(a.centre.end(), b.centre.begin(), b.centre.end());
  a.height_px = std::max(a.height_px, b.height_px);
  a.letters += b.letters;
}

/// The words before the last one, if these only begin a name and the last one begins the other words.
std::optional<std::string> beginning_before(std::string_view words, std::string_view other) {
  const std::size_t space = words.rfind(' ');
  if (space == std::string_view::npos) return std::nullopt;
  const std::string_view before = words.substr(0, space);
  const std::string letters = compared_form(words.substr(space + 1));
  const std::string word = compared_form(other.substr(0, other.find(' ')));
  const bool is_begun = !letters.empty() && letters.size() < word.size() && word.starts_with(letters);
  return is_begun && has_only(before, kBeginnings) ? std::optional<std::string>(before) : std::nullopt;
}

/// Lines without a part of their end, of so many letters out of all.
void shorten(TextLine& line, std::size_t letters, std::size_t all) {
  line.centre.resize(std::max<std::size_t>(2, line.centre.size() * (all - letters) / all));
  line.letters = static_cast<int>(static_cast<std::size_t>(line.letters) * (all - letters) / all);
}

/// Leaves out letters of the next words behind words that only begin a name, where the next ones begin beside
/// them.
void remove_next_letters(std::vector<TextLine>& lines, std::vector<ReadLine>& read,
                         const NamePiecesOptions& options) {
  for (std::size_t a = 0; a < lines.size(); ++a)
    for (std::size_t b = 0; b < lines.size(); ++b) {
      const auto before = a == b ? std::nullopt : beginning_before(read[a].text, read[b].text);
      if (!before) continue;
      TextLine shorter = lines[a];
      // Without the gap between the words, as letters are not equally wide.
      shorten(shorter, read[a].text.size() - before->size() - 1, read[a].text.size());
      if (!gap_after(shorter, lines[b], options)) continue;
      lines[a] = std::move(shorter);
      read[a].text = *before;
      break;
    }
}

/// Whether a word is a name of a street by itself, written as one with its word of streets ("Gerberweg").
bool is_compound_name(std::string_view word) {
  constexpr std::size_t kLeastLetters = 7;
  return word.size() >= kLeastLetters && word.find(' ') == std::string_view::npos && is_street_name(word) &&
         !is_piece_of_name(word);
}

}  // namespace

std::vector<Parameter> parameters_of(NamePiecesOptions& o) {
  return {{"most_gap", &o.most_gap, {0, 10}, "heights", "largest gap between pieces of a name"},
          {"most_turn_deg", &o.most_turn_deg, {0, 120}, "degrees", "largest turn between them"},
          {"most_height_ratio", &o.most_height_ratio, {1, 10}, "", "of their heights"}};
}

bool is_piece_of_name(std::string_view words) {
  return has_only(words, kBeginnings) || has_only(words, kEndings);
}

void divide_names_in_row(std::vector<TextLine>& lines, std::vector<ReadLine>& read) {
  const std::size_t count = lines.size();
  for (std::size_t i = 0; i < count; ++i) {
    const std::string text = read[i].text;
    const std::size_t space = text.find(' ');
    if (space == std::string::npos || !is_compound_name(std::string_view(text).substr(0, space)) ||
        !is_compound_name(std::string_view(text).substr(space + 1)))
      continue;
    orient(lines[i], read[i]);
    TextLine rest = lines[i];
    std::reverse(rest.centre.begin(), rest.centre.end());
    shorten(rest, space + 1, text.size());
    std::reverse(rest.centre.begin(), rest.centre.end());
    shorten(lines[i], text.size() - space, text.size());
    ReadLine rest_read = read[i];
    read[i].text = text.substr(0, space);
    rest_read.text = text.substr(space + 1);
    read[i].others = {read[i].text};
    rest_read.others = {rest_read.text};
    lines.push_back(std::move(rest));
    read.push_back(std::move(rest_read));
  }
}

void join_name_pieces(std::vector<TextLine>& lines, std::vector<ReadLine>& read,
                      const NamePiecesOptions& options) {
  for (std::size_t i = 0; i < lines.size(); ++i)
    if (!read[i].text.empty()) orient(lines[i], read[i]);
  remove_next_letters(lines, read, options);
  for (;;) {
    std::optional<double> least;
    std::size_t first = 0, second = 0;
    for (std::size_t a = 0; a < lines.size(); ++a)
      for (std::size_t b = 0; b < lines.size(); ++b) {
        if (a == b || read[a].text.empty() || read[b].text.empty()) continue;
        if (!has_only(read[a].text, kBeginnings) && !has_only(read[b].text, kEndings)) continue;
        const auto gap = gap_after(lines[a], lines[b], options);
        if (!gap || (least && *gap >= *least)) continue;
        least = gap;
        first = a;
        second = b;
      }
    if (!least) return;
    append_piece(lines[first], read[first], lines[second], read[second]);
    lines.erase(lines.begin() + static_cast<std::ptrdiff_t>(second));
    read.erase(read.begin() + static_cast<std::ptrdiff_t>(second));
  }
}

}  // namespace palpable::vision
