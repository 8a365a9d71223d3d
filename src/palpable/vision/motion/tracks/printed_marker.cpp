// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/motion/tracks/printed_marker.hpp"

#include "palpable/core/check.hpp"
#include "palpable/vision/image/opencv_image.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include <opencv2/imgproc.hpp>

namespace palpable::vision {
namespace {

constexpr int kCode = kMarkerCells - 2;
// A row of the code is one of four words of five cells, and stands for two bits.
constexpr std::array<int, 4> kWords{0x10, 0x17, 0x09, 0x0E};

bool is_white(int side_mm, int x, int y) {
  const int word = kWords[static_cast<std::size_t>((side_mm >> (2 * (kCode - 1 - y))) & 3)];
  return ((word >> (kCode - 1 - x)) & 1) != 0;
}

using Quad = std::vector<cv::Point2f>;

// Dark quadrilaterals: outlines of regions that are darker than their surroundings.
std::vector<Quad> dark_quads(const cv::Mat& grey, const MarkerOptions& options) {
  std::vector<Quad> out;
  const int longest = std::max(grey.cols, grey.rows);
  for (const double share : options.window_shares) {
    // Odd, and more than one pixel.
    const int window = std::max(2, static_cast<int>(share * longest)) | 1;
    cv::Mat dark;
    cv::adaptiveThreshold(grey, dark, 255, cv::ADAPTIVE_THRESH_MEAN_C, cv::THRESH_BINARY_INV, window,
                          options.darker);
    std::vector<std::vector<cv::Point>> outlines;
    cv::findContours(dark, outlines, cv::RETR_LIST, cv::CHAIN_APPROX_NONE);
    for (const auto& outline : outlines) {
      if (static_cast<double>(outline.size()) < 4 * options.least_side_px) continue;
      std::vector<cv::Point> corners;
      cv::approxPolyDP(outline, corners, options.outline_error * static_cast<double>(outline.size()), true);
      if (corners.size() != 4 || !cv::isContourConvex(corners)) continue;
      Quad quad(corners.begin(), corners.end());
      double least = longest;
      for (std::size_t i = 0; i < 4; ++i) least = std::min(least, cv::norm(quad[i] - quad[(i + 1) % 4]));
      if (least < options.least_side_px) continue;
      // Clockwise in the picture, whose y axis points down.
      if (cv::contourArea(quad, true) < 0) std::reverse(quad.begin(), quad.end());
      out.push_back(std::move(quad));
    }
  }
  return out;
}

// The cells of the square, white = 1; nullopt if its border is not black.
std::optional<std::array<std::array<int, kCode>, kCode>> code_in(const cv::Mat& grey, const Quad& quad,
                                                                 const MarkerOptions& options) {
  constexpr int kCell_px = 8, kSide = kMarkerCells * kCell_px;
  const Quad square{
      {-0.5F, -0.5F}, {kSide - 0.5F, -0.5F}, {kSide - 0.5F, kSide - 0.5F}, {-0.5F, kSide - 0.5F}};
  cv::Mat flat, binary;
  cv::warpPerspective(grey, flat, cv::getPerspectiveTransform(quad, square), {kSide, kSide});
  cv::threshold(flat, binary, 0, 255, cv::THRESH_BINARY | cv::THRESH_OTSU);
  std::array<std::array<int, kCode>, kCode> code{};
  const int rim = static_cast<int>(options.cell_rim * kCell_px);
  for (int y = 0; y < kMarkerCells; ++y)
    for (int x = 0; x < kMarkerCells; ++x) {
      const cv::Rect inner(x * kCell_px + rim, y * kCell_px + rim, kCell_px - 2 * rim, kCell_px - 2 * rim);
      const int white = cv::mean(binary(inner))[0] > 127 ? 1 : 0;
      const bool border = x == 0 || y == 0 || x == kMarkerCells - 1 || y == kMarkerCells - 1;
      if (border && white != 0) return std::nullopt;
      if (!border) code[static_cast<std::size_t>(y - 1)][static_cast<std::size_t>(x - 1)] = white;
    }
  return code;
}

// The marker, and how many quarter turns clockwise it was turned in the picture.
struct Read {
  int side_mm = 0;
  int turns = 0;
};
std::optional<Read> read_code(const std::array<std::array<int, kCode>, kCode>& code) {
  for (const int side_mm : kMarkerSides_mm)
    for (int turns = 0; turns < 4; ++turns) {
      bool same = true;
      for (int y = 0; y < kCode && same; ++y)
        for (int x = 0; x < kCode && same; ++x) {
          int u = x, v = y;
          for (int k = 0; k < turns; ++k) {
            const int old = u;
            u = kCode - 1 - v, v = old;
          }
          same = code[static_cast<std::size_t>(v)][static_cast<std::size_t>(u)] ==
                 (is_white(side_mm, x, y) ? 1 : 0);
        }
      if (same) return Read{side_mm, turns};
    }
  return std::nullopt;
}

double grey_at(const cv::Mat& grey, const cv::Point2d& at) {
  const int x = static_cast<int>(std::floor(at.x)), y = static_cast<int>(std::floor(at.y));
  if (x < 0 || y < 0 || x + 1 >= grey.cols || y + 1 >= grey.rows) return std::nan("");
  const double a = at.x - x, b = at.y - y;
  const auto level = [&](int u, int v) { return static_cast<double>(grey.at<std::uint8_t>(v, u)); };
  return (1 - b) * ((1 - a) * level(x, y) + a * level(x + 1, y)) +
         b * ((1 - a) * level(x, y + 1) + a * level(x + 1, y + 1));
}

// How far from `at` the edge from black to white lies along the outward direction, px: the centre of the
// rise, which blur does not move. nullopt without an edge.
std::optional<double> edge_from(const cv::Mat& grey, const cv::Point2d& at, const cv::Point2d& outward,
                                double reach, double least_rise) {
  constexpr double kStep = 0.5;
  double moment = 0.0, rise = 0.0;
  double before = grey_at(grey, at - reach * outward);
  for (double t = -reach + kStep; t <= reach; t += kStep) {
    const double here = grey_at(grey, at + t * outward);
    const double up = std::max(0.0, here - before);
    moment += up * (t - kStep / 2), rise += up;
    before = here;
  }
  if (!(rise >= least_rise)) return std::nullopt;
  return moment / rise;
}

// Moves each side onto its edge, by a line through points on it, and the corners to where the lines meet.
bool refine(const cv::Mat& grey, Quad& quad, const MarkerOptions& options) {
  std::array<cv::Vec4d, 4> lines;
  for (std::size_t i = 0; i < 4; ++i) {
    const cv::Point2d from = quad[i], to = quad[(i + 1) % 4];
    const double length = cv::norm(to - from);
    const cv::Point2d along = (to - from) / length, outward(along.y, -along.x);
    const double reach = options.edge_reach * length / kMarkerCells;
    std::vector<cv::Point2f> points;
    const int places = options.edge_places;
    const double begin = options.edge_margin;
    for (int k = 0; k < places; ++k) {
      const cv::Point2d at = from + (begin + (1.0 - 2.0 * begin) * k / (places - 1)) * (to - from);
      if (const auto edge = edge_from(grey, at, outward, reach, options.least_rise))
        points.push_back(at + *edge * outward);
    }
    if (points.size() < static_cast<std::size_t>(places / 2)) return false;
    cv::fitLine(points, lines[i], cv::DIST_HUBER, 0, 0.01, 0.01);
  }
  for (std::size_t i = 0; i < 4; ++i) {
    const cv::Vec4d &a = lines[(i + 3) % 4], &b = lines[i];
    const double across = a[0] * b[1] - a[1] * b[0];
    if (std::abs(across) < options.least_corner_sine) return false;
    const double t = ((b[2] - a[2]) * b[1] - (b[3] - a[3]) * b[0]) / across;
    quad[i] = cv::Point2f(static_cast<float>(a[2] + t * a[0]), static_cast<float>(a[3] + t * a[1]));
  }
  return true;
}

}  // namespace

Raster<std::uint8_t> marker_cells(int side_mm) {
  PALPABLE_CHECK(std::find(kMarkerSides_mm.begin(), kMarkerSides_mm.end(), side_mm) != kMarkerSides_mm.end());
  Raster<std::uint8_t> out(kMarkerCells, kMarkerCells, 0);
  for (int y = 0; y < kCode; ++y)
    for (int x = 0; x < kCode; ++x) out(x + 1, y + 1) = is_white(side_mm, x, y) ? 1 : 0;
  return out;
}

std::vector<Parameter> parameters_of(MarkerOptions& o) {
  return {
      {"least_side_px", &o.least_side_px, {14, 200}, "px", "Least side of a marker in the picture"},
      {"darker", &o.darker, {0, 100}, "levels", "How much darker than its window a marker is"},
      {"window_share_small", o.window_shares.data(), {0.005, 1}, "", "Smallest window, of the longer side"},
      {"window_share_middle", &o.window_shares[1], {0.005, 1}, "", "Middle window, of the longer side"},
      {"window_share_large", &o.window_shares[2], {0.005, 1}, "", "Largest window, of the longer side"},
      {"outline_error", &o.outline_error, {0.001, 0.2}, "", "Error of four sides, share of the outline"},
      {"cell_rim", &o.cell_rim, {0, 0.45}, "cells", "Rim of a cell that does not count"},
      {"edge_reach", &o.edge_reach, {0.1, 1}, "cells", "Where a side's edge is looked for"},
      {"edge_places", &o.edge_places, {4, 200}, "", "Places on a side at which it is"},
      {"edge_margin", &o.edge_margin, {0, 0.4}, "", "Share of a side at each end where it is not"},
      {"least_rise", &o.least_rise, {1, 255}, "levels", "Contrast of an edge"},
      {"least_corner_sine", &o.least_corner_sine, {0.01, 1}, "", "Sine of the angle between two sides"},
      {"most_frames", &o.most_frames, {2, 1000}, "", "Frames in which markers are searched"},
      {"outlier_px", &o.outlier_px, {0.1, 20}, "px", "Greatest error of a corner in a frame"},
      {"most_difference",
       &o.most_difference,
       {0.005, 0.5},
       "",
       "Greatest difference between the sides of a marker, share"}};
}

std::vector<SeenMarker> find_markers(const Raster<std::uint8_t>& grey, const MarkerOptions& options) {
  const cv::Mat picture = grey_view_of(grey);
  std::vector<SeenMarker> out;
  for (Quad& quad : dark_quads(picture, options)) {
    const auto code = code_in(picture, quad, options);
    const auto read = code ? read_code(*code) : std::nullopt;
    if (!read) continue;
    const bool again = std::any_of(out.begin(), out.end(), [&](const SeenMarker& other) {
      return std::hypot(
                 other.corners[0].x - static_cast<double>(quad[static_cast<std::size_t>(read->turns)].x),
                 other.corners[0].y - static_cast<double>(quad[static_cast<std::size_t>(read->turns)].y)) <
             options.least_side_px / 2;
    });
    if (again) continue;
    // The second time from nearer, so that noise in the searched range counts less.
    if (!refine(picture, quad, options) || !refine(picture, quad, options)) continue;
    SeenMarker marker{read->side_mm, {}};
    for (std::size_t i = 0; i < 4; ++i) {
      const cv::Point2f& corner = quad[(i + static_cast<std::size_t>(read->turns)) % 4];
      marker.corners[i] = {static_cast<double>(corner.x), static_cast<double>(corner.y)};
    }
    out.push_back(marker);
  }
  return out;
}

}  // namespace palpable::vision
