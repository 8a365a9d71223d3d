// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0

// Street maps drawn in several styles, on which the parameters of vision/streets and vision/text are chosen
// (docs/maps.md). Usage: palpable_map_set [--seeds FIRST LAST] [--style NAME] [--no-names] [--write FOLDER].
// Even seeds are for choosing, odd ones for reporting. With PALPABLE_DATA set, two of three maps show places
// of its extracts; the others, and all without it, show towns that are not real.
#include "palpable/formats/picture/picture.hpp"
#include "palpable/measure/street_map_score.hpp"
#include "palpable/sources/map/extract_window.hpp"
#include "palpable/vision/streets/names/gazetteer.hpp"
#include "palpable/vision/streets/street_map_from_picture.hpp"
#include "palpable/vision/text/text_lines.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <optional>
#include <random>
#include <string_view>

#include "drawn_maps.hpp"
#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace palpable::bench {
namespace {

struct Arguments {
  int first = 0;
  int last = 5;
  std::string style;
  bool names = true;
  std::string folder;
};

Arguments arguments_from(int argc, char** argv) {
  Arguments out;
  for (int i = 1; i < argc; ++i) {
    const std::string_view word = argv[i];
    if (word == "--seeds" && i + 2 < argc) {
      out.first = std::atoi(argv[++i]);
      out.last = std::atoi(argv[++i]);
    } else if (word == "--style" && i + 1 < argc) {
      out.style = argv[++i];
    } else if (word == "--write" && i + 1 < argc) {
      out.folder = argv[++i];
    } else if (word == "--no-names") {
      out.names = false;
    } else {
      fmt::print(stderr, "unknown: {}\n", word);
      std::exit(2);
    }
  }
  return out;
}

std::vector<sources::MapExtract> extracts() {
  std::vector<sources::MapExtract> out;
  const char* data = std::getenv("PALPABLE_DATA");
  if (data == nullptr) return out;
  for (const char* name : {"leeds_cycleway.osm", "liechtenstein-2013.osm.pbf", "monaco.osm.pbf"}) {
    auto extract = sources::read_map_extract(std::filesystem::path(data) / "map-vector" / "extracts" / name);
    if (extract)
      out.push_back(*std::move(extract));
    else
      fmt::print(stderr, "{}\n", extract.error().sentence());
  }
  return out;
}

struct Place {
  const sources::MapExtract* extract;
  DrawnWindow window;
};

/// A place with at least 40 named ways near it.
Place place_of(std::uint64_t seed, const std::vector<sources::MapExtract>& extracts,
               const sources::MapExtract& town) {
  std::mt19937_64 random(seed * 7919 + 17);
  Place place{&town, {}};
  place.window.metres_per_px = std::uniform_real_distribution<>(0.75, 1.5)(random);
  if (extracts.empty() || seed % 3 == 2) return place;
  place.extract = &extracts[(seed / 2 + seed / 6) % extracts.size()];
  const auto& ways = place.extract->ways;
  for (int attempt = 0; attempt < 200; ++attempt) {
    const auto& way = ways[std::uniform_int_distribution<std::size_t>(0, ways.size() - 1)(random)];
    place.window.center = way.points.front();
    int near = 0;
    constexpr double kReach = 0.003;
    for (const auto& other : ways)
      near += !other.name.empty() && sources::is_street(other) &&
                      std::abs(other.points.front().latitude - way.points.front().latitude) < kReach &&
                      std::abs(other.points.front().longitude - way.points.front().longitude) < kReach
                  ? 1
                  : 0;
    constexpr int kLeast = 40;
    if (near >= kLeast) break;
  }
  return place;
}

measure::TrueStreetMap truth_of(const DrawnMap& drawn) {
  measure::TrueStreetMap truth{drawn.picture.width(), drawn.picture.height(), {}, {}};
  for (const DrawnWay& way : drawn.ways)
    truth.streets.push_back({way.kind, way.name, way.width_px, {way.points}});
  for (const DrawnName& name : drawn.lettering) truth.drawn_names.push_back(name.text);
  return truth;
}

/// Counts of the names that are written on a map: all of them, those found as one line of lettering,
/// and those read exactly.
struct NameChain {
  int written = 0;
  int lines = 0;
  int read = 0;
};

/// Whether two lines cover each other, but for `margin_px` at their ends.
bool is_same_place(const std::vector<MapPoint>& a, const std::vector<MapPoint>& b, double margin_px) {
  const auto near = [margin_px](MapPoint p, MapPoint q) {
    return std::hypot(p.x - q.x, p.y - q.y) <= margin_px;
  };
  return (near(a.front(), b.front()) && near(a.back(), b.back())) ||
         (near(a.front(), b.back()) && near(a.back(), b.front()));
}

/// Light lettering is dark in the negative, in which it is looked for.
Raster<Rgb8> with_dark_lettering(Raster<Rgb8> picture, const DrawnMapStyle& style) {
  if (style.ink.g > style.land.g)
    for (Rgb8& c : picture.values())
      c = {static_cast<std::uint8_t>(255 - c.r), static_cast<std::uint8_t>(255 - c.g),
           static_cast<std::uint8_t>(255 - c.b)};
  return picture;
}

NameChain chain_of(const DrawnMap& drawn, const DrawnMapStyle& style, const StreetMap& map) {
  NameChain chain;
  const auto lines = vision::find_text_lines(with_dark_lettering(drawn.picture, style));
  for (const DrawnName& name : drawn.lettering) {
    ++chain.written;
    const double margin = style.font_px;
    chain.lines += std::any_of(lines.begin(), lines.end(),
                               [&](const auto& l) { return is_same_place(name.line, l.centre, margin); })
                       ? 1
                       : 0;
    const auto is_read = [&](const MapLabel& label) {
      const auto middle = [&label](std::size_t i, std::size_t k) {
        return MapPoint{0.5 * (label.box[i].x + label.box[k].x), 0.5 * (label.box[i].y + label.box[k].y)};
      };
      return vision::compared_form(label.text) == vision::compared_form(name.text) &&
             is_same_place(name.line, {middle(0, 3), middle(1, 2)}, 2.0 * margin);
    };
    chain.read += std::any_of(map.labels.begin(), map.labels.end(), is_read) ? 1 : 0;
  }
  return chain;
}

struct Score {
  double found = 0.0;
  double true_part = 0.0;
  double iou = 0.0;
  double junction_f = 0.0;
  int right = 0;
  int wanted = 0;
  int wrong = 0;
  int maps = 0;
  int refused = 0;
  NameChain chain;
  void add(const Score& other) {
    found += other.found;
    true_part += other.true_part;
    iou += other.iou;
    junction_f += other.junction_f;
    right += other.right;
    wanted += other.wanted;
    wrong += other.wrong;
    maps += other.maps;
    refused += other.refused;
    chain.written += other.chain.written;
    chain.lines += other.chain.lines;
    chain.read += other.chain.read;
  }
};

/// Of a map that was refused, if `found` is null.
Score score_of(const DrawnMap& drawn, const DrawnMapStyle& style, const StreetMap* found) {
  StreetMap none;
  none.width_px = drawn.picture.width();
  none.height_px = drawn.picture.height();
  const auto score = measure::score_street_map(found != nullptr ? *found : none, truth_of(drawn));
  Score out;
  out.maps = 1;
  out.refused = found == nullptr ? 1 : 0;
  if (!score) return out;
  out.found = score->found;
  out.true_part = score->true_part;
  out.iou = score->area_iou;
  out.junction_f = score->junction_f();
  out.right = score->names_right;
  out.wanted = score->names;
  out.wrong = score->names_false;
  if (found != nullptr) out.chain = chain_of(drawn, style, *found);
  return out;
}

void print(const std::string& label, const Score& s) {
  const int answered = std::max(1, s.maps - s.refused);
  fmt::print(
      "{:<20} found {:5.1f} %  true {:5.1f} %  area {:.2f}  junctions {:.2f}  names {:3}/{:<3} {:5.1f} %  "
      "false "
      "{:3}  written {} lines {} read {}  refused {}/{}\n",
      label, 100.0 * s.found / s.maps, 100.0 * s.true_part / answered, s.iou / s.maps, s.junction_f / s.maps,
      s.right, s.wanted, 100.0 * s.right / std::max(1, s.wanted), s.wrong, s.chain.written, s.chain.lines,
      s.chain.read, s.refused, s.maps);
  std::fflush(stdout);
}

/// In the form of a truth file.
nlohmann::json json_of(const DrawnMap& map) {
  nlohmann::json streets = nlohmann::json::array();
  for (const DrawnWay& way : map.ways) {
    nlohmann::json line = nlohmann::json::array();
    for (const MapPoint p : way.points) line.push_back({p.x, p.y});
    nlohmann::json street{{"highway", way.kind}, {"width_px", way.width_px}, {"polylines_px", {line}}};
    if (!way.name.empty()) street["name"] = way.name;
    if (way.tunnel) street["tunnel"] = "yes";
    streets.push_back(std::move(street));
  }
  nlohmann::json lettering = nlohmann::json::array();
  for (const DrawnName& name : map.lettering) {
    nlohmann::json line = nlohmann::json::array();
    for (const MapPoint p : name.line) line.push_back({p.x, p.y});
    lettering.push_back({{"text", name.text}, {"line_px", std::move(line)}});
  }
  return {{"width", map.picture.width()},
          {"height", map.picture.height()},
          {"streets", streets},
          {"lettering", lettering}};
}

Image image_of(const Raster<Rgb8>& picture) {
  Image image{picture.width(), picture.height(), 3, 8, {}};
  for (const Rgb8 c : picture.values())
    for (const std::uint8_t v : {c.r, c.g, c.b}) image.samples.push_back(static_cast<float>(v) / 255.0F);
  return image;
}

void run(const Arguments& arguments) {
  // Names are read by a program; without a PATH none is found.
  if (!arguments.names) setenv("PATH", "", 1);
  const auto real = extracts();
  Score all;
  for (const DrawnMapStyle& style : drawn_map_styles()) {
    if (!arguments.style.empty() && style.name != arguments.style) continue;
    Score sum;
    for (int seed = arguments.first; seed <= arguments.last; seed += 2) {
      const auto number = static_cast<std::uint64_t>(seed);
      const sources::MapExtract town = drawn_town(number);
      const Place place = place_of(number, real, town);
      const DrawnMap drawn = drawn_map(*place.extract, place.window, style, number);
      if (!arguments.folder.empty()) {
        const auto stem = std::filesystem::path(arguments.folder) / fmt::format("{}_{}", style.name, seed);
        static_cast<void>(formats::write_png(stem.string() + ".png", drawn.picture));
        std::ofstream(stem.string() + ".json") << json_of(drawn).dump();
      }
      const auto found = vision::street_map_from_picture(image_of(drawn.picture), {}, {});
      const Score score = score_of(drawn, style, found ? &found->map : nullptr);
      print(fmt::format("  {} {}", style.name, seed), score);
      sum.add(score);
    }
    print(style.name, sum);
    all.add(sum);
  }
  print("all", all);
  fmt::print("processor time {:.0f} s\n", static_cast<double>(std::clock()) / CLOCKS_PER_SEC);
}

}  // namespace
}  // namespace palpable::bench

int main(int argc, char** argv) { palpable::bench::run(palpable::bench::arguments_from(argc, argv)); }
