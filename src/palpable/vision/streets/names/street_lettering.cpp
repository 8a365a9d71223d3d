// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/streets/names/street_lettering.hpp"

#include "palpable/vision/streets/names/name_pieces.hpp"
#include "palpable/vision/streets/names/street_names.hpp"
#include "palpable/vision/text/compared_form.hpp"
#include "palpable/vision/text/ink.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

namespace palpable::vision {
namespace {

/// A line of a network, and whether it is followed from its last point to its first.
struct LineStep {
  std::size_t line = 0;
  bool back = false;
};

/// Follows streets straight over junctions.
class StraightStreets {
 public:
  StraightStreets(const CentreLines& graph, double end_px, double most_turn_deg)
      : graph_(graph), end_px_(end_px), least_(std::cos(most_turn_deg * std::numbers::pi / 180.0)) {
    at_.resize(graph.nodes.size());
    for (std::size_t i = 0; i < graph.lines.size(); ++i) {
      at_[static_cast<std::size_t>(graph.lines[i].first)].push_back({i, false});
      at_[static_cast<std::size_t>(graph.lines[i].last)].push_back({i, true});
    }
    next_.resize(2 * graph.lines.size());
    for (const auto& here : at_) pair_at(here);
  }

  std::vector<std::vector<MapPoint>> all() {
    std::vector<std::vector<MapPoint>> out;
    std::vector<bool> used(graph_.lines.size(), false);
    // From the ends first; what is left are rings.
    for (const bool rings : {false, true})
      for (std::size_t i = 0; i < graph_.lines.size(); ++i)
        for (const bool back : {false, true})
          if (!used[i] && (rings || !next_[key({i, !back})])) out.push_back(follow({i, back}, used));
    return out;
  }

 private:
  /// The key of a line's end: where it begins if it is followed like this.
  static std::size_t key(LineStep step) { return 2 * step.line + (step.back ? 1 : 0); }

  /// The direction from a line's end into the line.
  MapPoint direction(LineStep end) const {
    const auto& p = graph_.lines[end.line].points;
    const std::size_t far = std::min(p.size() - 1, static_cast<std::size_t>(end_px_));
    const MapPoint a = end.back ? p.back() : p.front();
    const MapPoint b = end.back ? p[p.size() - 1 - far] : p[far];
    const double n = std::max(1e-9, std::hypot(b.x - a.x, b.y - a.y));
    return {(b.x - a.x) / n, (b.y - a.y) / n};
  }

  /// Pairs the lines that meet at a node, the straightest first.
  void pair_at(std::vector<LineStep> here) {
    while (here.size() > 1) {
      double straightest = least_;
      std::optional<std::pair<std::size_t, std::size_t>> best;
      for (std::size_t a = 0; a < here.size(); ++a)
        for (std::size_t b = a + 1; b < here.size(); ++b) {
          const MapPoint u = direction(here[a]);
          const MapPoint v = direction(here[b]);
          const double straight = -(u.x * v.x + u.y * v.y);
          if (straight <= straightest || here[a].line == here[b].line) continue;
          straightest = straight;
          best = {a, b};
        }
      if (!best) return;
      const LineStep a = here[best->first];
      const LineStep b = here[best->second];
      next_[key(a)] = b;
      next_[key(b)] = a;
      std::erase_if(here, [&](LineStep s) { return key(s) == key(a) || key(s) == key(b); });
    }
  }

  std::vector<MapPoint> follow(LineStep step, std::vector<bool>& used) const {
    std::vector<MapPoint> out;
    for (;;) {
      used[step.line] = true;
      std::vector<MapPoint> p = graph_.lines[step.line].points;
      if (step.back) std::reverse(p.begin(), p.end());
      out.insert(out.end(), p.begin() + (out.empty() ? 0 : 1), p.end());
      const auto next = next_[key({step.line, !step.back})];
      if (!next || used[next->line]) return out;
      step = *next;
    }
  }

  const CentreLines& graph_;
  double end_px_;
  double least_;
  std::vector<std::vector<LineStep>> at_;
  std::vector<std::optional<LineStep>> next_;
};

/// The same line with points one pixel apart.
std::vector<MapPoint> even(const std::vector<MapPoint>& line) {
  std::vector<MapPoint> out;
  double rest = 0.0;
  for (std::size_t i = 1; i < line.size(); ++i) {
    const MapPoint a = line[i - 1];
    const double dx = line[i].x - a.x;
    const double dy = line[i].y - a.y;
    const double length = std::hypot(dx, dy);
    double at = rest;
    for (; at < length; at += 1.0) out.push_back({a.x + at / length * dx, a.y + at / length * dy});
    rest = at - length;
  }
  return out;
}

/// Where the picture has ink of the names' colour.
Raster<std::uint8_t> ink_of(const Raster<Rgb8>& picture, const StreetLettering& lettering,
                            const TextLineOptions& ink, const LetteringAlongOptions& options) {
  const cv::Mat contrast = darkness_of(picture, ink.thickest_stroke_px);
  Raster<std::uint8_t> out(picture.width(), picture.height());
  for (int y = 0; y < picture.height(); ++y)
    for (int x = 0; x < picture.width(); ++x) {
      const Rgb8 c = picture(x, y);
      const double difference =
          std::hypot(c.r - lettering.colour.r, c.g - lettering.colour.g, c.b - lettering.colour.b);
      out(x, y) =
          contrast.at<std::uint8_t>(y, x) > ink.contrast && difference <= options.most_colour_difference ? 1
                                                                                                         : 0;
    }
  return out;
}

/// The ink beside a line: for each point its distances from the line, positive to the right.
std::vector<std::vector<int>> ink_beside(const Raster<std::uint8_t>& ink, const std::vector<MapPoint>& line,
                                         int reach, double along_px) {
  std::vector<std::vector<int>> out(line.size());
  const auto back = static_cast<std::size_t>(along_px);
  for (std::size_t i = 0; i < line.size(); ++i) {
    const MapPoint a = line[i - std::min(i, back)];
    const MapPoint b = line[std::min(line.size() - 1, i + back)];
    const double n = std::max(1e-9, std::hypot(b.x - a.x, b.y - a.y));
    for (int v = -reach; v <= reach; ++v) {
      const int x = static_cast<int>(std::lround(line[i].x - v * (b.y - a.y) / n));
      const int y = static_cast<int>(std::lround(line[i].y + v * (b.x - a.x) / n));
      if (ink.contains(x, y) && ink(x, y) != 0) out[i].push_back(v);
    }
  }
  return out;
}

/// The lettering between two points of a line; nullopt if it is not as high as names are.
std::optional<TextLine> lettering_between(const std::vector<MapPoint>& line,
                                          const std::vector<std::vector<int>>& beside, std::size_t first,
                                          std::size_t last, const StreetLettering& lettering,
                                          const LetteringAlongOptions& options) {
  std::vector<int> all;
  for (std::size_t i = first; i <= last; ++i) all.insert(all.end(), beside[i].begin(), beside[i].end());
  std::sort(all.begin(), all.end());
  constexpr double kOutliers = 0.02;
  const auto n = static_cast<double>(all.size() - 1);
  const int low = all[static_cast<std::size_t>(kOutliers * n)];
  const int high = all[static_cast<std::size_t>((1.0 - kOutliers) * n)];
  const double height = high - low + 1.0;
  if (height < options.least_height * lettering.height_px ||
      height > options.most_height * lettering.height_px)
    return std::nullopt;
  TextLine out;
  out.height_px = height;
  out.colour = lettering.colour;
  out.letters = static_cast<int>(static_cast<double>(last - first + 1) / (0.6 * height));
  const double middle = 0.5 * (low + high);
  const auto reach = static_cast<std::size_t>(lettering.height_px);
  for (std::size_t i = first; i <= last; ++i) {
    const MapPoint a = line[i - std::min(i, reach)];
    const MapPoint b = line[std::min(line.size() - 1, i + reach)];
    const double length = std::max(1e-9, std::hypot(b.x - a.x, b.y - a.y));
    out.centre.push_back(
        {line[i].x - middle * (b.y - a.y) / length, line[i].y + middle * (b.x - a.x) / length});
  }
  return out;
}

/// Part of the points of `a` that lie in the lettering of `b`.
double covered_part(const TextLine& a, const TextLine& b) {
  constexpr std::size_t kStep = 2;
  int all = 0;
  int inside = 0;
  for (std::size_t i = 0; i < a.centre.size(); i += kStep, ++all) {
    const MapPoint p = a.centre[i];
    inside += std::any_of(b.centre.begin(), b.centre.end(),
                          [&](MapPoint q) { return std::hypot(p.x - q.x, p.y - q.y) <= 0.5 * b.height_px; });
  }
  return static_cast<double>(inside) / std::max(1, all);
}

/// Lines cover each other if most of one lies in the other.
bool are_same(const TextLine& a, const TextLine& b) {
  constexpr double kMost = 0.5;
  const bool a_is_shorter = a.centre.size() < b.centre.size();
  return covered_part(a_is_shorter ? a : b, a_is_shorter ? b : a) > kMost;
}

/// Lines that hold two other ones, apart from each other and each read more surely: two names beside each
/// other.
std::vector<bool> joined_names(std::span<const TextLine> lines, std::span<const ReadLine> read) {
  std::vector<bool> out(lines.size(), false);
  for (std::size_t i = 0; i < lines.size(); ++i) {
    std::vector<std::size_t> inside;
    for (std::size_t k = 0; k < lines.size() && !out[i]; ++k) {
      if (k == i || read[k].confidence <= read[i].confidence || !is_whole_name(read[k].text) ||
          !are_same(lines[i], lines[k]))
        continue;
      if (lines[k].centre.size() > lines[i].centre.size()) continue;
      out[i] = std::any_of(inside.begin(), inside.end(),
                           [&](std::size_t other) { return !are_same(lines[other], lines[k]); });
      inside.push_back(k);
    }
  }
  return out;
}

/// Whether `longer` says `shorter` with words before or after it that belong to a street's name ("Rue").
bool completes(std::string_view longer, std::string_view shorter) {
  for (std::size_t at = longer.find(' '); at != longer.npos; at = longer.find(' ', at + 1)) {
    const std::string_view before = longer.substr(0, at), after = longer.substr(at + 1);
    const std::string form = compared_form(shorter);
    if ((is_piece_of_name(before) && compared_form(after) == form) ||
        (is_piece_of_name(after) && compared_form(before) == form))
      return true;
  }
  return false;
}

/// A name that another reading of it begins with a capital begins so, too.
void take_capital(ReadLine& read, const ReadLine& other) {
  if (!is_whole_name(read.text) && is_whole_name(other.text) &&
      compared_form(read.text) == compared_form(other.text))
    read.text = other.text;
}

/// Whether a line lies in another one, which is about as long or longer.
bool is_whole_in(const TextLine& name, const TextLine& line) {
  constexpr double kShorter = 0.7;
  return are_same(name, line) && static_cast<double>(line.centre.size()) + kShorter * name.height_px >=
                                     static_cast<double>(name.centre.size());
}

}  // namespace

std::vector<Parameter> parameters_of(LetteringAlongOptions& o) {
  return {{"aside", &o.aside, {0.1, 2}, "heights", "how far ink is from the street's middle"},
          {"most_colour_difference", &o.most_colour_difference, {0, 442}, "levels", "from the names' ink"},
          {"word_gap", &o.word_gap, {0, 5}, "heights", "largest gap between words"},
          {"least_length", &o.least_length, {0, 50}, "heights", "least length of a name"},
          {"least_height", &o.least_height, {0, 1}, "", "least height, of the names'"},
          {"most_height", &o.most_height, {1, 5}, "", "greatest height, of the names'"},
          {"most_turn_deg", &o.most_turn_deg, {0, 90}, "degrees", "turn over which a street goes on"},
          {"smoothing_heights", &o.smoothing_heights, {0, 10}, "heights", "smoothing of the street's line"},
          {"sure", &o.sure, {0, 1}, "", "confidence of lines that are not read again"}};
}

std::vector<TextLine> lettering_along(const Raster<Rgb8>& picture, const CentreLines& graph,
                                      const StreetLettering& lettering, const TextLineOptions& ink,
                                      const LetteringAlongOptions& options) {
  const double height = lettering.height_px;
  const Raster<std::uint8_t> is_ink = ink_of(picture, lettering, ink, options);
  const int reach = static_cast<int>(std::lround(options.aside * height));
  std::vector<TextLine> out;
  for (const auto& street : StraightStreets(graph, 2.0 * height, options.most_turn_deg).all()) {
    const std::vector<MapPoint> line =
        smoothed(even(street), static_cast<int>(options.smoothing_heights * height));
    const auto beside = ink_beside(is_ink, line, reach, height);
    const auto gap = static_cast<std::size_t>(options.word_gap * height);
    for (std::size_t i = 0; i < line.size();) {
      if (beside[i].empty()) {
        ++i;
        continue;
      }
      std::size_t last = i;
      for (std::size_t k = i; k < line.size() && k <= last + gap; ++k)
        if (!beside[k].empty()) last = k;
      if (static_cast<double>(last - i) >= options.least_length * height)
        if (auto name = lettering_between(line, beside, i, last, lettering, options))
          out.push_back(*std::move(name));
      i = last + 1;
    }
  }
  return out;
}

void keep_best_readings(std::vector<TextLine>& lines, std::vector<ReadLine>& read) {
  const auto score = [&](std::size_t i) { return read[i].weight * static_cast<double>(read[i].text.size()); };
  std::vector<bool> gone = joined_names(lines, read);
  for (std::size_t a = 0; a < lines.size(); ++a)
    for (std::size_t b = a + 1; b < lines.size() && !gone[a]; ++b)
      if (!gone[b] && are_same(lines[a], lines[b])) {
        const bool first = completes(read[a].text, read[b].text) ||
                           (score(a) >= score(b) && !completes(read[b].text, read[a].text));
        gone[first ? b : a] = true;
        take_capital(read[first ? a : b], read[first ? b : a]);
      }
  std::size_t kept = 0;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (gone[i]) continue;
    if (kept != i) {
      lines[kept] = std::move(lines[i]);
      read[kept] = std::move(read[i]);
    }
    ++kept;
  }
  lines.resize(kept);
  read.resize(kept);
}

std::vector<TextLine> different_lines(std::vector<TextLine> followed, std::vector<TextLine> along) {
  std::erase_if(along, [&](const TextLine& name) {
    return std::any_of(followed.begin(), followed.end(),
                       [&](const TextLine& line) { return is_whole_in(name, line); });
  });
  std::move(along.begin(), along.end(), std::back_inserter(followed));
  return followed;
}

std::vector<TextLine> unread_lettering(std::vector<TextLine> along, std::span<const TextLine> lines,
                                       std::span<const ReadLine> read, double sure) {
  std::erase_if(along, [&](const TextLine& name) {
    for (std::size_t i = 0; i < lines.size(); ++i)
      if (read[i].confidence >= sure && is_whole_in(name, lines[i])) return true;
    return false;
  });
  return along;
}

}  // namespace palpable::vision
