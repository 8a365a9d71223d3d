// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/contours/contour_corners.hpp"

#include "palpable/vision/contours/contour_steps.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <span>
#include <vector>

namespace palpable::vision {
namespace {

/// A point or a direction in the picture, pixels.
struct PicturePoint {
  double x, y;
};
struct Piece {
  PicturePoint middle{};
  /// Unit, away from the corner.
  PicturePoint along{};
  /// The angle by which the piece bends over its length; its strength; its pixel nearest to the corner.
  double bend = 0.0;
  float strength = 0.0F;
  Pixel nearest{};
};
struct Corner {
  Pixel from{};
  PicturePoint at{};
  double drawn_px = 0.0;
  std::array<Piece, 2> pieces;
};

/// The input of corner detection.
struct Lines {
  const Raster<float>& strength;
  const Raster<float>& tangent_x;
  const Raster<float>& tangent_y;
  const Raster<float>& line;
  const CornerOptions& options;
};

double apart(PicturePoint a, PicturePoint b) { return std::hypot(a.x - b.x, a.y - b.y); }
PicturePoint centre_of(Pixel p) { return {static_cast<double>(p.x), static_cast<double>(p.y)}; }

/// Whether tangents 4 px around the pixel point in more than one direction.
bool may_turn(const Lines& lines, Pixel p) {
  constexpr std::array<Pixel, 8> kRing{
      {{4, 0}, {3, 3}, {0, 4}, {-3, 3}, {-4, 0}, {-3, -3}, {0, -4}, {3, -3}}};
  float c = 0.0F, s = 0.0F, sum = 0.0F;
  for (const Pixel step : kRing) {
    const int x = p.x + step.x, y = p.y + step.y;
    if (!lines.strength.contains(x, y)) continue;
    const float weight = lines.strength(x, y);
    const float tx = lines.tangent_x(x, y), ty = lines.tangent_y(x, y);
    c += weight * (tx * tx - ty * ty);
    s += weight * 2.0F * tx * ty;
    sum += weight;
  }
  const float straight = lines.options.straight_agreement;
  return c * c + s * s < straight * straight * sum * sum;
}

/// The sub-pixel maximum of the strength across the line, by a parabola through three samples.
PicturePoint subpixel(const Lines& lines, Pixel p) {
  const double nx = -static_cast<double>(lines.tangent_y(p.x, p.y)), ny = lines.tangent_x(p.x, p.y);
  const auto at = [&](double side) {
    return static_cast<double>(
        bilinear(lines.strength, static_cast<float>(p.x + side * nx), static_cast<float>(p.y + side * ny)));
  };
  const double before = at(-1.0), here = at(0.0), after = at(1.0);
  const double curve = before - 2.0 * here + after;
  const double shift = curve < 0.0 ? std::clamp(0.5 * (before - after) / curve, -0.7, 0.7) : 0.0;
  return {p.x + shift * nx, p.y + shift * ny};
}

/// The pixels of the line that are connected with p (across gaps of one pixel), divided into the pieces that
/// are connected beyond near_px. Reused between calls for its memory.
class Surroundings {
 public:
  explicit Surroundings(const CornerOptions& options)
      : near_px_(options.near_px),
        reach_(static_cast<int>(std::ceil(options.far_px))),
        side_(2 * reach_ + 1),
        open_(static_cast<std::size_t>(side_) * static_cast<std::size_t>(side_)) {}

  /// The pieces, and the pixels nearer than near_px as `core`.
  std::vector<std::vector<Pixel>> pieces;
  std::vector<Pixel> core;

  void find(const Raster<float>& line, Pixel p) {
    pieces.clear();
    core.clear();
    origin_ = p;
    std::fill(open_.begin(), open_.end(), std::uint8_t{0});
    for (int y = std::max(0, p.y - reach_); y <= std::min(line.height() - 1, p.y + reach_); ++y)
      for (int x = std::max(0, p.x - reach_); x <= std::min(line.width() - 1, p.x + reach_); ++x)
        if (line(x, y) > 0.0F) mark({x, y}) = 1;
    const std::vector<Pixel> all = taken_from(p, 2, 1, 2);
    std::vector<Pixel> far;
    for (const Pixel q : all) (is_core(q) ? core : far).push_back(q);
    for (const Pixel q : core) mark(q) = 0;
    for (const Pixel q : far)
      if (mark(q) == 2) pieces.push_back(taken_from(q, 1, 2, 0));
  }

 private:
  bool is_core(Pixel q) const { return apart(centre_of(q), centre_of(origin_)) < near_px_; }
  bool holds(Pixel q) const {
    return std::abs(q.x - origin_.x) <= reach_ && std::abs(q.y - origin_.y) <= reach_;
  }
  std::uint8_t& mark(Pixel q) {
    return open_[static_cast<std::size_t>((q.y - origin_.y + reach_) * side_ + q.x - origin_.x + reach_)];
  }
  /// The pixels marked `from` that are connected with `first` by steps of up to `step`; marked `to` now.
  std::vector<Pixel> taken_from(Pixel first, int step, std::uint8_t from, std::uint8_t to) {
    std::vector<Pixel> out{first};
    mark(first) = to;
    for (std::size_t k = 0; k < out.size(); ++k) {
      for (int dy = -step; dy <= step; ++dy)
        for (int dx = -step; dx <= step; ++dx) {
          const Pixel q{out[k].x + dx, out[k].y + dy};
          if (!holds(q) || mark(q) != from) continue;
          mark(q) = to;
          out.push_back(q);
        }
    }
    return out;
  }

  double near_px_;
  int reach_, side_;
  std::vector<std::uint8_t> open_;
  Pixel origin_{};
};

/// The bend of a piece, from a parabola fitted to its points.
void measure_bend(std::span<const PicturePoint> places, Piece& piece) {
  double sum_u = 0.0, sum_uu = 0.0, length = 0.0;
  for (const PicturePoint q : places) {
    const double u = (q.x - piece.middle.x) * piece.along.x + (q.y - piece.middle.y) * piece.along.y;
    sum_u += u * u;
    sum_uu += u * u * u * u;
    length = std::max(length, std::abs(u));
  }
  const auto n = static_cast<double>(places.size());
  const double mean = sum_u / n, spread = sum_uu - n * mean * mean;
  double with_v = 0.0;
  for (const PicturePoint q : places) {
    const double dx = q.x - piece.middle.x, dy = q.y - piece.middle.y;
    const double u = dx * piece.along.x + dy * piece.along.y, v = dy * piece.along.x - dx * piece.along.y;
    with_v += (u * u - mean) * v;
  }
  piece.bend = spread > 0.0 ? 4.0 * length * std::abs(with_v) / spread : 0.0;
}

/// The straight piece through the pixels, directed away from the corner; nullopt if they are too few or not
/// straight.
std::optional<Piece> piece_of(const Lines& lines, std::span<const Pixel> pixels, Pixel corner) {
  const CornerOptions& options = lines.options;
  if (static_cast<int>(pixels.size()) < options.least_pixels) return std::nullopt;
  std::vector<PicturePoint> places;
  Piece out;
  double nearest = 2.0 * options.far_px, farthest = 0.0;
  for (const Pixel q : pixels) {
    places.push_back(subpixel(lines, q));
    out.middle.x += places.back().x / static_cast<double>(pixels.size());
    out.middle.y += places.back().y / static_cast<double>(pixels.size());
    out.strength += lines.line(q.x, q.y) / static_cast<float>(pixels.size());
    const double far = apart(centre_of(q), centre_of(corner));
    farthest = std::max(farthest, far);
    if (far < nearest) nearest = far, out.nearest = q;
  }
  if (farthest < options.far_px - options.end_gap_px) return std::nullopt;
  double xx = 0.0, xy = 0.0, yy = 0.0;
  for (const PicturePoint q : places) {
    const double dx = q.x - out.middle.x, dy = q.y - out.middle.y;
    xx += dx * dx, xy += dx * dy, yy += dy * dy;
  }
  const double angle = 0.5 * std::atan2(2.0 * xy, xx - yy);
  const double least = 0.5 * (xx + yy - std::hypot(xx - yy, 2.0 * xy));
  if (least > options.straight_px * options.straight_px * static_cast<double>(places.size()))
    return std::nullopt;
  out.along = {std::cos(angle), std::sin(angle)};
  if ((out.middle.x - corner.x) * out.along.x + (out.middle.y - corner.y) * out.along.y < 0.0)
    out.along = {-out.along.x, -out.along.y};
  measure_bend(places, out);
  return out;
}

/// The corner that the pixel belongs to, if any.
std::optional<Corner> corner_at(const Lines& lines, Pixel p, Surroundings& around) {
  around.find(lines.line, p);
  if (around.pieces.size() != 2) return std::nullopt;
  const auto a = piece_of(lines, around.pieces[0], p);
  const auto b = a ? piece_of(lines, around.pieces[1], p) : std::nullopt;
  if (!b) return std::nullopt;
  const double cross = a->along.x * b->along.y - a->along.y * b->along.x;
  const double turn =
      std::numbers::pi - std::atan2(std::abs(cross), a->along.x * b->along.x + a->along.y * b->along.y);
  const CornerOptions& options = lines.options;
  if (turn < options.least_turn || turn > options.most_turn ||
      std::max(a->bend, b->bend) > options.bend_share * turn)
    return std::nullopt;
  const double dx = b->middle.x - a->middle.x, dy = b->middle.y - a->middle.y;
  const double t = (dx * b->along.y - dy * b->along.x) / cross;
  const PicturePoint meeting{a->middle.x + t * a->along.x, a->middle.y + t * a->along.y};
  const double drawn = apart(meeting, centre_of(p));
  if (drawn > options.longest_px) return std::nullopt;
  return Corner{p, meeting, drawn, {*a, *b}};
}

/// Draws a straight line of pixels between two.
void draw(Pixel from, Pixel to, float strength, Raster<float>& line) {
  const int steps = std::max(std::abs(to.x - from.x), std::abs(to.y - from.y));
  for (int k = 0; k <= steps; ++k) {
    const double share = steps > 0 ? static_cast<double>(k) / steps : 0.0;
    const Pixel p{static_cast<int>(std::lround(from.x + share * (to.x - from.x))),
                  static_cast<int>(std::lround(from.y + share * (to.y - from.y)))};
    if (line.contains(p.x, p.y)) line(p.x, p.y) = std::max(line(p.x, p.y), strength);
  }
}

std::vector<Corner> corners_of(const Lines& lines, const Work& work) {
  std::vector<std::vector<Corner>> rows(static_cast<std::size_t>(lines.line.height()));
  parallel_for(work, lines.line.height(), 16, [&](int begin, int end) {
    Surroundings around(lines.options);
    for (int y = begin; y < end; ++y)
      for (int x = 0; x < lines.line.width(); ++x) {
        if (!(lines.line(x, y) > 0.0F) || !may_turn(lines, {x, y})) continue;
        if (const auto found = corner_at(lines, {x, y}, around))
          rows[static_cast<std::size_t>(y)].push_back(*found);
      }
  });
  std::vector<Corner> out;
  for (const auto& row : rows) out.insert(out.end(), row.begin(), row.end());
  // Several pixels find the same corner: the estimate of the nearest one is used.
  std::stable_sort(out.begin(), out.end(),
                   [](const Corner& a, const Corner& b) { return a.drawn_px < b.drawn_px; });
  return out;
}

}  // namespace

void restore_corners(const Raster<float>& strength, const Raster<float>& tangent_x,
                     const Raster<float>& tangent_y, Raster<float>& line, const CornerOptions& options,
                     const Work& work) {
  const Raster<float> rounded = line;
  Raster<std::uint8_t> taken(line.width(), line.height());
  Surroundings around(options);
  for (const Corner& corner : corners_of({strength, tangent_x, tangent_y, rounded, options}, work)) {
    const Pixel at{static_cast<int>(std::lround(corner.at.x)), static_cast<int>(std::lround(corner.at.y))};
    if (!line.contains(at.x, at.y) || taken(corner.from.x, corner.from.y) != 0) continue;
    around.find(rounded, corner.from);
    for (const Pixel p : around.core) {
      line(p.x, p.y) = 0.0F;
      taken(p.x, p.y) = 1;
    }
    const float value = 0.5F * (corner.pieces[0].strength + corner.pieces[1].strength);
    for (const Piece& piece : corner.pieces) draw(piece.nearest, at, value, line);
  }
}

}  // namespace palpable::vision
