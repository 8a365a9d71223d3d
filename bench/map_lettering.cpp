// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "map_lettering.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>

#include "map_details.hpp"
#include <pango/pangocairo.h>

namespace palpable::bench {
namespace {

using Line = std::vector<MapPoint>;

double distance(MapPoint a, MapPoint b) { return std::hypot(a.x - b.x, a.y - b.y); }

/// The ways of each name, joined where they end at each other.
std::map<std::string, std::vector<Line>> lines_by_name(const std::vector<DrawnWay>& ways) {
  std::map<std::string, std::vector<Line>> lines;
  for (const DrawnWay& way : ways)
    if (!way.name.empty() && way.kind != "track") lines[way.name].push_back(way.points);
  for (auto& [name, parts] : lines)
    for (bool changed = true; changed;) {
      changed = false;
      for (std::size_t i = 0; i < parts.size() && !changed; ++i)
        for (std::size_t j = 0; j < parts.size() && !changed; ++j) {
          if (i == j) continue;
          Line other = parts[j];
          if (distance(parts[i].back(), other.back()) < 0.01) std::reverse(other.begin(), other.end());
          if (distance(parts[i].back(), other.front()) >= 0.01) continue;
          parts[i].insert(parts[i].end(), other.begin() + 1, other.end());
          parts.erase(parts.begin() + static_cast<std::ptrdiff_t>(j));
          changed = true;
        }
    }
  return lines;
}

/// A line at even steps of one pixel, smoothed as lettering needs it.
Line even_line(const Line& line) {
  Line even{line.front()};
  double left = 1.0;
  for (std::size_t i = 1; i < line.size(); ++i) {
    MapPoint a = line[i - 1];
    double length = distance(a, line[i]);
    while (length >= left) {
      const double t = left / length;
      a = {a.x + t * (line[i].x - a.x), a.y + t * (line[i].y - a.y)};
      even.push_back(a);
      length = distance(a, line[i]);
      left = 1.0;
    }
    left -= length;
  }
  Line out = even;
  constexpr int kReach = 8;
  const int n = static_cast<int>(even.size());
  for (int i = 0; i < n; ++i) {
    const int reach = std::min({kReach, i, n - 1 - i});
    MapPoint sum;
    for (int k = i - reach; k <= i + reach; ++k) {
      sum.x += even[static_cast<std::size_t>(k)].x;
      sum.y += even[static_cast<std::size_t>(k)].y;
    }
    out[static_cast<std::size_t>(i)] = {sum.x / (2 * reach + 1), sum.y / (2 * reach + 1)};
  }
  return out;
}

std::vector<std::string> characters_of(const std::string& text) {
  std::vector<std::string> out;
  for (const char c : text) {
    if ((static_cast<unsigned char>(c) & 0xC0U) != 0x80U) out.emplace_back();
    if (!out.empty()) out.back() += c;
  }
  return out;
}

std::string in_capitals(const std::string& text) {
  gchar* upper = g_utf8_strup(text.c_str(), -1);
  std::string out = upper;
  g_free(upper);
  return out;
}

class Lettering {
 public:
  Lettering(cairo_t* cr, const DrawnMapStyle& style, int side, std::vector<TakenPlace> taken)
      : cr_(cr),
        style_(style),
        side_(side),
        layout_(pango_cairo_create_layout(cr)),
        taken_(std::move(taken)) {
    // Letters of maps lie at any angle and are not moved to whole pixels.
    cairo_font_options_t* options = cairo_font_options_create();
    cairo_font_options_set_hint_metrics(options, CAIRO_HINT_METRICS_OFF);
    cairo_font_options_set_hint_style(options, CAIRO_HINT_STYLE_NONE);
    pango_cairo_context_set_font_options(pango_layout_get_context(layout_), options);
    cairo_font_options_destroy(options);
    pango_context_set_round_glyph_positions(pango_layout_get_context(layout_), FALSE);
    PangoFontDescription* font = pango_font_description_from_string(style.font.c_str());
    pango_font_description_set_absolute_size(font, style.font_px * PANGO_SCALE);
    pango_layout_set_font_description(layout_, font);
    pango_font_description_free(font);
  }
  ~Lettering() { g_object_unref(layout_); }
  Lettering(const Lettering&) = delete;
  Lettering& operator=(const Lettering&) = delete;

  /// Writes a name along a street, repeatedly if that is long.
  void write(const std::string& name, const Line& street, Rgb8 halo, std::vector<DrawnName>& written) {
    const std::vector<std::string> letters = characters_of(style_.capitals ? in_capitals(name) : name);
    const std::vector<double> widths = widths_of(letters);
    double width = 0.0;
    for (const double w : widths) width += w;
    Line line = even_line(street);
    constexpr double kTry_px = 10.0;
    double next = 0.0;
    for (double begin = 0.0; begin + width + 6.0 < static_cast<double>(line.size()); begin += kTry_px) {
      if (begin < next || !fits(line, begin, width)) continue;
      written.push_back({name, draw(line, begin, width, letters, widths, halo)});
      next = begin + width + style_.repeat_px;
    }
  }

 private:
  /// From each letter to the next one, with the font's kerning.
  std::vector<double> widths_of(const std::vector<std::string>& letters) {
    std::string text;
    for (const std::string& letter : letters) text += letter;
    pango_layout_set_text(layout_, text.c_str(), -1);
    std::vector<double> widths;
    int first_byte = 0;
    for (const std::string& letter : letters) {
      PangoRectangle box;
      pango_layout_index_to_pos(layout_, first_byte, &box);
      widths.push_back(static_cast<double>(box.width) / PANGO_SCALE);
      first_byte += static_cast<int>(letter.size());
    }
    return widths;
  }

  static MapPoint at(const Line& line, double u) {
    const double inside = std::clamp(u, 0.0, static_cast<double>(line.size() - 1));
    const auto i = static_cast<std::size_t>(inside);
    const MapPoint a = line[i];
    const MapPoint b = line[std::min(i + 1, line.size() - 1)];
    const double t = inside - static_cast<double>(i);
    return {a.x + t * (b.x - a.x), a.y + t * (b.y - a.y)};
  }
  static double angle_at(const Line& line, double u) {
    const MapPoint a = at(line, u - 4.0);
    const MapPoint b = at(line, u + 4.0);
    return std::atan2(b.y - a.y, b.x - a.x);
  }

  /// Inside the picture, not bent sharply, and away from other names.
  bool fits(const Line& line, double begin, double width) const {
    const double margin = style_.font_px;
    for (double u = begin; u <= begin + width; u += 3.0) {
      const MapPoint p = at(line, u);
      if (p.x < margin || p.y < margin || p.x > side_ - margin || p.y > side_ - margin) return false;
      double turn = std::abs(angle_at(line, u + 6.0) - angle_at(line, u - 6.0));
      turn = std::min(turn, 2.0 * std::numbers::pi - turn);
      if (turn > 0.35) return false;
      for (const TakenPlace& place : taken_)
        if (distance(p, place.at) < place.letters * style_.font_px) return false;
    }
    return distance(at(line, begin), at(line, begin + width)) > 0.85 * width;
  }

  /// Returns the middle of the letters.
  Line draw(const Line& line, double begin, double width, const std::vector<std::string>& letters,
            const std::vector<double>& widths, Rgb8 halo) {
    Line middle_line;
    for (double u = begin; u <= begin + width; u += 3.0) {
      taken_.push_back({at(line, u)});
      middle_line.push_back(at(line, u));
    }
    const MapPoint first = at(line, begin);
    const MapPoint last = at(line, begin + width);
    const bool reversed = last.x < first.x;
    for (const bool is_halo : {true, false}) {
      if (is_halo && style_.halo_px == 0.0) continue;
      double u = 0.0;
      for (std::size_t i = 0; i < letters.size(); ++i) {
        const double middle = u + 0.5 * widths[i];
        u += widths[i];
        const double along = reversed ? begin + width - middle : begin + middle;
        const MapPoint p = at(line, along);
        const double angle = angle_at(line, along) + (reversed ? std::numbers::pi : 0.0);
        cairo_save(cr_);
        cairo_translate(cr_, p.x + 0.5, p.y + 0.5);
        cairo_rotate(cr_, angle);
        pango_layout_set_text(layout_, letters[i].c_str(), -1);
        PangoRectangle box;
        pango_layout_get_extents(layout_, nullptr, &box);
        const double baseline = static_cast<double>(pango_layout_get_baseline(layout_)) / PANGO_SCALE;
        cairo_translate(cr_, -0.5 * widths[i], 0.36 * style_.font_px - baseline);
        const Rgb8 c = is_halo ? halo : style_.ink;
        cairo_set_source_rgb(cr_, c.r / 255.0, c.g / 255.0, c.b / 255.0);
        cairo_new_path(cr_);
        if (is_halo) {
          pango_cairo_layout_path(cr_, layout_);
          cairo_set_line_width(cr_, 2.0 * style_.halo_px);
          cairo_set_dash(cr_, nullptr, 0, 0.0);
          cairo_stroke(cr_);
        } else {
          pango_cairo_show_layout(cr_, layout_);
        }
        cairo_restore(cr_);
      }
    }
    if (reversed) std::reverse(middle_line.begin(), middle_line.end());
    return middle_line;
  }

  cairo_t* cr_;
  const DrawnMapStyle& style_;
  int side_;
  PangoLayout* layout_;
  std::vector<TakenPlace> taken_;
};

}  // namespace

std::vector<DrawnName> draw_street_names(cairo_t* cr, const std::vector<DrawnWay>& ways,
                                         const DrawnMapStyle& style, int side,
                                         std::vector<TakenPlace> taken) {
  Lettering lettering(cr, style, side, std::move(taken));
  std::vector<std::pair<double, std::string>> longest;
  const auto lines = lines_by_name(ways);
  std::map<std::string, Rgb8> halos;
  for (const DrawnWay& way : ways)
    if (!way.name.empty())
      halos[way.name] = style.halo_of_street ? paint_of(way.kind, style).fill : style.halo;
  for (const auto& [name, parts] : lines) {
    double length = 0.0;
    for (const Line& part : parts) length += length_of(part);
    longest.emplace_back(-length, name);
  }
  std::sort(longest.begin(), longest.end());
  std::vector<DrawnName> written;
  for (const auto& [length, name] : longest)
    for (const Line& part : lines.at(name)) lettering.write(name, part, halos.at(name), written);
  return written;
}

}  // namespace palpable::bench
