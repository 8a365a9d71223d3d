// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/models/scene/place_name.hpp"

#include "palpable/core/text/plain_text.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace palpable::models {
namespace {

bool is_within(Place p) {
  // Farther than any scene reaches.
  constexpr double kMost_m = 1e6;
  return std::abs(p.x_m) <= kMost_m && std::abs(p.y_m) <= kMost_m;
}

bool has_line(PlaceName::Extent extent) {
  return extent == PlaceName::Extent::line || extent == PlaceName::Extent::area;
}

/// Without the characters that plain_name() shows as question marks; text that is not UTF-8 is refused.
std::string clean(const std::string& text) {
  const std::string shown = without_control_characters(text);
  if (shown == text) return plain_name(text);
  // Character by character: which ones are replaced is plain_text's knowledge.
  std::string kept;
  for (std::size_t i = 0; i < text.size();) {
    std::size_t end = i + 1;
    while (end < text.size() && (static_cast<unsigned char>(text[end]) & 0xC0U) == 0x80U) ++end;
    const std::string_view character = std::string_view(text).substr(i, end - i);
    if (!has_control_characters(character)) kept += character;
    i = end;
  }
  return plain_name(kept);
}

/// Whether there is anything but blanks and characters that neither are shown nor spoken.
bool says_something(std::string text) {
  // Soft hyphen, zero-width space, non-joiner, joiner, word joiner, byte order mark.
  for (const std::string_view unseen : {"\u00AD", "\u200B", "\u200C", "\u200D", "\u2060", "\uFEFF", " "})
    for (auto at = text.find(unseen); at != std::string::npos; at = text.find(unseen))
      text.erase(at, unseen.size());
  return !text.empty();
}

Error refused(std::string sentence) { return {ErrorCode::usage, std::move(sentence), {}}; }

std::string too_long(const char* what, std::size_t most, std::size_t bytes) {
  return std::string(what) + " has at most " + std::to_string(most) + " bytes, and this one has " +
         std::to_string(bytes);
}

}  // namespace

bool is_valid(const PlaceName& name) {
  const auto is_plain = [](const std::string& words) { return is_utf8(words) && plain_name(words) == words; };
  return !name.name.empty() && name.name.size() <= kMaxPlaceNameBytes && is_plain(name.name) &&
         name.sentence.size() <= kMaxPlaceSentenceBytes && is_plain(name.sentence) && is_within(name.at) &&
         name.line.size() <= kMaxPlaceLine &&
         (has_line(name.extent) ? name.line.size() > 1 : name.line.empty()) &&
         std::all_of(name.line.begin(), name.line.end(), is_within);
}

Result<PlaceNames> with_name(PlaceNames names, PlaceName name, std::optional<std::size_t> replaced) {
  if (!is_utf8(name.name) || !is_utf8(name.sentence)) return refused("a name is text in UTF-8");
  name.name = clean(name.name);
  name.sentence = clean(name.sentence);
  if (!says_something(name.name)) return refused("a name has at least one letter");
  if (name.name.size() > kMaxPlaceNameBytes)
    return refused(too_long("a name", kMaxPlaceNameBytes, name.name.size()));
  if (name.sentence.size() > kMaxPlaceSentenceBytes)
    return refused(too_long("the sentence of a name", kMaxPlaceSentenceBytes, name.sentence.size()));
  if (!is_valid(name)) return refused("a name belongs to a place in the scene");
  constexpr double kSame_m = 1e-6;
  for (std::size_t i = 0; i < names.size(); ++i)
    if (i != replaced && names[i].name == name.name && names[i].extent == name.extent &&
        std::hypot(names[i].at.x_m - name.at.x_m, names[i].at.y_m - name.at.y_m) < kSame_m)
      return refused("this place is called '" + name.name + "' already");
  if (replaced) {
    names.at(*replaced) = std::move(name);
  } else {
    if (names.size() >= kMaxPlaceNames)
      return refused("a scene has at most " + std::to_string(kMaxPlaceNames) + " names");
    names.push_back(std::move(name));
  }
  return names;
}

OnLine nearest_on_line(const std::vector<Place>& line, Place from) {
  OnLine best{std::numeric_limits<double>::infinity(), from};
  const auto take = [&](Place p) {
    if (const double d = std::hypot(p.x_m - from.x_m, p.y_m - from.y_m); d < best.distance_m) best = {d, p};
  };
  if (!line.empty()) take(line.front());
  for (std::size_t i = 1; i < line.size(); ++i) {
    const Place a = line[i - 1], b = line[i];
    const double dx = b.x_m - a.x_m, dy = b.y_m - a.y_m, squared = dx * dx + dy * dy;
    const double t = squared > 0.0
                         ? std::clamp(((from.x_m - a.x_m) * dx + (from.y_m - a.y_m) * dy) / squared, 0.0, 1.0)
                         : 0.0;
    take({a.x_m + t * dx, a.y_m + t * dy});
  }
  return best;
}

OnLine nearest_in_area(const std::vector<Place>& line, Place from) {
  bool inside = false;
  for (std::size_t i = 0, j = line.size() - 1; i < line.size(); j = i++) {
    const Place a = line[i], b = line[j];
    if ((a.y_m > from.y_m) != (b.y_m > from.y_m) &&
        from.x_m < (b.x_m - a.x_m) * (from.y_m - a.y_m) / (b.y_m - a.y_m) + a.x_m)
      inside = !inside;
  }
  if (inside) return {0.0, from};
  const OnLine open = nearest_on_line(line, from);
  const OnLine closing = nearest_on_line({line.back(), line.front()}, from);
  return closing.distance_m < open.distance_m ? closing : open;
}

double area_m2(const std::vector<Place>& line) {
  double doubled = 0.0;
  for (std::size_t i = 0, j = line.size() - 1; i < line.size(); j = i++)
    doubled += line[j].x_m * line[i].y_m - line[i].x_m * line[j].y_m;
  return 0.5 * std::abs(doubled);
}

}  // namespace palpable::models
