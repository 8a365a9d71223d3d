// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0

// Street maps drawn in several styles, on which the parameters of vision/streets and vision/text are chosen
// (docs/maps.md). Usage: palpable_map_set [--seeds FIRST LAST] [--style NAME] [--no-names] [--write FOLDER].
// Even seeds are for choosing, odd ones for reporting. With PALPABLE_DATA set, two of three maps show places
// of its extracts; the others, and all without it, show towns that are not real.
#include "palpable/formats/picture/picture.hpp"
#include "palpable/sources/map/extract_window.hpp"
#include "palpable/vision/streets/gazetteer.hpp"
#include "palpable/vision/streets/street_map_from_picture.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <optional>
#include <random>
#include <set>
#include <string_view>

#include "drawn_maps.hpp"
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <opencv2/imgproc.hpp>

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

/// The pixels of lines, and the distance of every pixel to the nearest of them.
struct Lines {
  std::vector<cv::Point2d> points;
  cv::Mat distance;
};

Lines lines_of(const std::vector<const std::vector<MapPoint>*>& lines, int side) {
  Lines out;
  cv::Mat mask(side, side, CV_8U, cv::Scalar(255));
  for (const auto* line : lines)
    for (std::size_t i = 1; i < line->size(); ++i) {
      const MapPoint a = (*line)[i - 1];
      const MapPoint b = (*line)[i];
      const int n = std::max(1, static_cast<int>(std::hypot(b.x - a.x, b.y - a.y)));
      for (int k = 0; k < n; ++k) {
        const cv::Point2d p(a.x + (b.x - a.x) * k / n, a.y + (b.y - a.y) * k / n);
        if (p.x < 0 || p.y < 0 || p.x > side - 1 || p.y > side - 1) continue;
        out.points.push_back(p);
        mask.at<std::uint8_t>(cv::Point(p)) = 0;
      }
    }
  cv::distanceTransform(mask, out.distance, cv::DIST_L2, cv::DIST_MASK_PRECISE);
  return out;
}

/// Part of `points` that lie within `most` pixels of `lines`.
double part_near(const Lines& points, const Lines& lines, double most) {
  if (points.points.empty() || lines.points.empty()) return 0.0;
  std::size_t near = 0;
  for (const cv::Point2d& p : points.points) near += lines.distance.at<float>(cv::Point(p)) <= most ? 1 : 0;
  return static_cast<double>(near) / static_cast<double>(points.points.size());
}

struct Score {
  double found = 0.0;
  double true_part = 0.0;
  int right = 0;
  int wanted = 0;
  int wrong = 0;
  int maps = 0;
  int refused = 0;
  void add(const Score& other) {
    found += other.found;
    true_part += other.true_part;
    right += other.right;
    wanted += other.wanted;
    wrong += other.wrong;
    maps += other.maps;
    refused += other.refused;
  }
};

Score score_of(const DrawnMap& drawn, const StreetMap& map) {
  const std::set<std::string> small{"footway", "path", "steps", "cycleway", "service", "bridleway"};
  std::vector<const std::vector<MapPoint>*> wanted, all, got;
  std::set<std::string> names, have;
  for (const DrawnWay& way : drawn.ways) {
    all.push_back(&way.points);
    if (!small.contains(way.kind)) wanted.push_back(&way.points);
    names.insert(vision::compared_form(way.name));
  }
  for (const MapStreet& street : map.streets) {
    got.push_back(&street.points);
    if (!street.name.empty()) have.insert(vision::compared_form(street.name));
  }
  const int side = drawn.picture.width();
  const Lines truth = lines_of(wanted, side);
  const Lines any = lines_of(all, side);
  const Lines found = lines_of(got, side);
  Score score;
  score.maps = 1;
  score.found = part_near(truth, found, 3.0);
  score.true_part = part_near(found, any, 4.0);
  for (const std::string& name : drawn.drawn_names)
    score.right += have.contains(vision::compared_form(name)) ? 1 : 0;
  score.wanted = static_cast<int>(drawn.drawn_names.size());
  for (const std::string& name : have) score.wrong += names.contains(name) ? 0 : 1;
  return score;
}

void print(const std::string& label, const Score& s) {
  const int answered = std::max(1, s.maps - s.refused);
  fmt::print(
      "{:<24} found {:5.1f} %  true {:5.1f} %  names {:3}/{:<3} {:5.1f} %  false {:3}  refused {}/{}\n",
      label, 100.0 * s.found / s.maps, 100.0 * s.true_part / answered, s.right, s.wanted,
      100.0 * s.right / std::max(1, s.wanted), s.wrong, s.refused, s.maps);
  std::fflush(stdout);
}

/// In the form of a truth file.
nlohmann::json json_of(const DrawnMap& map) {
  nlohmann::json streets = nlohmann::json::array();
  for (const DrawnWay& way : map.ways) {
    nlohmann::json line = nlohmann::json::array();
    for (const MapPoint p : way.points) line.push_back({p.x, p.y});
    nlohmann::json street{{"highway", way.kind}, {"polylines_px", {line}}};
    if (!way.name.empty()) street["name"] = way.name;
    streets.push_back(std::move(street));
  }
  return {{"width", map.picture.width()},
          {"height", map.picture.height()},
          {"streets", streets},
          {"drawn_names", map.drawn_names}};
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
      Score score;
      score.maps = score.refused = 1;
      score.wanted = static_cast<int>(drawn.drawn_names.size());
      if (found) score = score_of(drawn, found->map);
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
