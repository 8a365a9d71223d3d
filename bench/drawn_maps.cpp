// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "drawn_maps.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <random>

#include "map_details.hpp"
#include "map_lettering.hpp"
#include <cairo/cairo.h>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

namespace palpable::bench {
namespace {

/// Widths of the styles' narrow streets, by which paths and railways are drawn, pixels.
constexpr double kServiceWidth_px = 4.5;
constexpr double kMinorWidth_px = 9.0;

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

void draw_paths(cairo_t* cr, const std::vector<ProjectedWay>& ways, const DrawnMapStyle& style) {
  const double scale = style.service.width_px / kServiceWidth_px;
  for (const ProjectedWay& w : ways) {
    if (!is_path(w.way->kind)) continue;
    if (style.details) stroke(cr, w.points, style.land, 3.0 * scale);
    const bool is_steps = w.way->kind == "steps";
    stroke(cr, w.points, style.path, (is_steps && style.details ? 3.0 : 1.2) * scale,
           is_steps ? std::vector<double>{2.0, 1.0} : std::vector<double>{3.0, 2.5});
  }
  for (const ProjectedWay& w : ways)
    if (w.way->kind == "track") {
      if (style.details) stroke(cr, w.points, style.land, 3.5 * scale);
      stroke(cr, w.points, style.track, 1.6 * scale,
             style.details ? std::vector<double>{5.0, 4.0, 2.0, 4.0} : std::vector<double>{8.0, 3.0});
    }
}

Rgb8 fill_in_tunnel(Rgb8 fill, const DrawnMapStyle& style) {
  constexpr Rgb8 kWhite{255, 255, 255};
  return mixed(fill, fill == kWhite ? style.land : kWhite, style.tunnel_fade);
}

void draw_ways(cairo_t* cr, const std::vector<ProjectedWay>& ways, const DrawnMapStyle& style) {
  draw_paths(cr, ways, style);
  const auto is_street = [](const ProjectedWay& w) {
    return !is_path(w.way->kind) && w.way->kind != "track" && w.way->kind != "rail";
  };
  for (const bool tunnel : {true, false}) {
    for (const ProjectedWay& w : ways) {
      const StreetPaint& paint = paint_of(w.way->kind, style);
      if (!is_street(w) || w.way->tunnel != tunnel || paint.casing_px == 0.0) continue;
      if (tunnel) cairo_set_line_cap(cr, CAIRO_LINE_CAP_BUTT);
      stroke(cr, w.points, paint.casing, paint.width_px + 2.0 * paint.casing_px,
             tunnel ? std::vector<double>{4.0, 2.5} : std::vector<double>{});
      cairo_set_line_cap(cr, CAIRO_LINE_CAP_ROUND);
    }
    for (const ProjectedWay& w : ways) {
      const StreetPaint& paint = paint_of(w.way->kind, style);
      if (is_street(w) && w.way->tunnel == tunnel)
        stroke(cr, w.points, tunnel ? fill_in_tunnel(paint.fill, style) : paint.fill, paint.width_px);
    }
  }
  const double scale = style.minor.width_px / kMinorWidth_px;
  for (const ProjectedWay& w : ways)
    if (w.way->kind == "rail") {
      stroke(cr, w.points, style.rail, 3.0 * scale);
      stroke(cr, w.points, style.land, 1.4 * scale, {7.0, 7.0});
    }
}

double drawn_width_px(const std::string& kind, const DrawnMapStyle& style) {
  if (is_path(kind) || kind == "track") return style.service.width_px / kServiceWidth_px;
  const StreetPaint& paint = paint_of(kind, style);
  return paint.width_px + 2.0 * paint.casing_px;
}

/// The style with the widths and letters that it has at a scale.
DrawnMapStyle at_scale(DrawnMapStyle style, double px_per_m) {
  const double widths = std::pow(px_per_m, style.width_power);
  for (StreetPaint* p : {&style.major, &style.middle, &style.minor, &style.service, &style.pedestrian})
    p->width_px *= widths;
  for (auto* p : {&style.motorway, &style.trunk, &style.tertiary})
    if (p->has_value()) (*p)->width_px *= widths;
  style.font_px *= std::pow(px_per_m, style.font_power);
  return style;
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
    const auto turned_point = [&at](MapPoint p) {
      return MapPoint{at(0, 0) * p.x + at(0, 1) * p.y + at(0, 2), at(1, 0) * p.x + at(1, 1) * p.y + at(1, 2)};
    };
    for (DrawnWay& way : map.ways)
      for (MapPoint& p : way.points) p = turned_point(p);
    for (DrawnName& name : map.lettering)
      for (MapPoint& p : name.line) p = turned_point(p);
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

const StreetPaint& paint_of(const std::string& kind, const DrawnMapStyle& style) {
  if (kind == "service") return style.service;
  if (kind == "pedestrian" || kind == "living_street") return style.pedestrian;
  if (kind == "residential" || kind == "unclassified" || kind == "road") return style.minor;
  if (kind.starts_with("motorway") && style.motorway) return *style.motorway;
  if (kind.starts_with("trunk") && style.trunk) return *style.trunk;
  if (kind.starts_with("tertiary") && style.tertiary) return *style.tertiary;
  if (kind.starts_with("tertiary") || kind.ends_with("_link")) return style.middle;
  if (kind.starts_with("secondary")) return style.middle;
  return style.major;
}

DrawnMap drawn_map(const sources::MapExtract& extract, const DrawnWindow& window,
                   const DrawnMapStyle& given_style, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  const double px_per_m = 1.0 / (window.metres_per_px * given_style.zoom_out);
  const DrawnMapStyle style = at_scale(given_style, px_per_m);
  constexpr double kMetresPerDegree = 111195.0;
  const double shrink = std::cos(window.center.latitude * std::numbers::pi / 180.0);
  const double middle = 0.5 * (window.side_px - 1);
  const double px = kMetresPerDegree * px_per_m;
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
  std::mt19937_64 random_details(seed + 1000);
  if (style.details) draw_areas_of_use(cr, style, side, random_details);
  draw_areas(cr, extract, style, project);
  cairo_set_line_cap(cr, CAIRO_LINE_CAP_ROUND);
  draw_ways(cr, ways, style);
  std::vector<TakenPlace> taken;
  if (style.details) taken = draw_symbols(cr, ways, style, side, random_details);
  DrawnMap map;
  for (const ProjectedWay& w : ways)
    if (w.way->kind != "rail")
      map.ways.push_back(
          {w.way->kind, w.way->name, w.points, drawn_width_px(w.way->kind, style), w.way->tunnel});
  map.lettering = draw_street_names(cr, map.ways, style, side, std::move(taken));
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
