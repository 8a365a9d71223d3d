// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "drawn_maps.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <random>

#include "map_lettering.hpp"
#include <cairo/cairo.h>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

namespace palpable::bench {
namespace {

void set_colour(cairo_t* cr, Rgb8 c) { cairo_set_source_rgb(cr, c.r / 255.0, c.g / 255.0, c.b / 255.0); }

void add_path(cairo_t* cr, const std::vector<MapPoint>& points) {
  cairo_new_path(cr);
  for (const MapPoint p : points) cairo_line_to(cr, p.x + 0.5, p.y + 0.5);
}

void stroke(cairo_t* cr, const std::vector<MapPoint>& points, Rgb8 colour, double width,
            const std::vector<double>& dashes = {}) {
  add_path(cr, points);
  set_colour(cr, colour);
  cairo_set_line_width(cr, width);
  cairo_set_dash(cr, dashes.data(), static_cast<int>(dashes.size()), 0.0);
  cairo_stroke(cr);
}

/// Thin ways first, so that main streets lie over them.
int order_of(const std::string& kind) {
  constexpr std::array<const char*, 12> kOrder{"steps",        "footway",    "path",          "track",
                                               "service",      "pedestrian", "living_street", "residential",
                                               "unclassified", "tertiary",   "secondary",     "primary"};
  const auto found =
      std::find_if(kOrder.begin(), kOrder.end(), [&kind](const char* k) { return kind.starts_with(k); });
  return static_cast<int>(found - kOrder.begin());
}

bool is_path(const std::string& kind) {
  return kind == "footway" || kind == "path" || kind == "cycleway" || kind == "steps" || kind == "bridleway";
}

const StreetPaint& paint_of(const std::string& kind, const DrawnMapStyle& style) {
  if (kind == "service") return style.service;
  if (kind == "pedestrian" || kind == "living_street") return style.pedestrian;
  if (kind == "residential" || kind == "unclassified" || kind == "road") return style.minor;
  if (kind.starts_with("tertiary") || kind.ends_with("_link")) return style.middle;
  if (kind.starts_with("secondary")) return style.middle;
  return style.major;
}

void draw_areas(cairo_t* cr, const sources::MapExtract& extract, const DrawnMapStyle& style,
                const auto& project) {
  using Kind = sources::ExtractArea::Kind;
  for (const Kind kind : {Kind::green, Kind::water, Kind::building}) {
    if (kind == Kind::building && !style.buildings) continue;
    for (const sources::ExtractArea& area : extract.areas) {
      if (area.kind != kind) continue;
      std::vector<MapPoint> ring;
      for (const auto& p : area.ring) ring.push_back(project(p));
      add_path(cr, ring);
      cairo_close_path(cr);
      set_colour(cr, kind == Kind::green ? style.green : kind == Kind::water ? style.water : style.building);
      cairo_fill_preserve(cr);
      cairo_set_line_width(cr, 1.0);
      cairo_set_dash(cr, nullptr, 0, 0.0);
      if (kind == Kind::building) {
        set_colour(cr, style.building_line);
        cairo_stroke(cr);
      }
    }
  }
}

struct ProjectedWay {
  const sources::ExtractWay* way;
  std::vector<MapPoint> points;
};

void draw_ways(cairo_t* cr, const std::vector<ProjectedWay>& ways, const DrawnMapStyle& style, double scale) {
  for (const ProjectedWay& w : ways)
    if (is_path(w.way->kind)) stroke(cr, w.points, style.path, 1.2 * scale, {3.0, 2.5});
  for (const ProjectedWay& w : ways)
    if (w.way->kind == "track") stroke(cr, w.points, style.track, 1.6 * scale, {8.0, 3.0});
  const auto is_street = [](const ProjectedWay& w) {
    return !is_path(w.way->kind) && w.way->kind != "track" && w.way->kind != "rail";
  };
  for (const bool tunnel : {true, false}) {
    for (const ProjectedWay& w : ways) {
      const StreetPaint& paint = paint_of(w.way->kind, style);
      if (!is_street(w) || w.way->tunnel != tunnel || paint.casing_px == 0.0) continue;
      stroke(cr, w.points, paint.casing, paint.width_px * scale + 2.0 * paint.casing_px,
             tunnel ? std::vector<double>{5.0, 3.0} : std::vector<double>{});
    }
    for (const ProjectedWay& w : ways)
      if (is_street(w) && w.way->tunnel == tunnel)
        stroke(cr, w.points, paint_of(w.way->kind, style).fill,
               paint_of(w.way->kind, style).width_px * scale);
  }
  for (const ProjectedWay& w : ways)
    if (w.way->kind == "rail") {
      stroke(cr, w.points, style.rail, 3.0 * scale);
      stroke(cr, w.points, style.land, 1.4 * scale, {7.0, 7.0});
    }
}

/// As a scan: turned, blurred, with noise, compressed. The truth is turned as well.
void spoil(DrawnMap& map, const DrawnMapStyle& style, std::mt19937_64& random) {
  const int side = map.picture.width();
  cv::Mat picture(side, side, CV_8UC3);
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x) {
      const Rgb8 c = map.picture(x, y);
      picture.at<cv::Vec3b>(y, x) = {c.b, c.g, c.r};
    }
  if (style.skew_deg > 0.0) {
    const double angle = std::uniform_real_distribution<>(-style.skew_deg, style.skew_deg)(random);
    const cv::Point2f middle(0.5F * static_cast<float>(side - 1), 0.5F * static_cast<float>(side - 1));
    const cv::Mat turn = cv::getRotationMatrix2D(middle, angle, 1.0);
    cv::Mat turned;
    cv::warpAffine(picture, turned, turn, picture.size(), cv::INTER_CUBIC, cv::BORDER_REPLICATE);
    picture = turned;
    const auto at = [&turn](int r, int c) { return turn.at<double>(r, c); };
    for (DrawnWay& way : map.ways)
      for (MapPoint& p : way.points)
        p = {at(0, 0) * p.x + at(0, 1) * p.y + at(0, 2), at(1, 0) * p.x + at(1, 1) * p.y + at(1, 2)};
  }
  if (style.blur_px > 0.0) cv::GaussianBlur(picture, picture, {}, style.blur_px);
  if (style.noise > 0.0) {
    std::normal_distribution<float> noise(0.0F, static_cast<float>(style.noise));
    for (int y = 0; y < side; ++y)
      for (int x = 0; x < side; ++x)
        for (int c = 0; c < 3; ++c)
          picture.at<cv::Vec3b>(y, x)[c] = cv::saturate_cast<std::uint8_t>(
              static_cast<float>(picture.at<cv::Vec3b>(y, x)[c]) + noise(random));
  }
  if (style.jpeg_quality > 0) {
    std::vector<std::uint8_t> file;
    cv::imencode(".jpg", picture, file, {cv::IMWRITE_JPEG_QUALITY, style.jpeg_quality});
    picture = cv::imdecode(file, cv::IMREAD_COLOR);
  }
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x) {
      const cv::Vec3b c = picture.at<cv::Vec3b>(y, x);
      map.picture(x, y) = {c[2], c[1], c[0]};
    }
}

}  // namespace

DrawnMap drawn_map(const sources::MapExtract& extract, const DrawnWindow& window, const DrawnMapStyle& style,
                   std::uint64_t seed) {
  std::mt19937_64 random(seed);
  constexpr double kMetresPerDegree = 111195.0;
  const double shrink = std::cos(window.center.latitude * std::numbers::pi / 180.0);
  const double middle = 0.5 * (window.side_px - 1);
  const double px = kMetresPerDegree / window.metres_per_px;
  const auto project = [&](sources::GeoPoint p) {
    return MapPoint{middle + (p.longitude - window.center.longitude) * shrink * px,
                    middle - (p.latitude - window.center.latitude) * px};
  };
  std::vector<ProjectedWay> ways;
  for (const sources::ExtractWay& way : extract.ways) {
    ProjectedWay projected{&way, {}};
    bool is_near = false;
    for (const auto& p : way.points) {
      projected.points.push_back(project(p));
      const MapPoint q = projected.points.back();
      is_near = is_near || (std::abs(q.x - middle) < 1.5 * middle && std::abs(q.y - middle) < 1.5 * middle);
    }
    if (is_near) ways.push_back(std::move(projected));
  }
  std::stable_sort(ways.begin(), ways.end(), [](const ProjectedWay& a, const ProjectedWay& b) {
    return order_of(a.way->kind) < order_of(b.way->kind);
  });
  const int side = window.side_px;
  cairo_surface_t* surface = cairo_image_surface_create(CAIRO_FORMAT_RGB24, side, side);
  cairo_t* cr = cairo_create(surface);
  set_colour(cr, style.land);
  cairo_paint(cr);
  cairo_set_line_join(cr, CAIRO_LINE_JOIN_ROUND);
  cairo_set_line_cap(cr, CAIRO_LINE_CAP_BUTT);
  draw_areas(cr, extract, style, project);
  const double scale = std::sqrt(1.0 / window.metres_per_px);
  cairo_set_line_cap(cr, CAIRO_LINE_CAP_ROUND);
  draw_ways(cr, ways, style, scale);
  DrawnMap map;
  for (const ProjectedWay& w : ways)
    if (w.way->kind != "rail") map.ways.push_back({w.way->kind, w.way->name, w.points});
  map.drawn_names = draw_street_names(cr, map.ways, style, side);
  cairo_surface_flush(surface);
  map.picture = Raster<Rgb8>(side, side);
  const unsigned char* data = cairo_image_surface_get_data(surface);
  const int stride = cairo_image_surface_get_stride(surface);
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x) {
      const unsigned char* p = data + static_cast<std::ptrdiff_t>(y) * stride + 4 * x;
      map.picture(x, y) = {p[2], p[1], p[0]};
    }
  cairo_destroy(cr);
  cairo_surface_destroy(surface);
  spoil(map, style, random);
  return map;
}

}  // namespace palpable::bench
