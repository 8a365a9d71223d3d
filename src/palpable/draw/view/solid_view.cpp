// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/draw/view/solid_view.hpp"

#include "palpable/core/work.hpp"
#include "palpable/draw/canvas/plot.hpp"
#include "palpable/draw/canvas/relief_shading.hpp"
#include "palpable/draw/canvas/sheet.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>

#include <fmt/format.h>

namespace palpable::draw {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr Rect kPlot{40.0, 100.0, 900.0, 700.0};
/// Rays per pixel of the plot, along each side.
constexpr int kRaysAcross = 2;
constexpr float kNothing = std::numeric_limits<float>::infinity();

/// A pinhole camera that sees all of a ball about the target: its centre and axes.
struct View {
  Vec3 centre, right, up, forward;
  /// Plot pixels per unit of x / depth.
  double focal_px = 0.0;

  Vec3 ray(double x_px, double y_px) const {
    const double x = (x_px - 0.5 * kPlot.width) / focal_px, y = (0.5 * kPlot.height - y_px) / focal_px;
    return unit(forward + x * right + y * up);
  }
  /// The projection of `p`, in pixels of the figure.
  CanvasPoint at(Vec3 p) const {
    const Vec3 v = p - centre;
    const double depth = dot(v, forward);
    return {kPlot.x + 0.5 * kPlot.width + focal_px * dot(v, right) / depth,
            kPlot.y + 0.5 * kPlot.height - focal_px * dot(v, up) / depth};
  }
};

View view_of(Vec3 target, double radius, const SolidViewOptions& options) {
  const double a = options.azimuth_deg * kDegree, e = options.elevation_deg * kDegree;
  const Vec3 back{std::sin(a) * std::cos(e), std::sin(e), std::cos(a) * std::cos(e)};
  View view;
  view.centre = target + (radius / std::sin(options.half_angle_deg * kDegree)) * back;
  view.forward = -back;
  view.right = {std::cos(a), 0.0, -std::sin(a)};
  view.up = cross(view.right, view.forward);
  view.focal_px = 0.5 * std::min(kPlot.width, kPlot.height) / std::tan(options.half_angle_deg * kDegree);
  return view;
}

/// The ray's interval inside the box; nullopt if it misses the box.
std::optional<std::pair<double, double>> clip_to_box(Vec3 origin, Vec3 ray, Vec3 least, Vec3 most) {
  double in = 0.0, out = std::numeric_limits<double>::max();
  const std::array o{origin.x, origin.y, origin.z}, d{ray.x, ray.y, ray.z}, a{least.x, least.y, least.z},
      b{most.x, most.y, most.z};
  for (std::size_t k = 0; k < 3; ++k) {
    if (std::abs(d[k]) < 1e-12) {
      if (o[k] < a[k] || o[k] > b[k]) return std::nullopt;
      continue;
    }
    const double t1 = (a[k] - o[k]) / d[k], t2 = (b[k] - o[k]) / d[k];
    in = std::max(in, std::min(t1, t2));
    out = std::min(out, std::max(t1, t2));
  }
  if (in > out) return std::nullopt;
  return std::pair(in, out);
}

/// Sphere tracing (Hart 1996): the distance along the ray to the surface, kNothing if the ray misses it.
template <models::DistanceSurface Distance>
double surface_along(const Distance& field, const View& view, Vec3 ray, Vec3 least, Vec3 most) {
  const auto span = clip_to_box(view.centre, ray, least, most);
  if (!span) return kNothing;
  constexpr double kShare = 0.9;
  const double shortest_m = 0.1 * field.cell_m();
  double before = span->first;
  for (double t = span->first; t <= span->second;) {
    const double distance_m = field.sample({view.centre + t * ray}).distance_m;
    if (distance_m <= 0.0) {
      constexpr int kHalvings = 8;
      double inside = t;
      for (int k = 0; k < kHalvings; ++k) {
        const double middle = 0.5 * (before + inside);
        (field.sample({view.centre + middle * ray}).distance_m > 0.0 ? before : inside) = middle;
      }
      return 0.5 * (before + inside);
    }
    before = t;
    t += std::max(kShare * distance_m, shortest_m);
  }
  return kNothing;
}

/// Ambient occlusion from the distance field (Evans 2006): 1 in the open, towards 0 in hollows.
template <models::DistanceSurface Distance>
double ambient_occlusion(const Distance& field, Vec3 place, Vec3 normal, double reach_m) {
  constexpr int kSteps = 4;
  double hidden = 0.0, weight = 0.5;
  for (int k = 1; k <= kSteps; ++k, weight *= 0.5) {
    const double away_m = reach_m * k / kSteps;
    hidden += weight * std::max(0.0, away_m - field.sample({place + away_m * normal}).distance_m) / away_m;
  }
  return std::clamp(1.0 - 1.2 * hidden, 0.25, 1.0);
}

struct Rendered {
  Raster<Rgb8> picture;
  /// Along each ray, metres; kNothing where the ray misses the solid.
  Raster<float> depth_m;
};

template <models::DistanceSurface Distance>
Rendered rendered(const Distance& field, const View& view, Vec3 least, Vec3 most) {
  constexpr Rgb8 kClay{214, 196, 168}, kBackground{250, 250, 250};
  const int width = static_cast<int>(kPlot.width) * kRaysAcross,
            height = static_cast<int>(kPlot.height) * kRaysAcross;
  Rendered out{Raster<Rgb8>(width, height, kBackground), Raster<float>(width, height, kNothing)};
  const Vec3 light = unit(-1.0 * view.right + 1.2 * view.up - 1.1 * view.forward);
  const double radius_m = 0.5 * norm(most - least), middle_m = norm(0.5 * (least + most) - view.centre);
  constexpr int kRows = 8;
  parallel_for({}, height, kRows, [&](int begin, int end) {
    for (int j = begin; j < end; ++j)
      for (int i = 0; i < width; ++i) {
        const Vec3 ray = view.ray((i + 0.5) / kRaysAcross, (j + 0.5) / kRaysAcross);
        const double t = surface_along(field, view, ray, least, most);
        if (t == static_cast<double>(kNothing)) continue;
        out.depth_m(i, j) = static_cast<float>(t);
        const Vec3 place = view.centre + t * ray;
        const Vec3 normal = unit(field.sample({place}).gradient.v);
        const double lit = 0.35 + 0.75 * std::max(0.0, dot(normal, light));
        const double rim = std::clamp(0.55 + 1.5 * std::abs(dot(normal, ray)), 0.0, 1.0);
        const double shade = lit * rim * ambient_occlusion(field, place, normal, 0.12 * radius_m);
        // Farther points are paler, by up to a third.
        const double haze = std::clamp(0.5 + 0.5 * (t - middle_m) / radius_m, 0.0, 1.0) * 0.33;
        const Rgb8 own = shaded(kClay, shade);
        const auto mixed = [haze](std::uint8_t a, std::uint8_t b) {
          return static_cast<std::uint8_t>(std::lround(a + haze * (b - a)));
        };
        out.picture(i, j) = {mixed(own.r, kBackground.r), mixed(own.g, kBackground.g),
                             mixed(own.b, kBackground.b)};
      }
  });
  return out;
}

Vec3 corner_of(Vec3 least, Vec3 most, unsigned k) {
  return {(k & 1U) != 0 ? most.x : least.x, (k & 2U) != 0 ? most.y : least.y,
          (k & 4U) != 0 ? most.z : least.z};
}

/// An edge of the box, drawn piece by piece and only where the solid does not hide it.
void draw_edge(Canvas& canvas, const View& view, const Raster<float>& depth_m, Vec3 from, Vec3 to) {
  constexpr int kPieces = 96;
  for (int k = 0; k < kPieces; ++k) {
    const Vec3 a = from + (static_cast<double>(k) / kPieces) * (to - from),
               b = from + (static_cast<double>(k + 1) / kPieces) * (to - from), middle = 0.5 * (a + b);
    const CanvasPoint at = view.at(middle);
    const int i = static_cast<int>((at.x - kPlot.x) * kRaysAcross),
              j = static_cast<int>((at.y - kPlot.y) * kRaysAcross);
    const bool hidden =
        depth_m.contains(i, j) && static_cast<double>(depth_m(i, j)) < norm(middle - view.centre) - 1e-4;
    if (!hidden) canvas.line(view.at(a), view.at(b), {{90, 90, 110}, 1.0, 0.7});
  }
}

/// The box's twelve edges, and the lengths of the three that meet at the lower corner nearest to the camera.
void draw_box(Canvas& canvas, const View& view, const Raster<float>& depth_m, Vec3 least, Vec3 most) {
  for (unsigned k = 0; k < 8; ++k)
    for (const unsigned axis : {1U, 2U, 4U})
      if ((k & axis) == 0)
        draw_edge(canvas, view, depth_m, corner_of(least, most, k), corner_of(least, most, k | axis));
  unsigned nearest = 0;
  for (const unsigned k : {0U, 1U, 4U, 5U})
    if (norm(corner_of(least, most, k) - view.centre) < norm(corner_of(least, most, nearest) - view.centre))
      nearest = k;
  const Vec3 size_mm = kMm * (most - least);
  const auto label = [&](unsigned axis, double length_mm, const char* direction) {
    // The vertical label is at the rightmost vertical edge.
    unsigned from = nearest;
    if (axis == 2U)
      for (const unsigned k : {0U, 1U, 4U, 5U})
        if (view.at(corner_of(least, most, k)).x > view.at(corner_of(least, most, from)).x) from = k;
    const CanvasPoint a = view.at(corner_of(least, most, from)),
                      b = view.at(corner_of(least, most, from ^ axis));
    const CanvasPoint middle{0.5 * (a.x + b.x), 0.5 * (a.y + b.y)};
    const std::string text = fmt::format("{} mm {}", label_of(length_mm, 0.1), direction);
    // The label is outside the box.
    const bool at_left = axis != 2U && middle.x < view.at(0.5 * (least + most)).x;
    canvas.text(text, {middle.x + (at_left ? -10.0 : 10.0), middle.y + (axis == 2U ? -8.0 : 6.0)},
                {.size_px = 14.0, .align = at_left ? Align::right : Align::left, .rim = true});
  };
  label(1U, size_mm.x, "to the right");
  label(2U, size_mm.y, "up");
  label(4U, size_mm.z, "towards you");
}

template <models::DistanceSurface Distance>
Figure figure_of(std::shared_ptr<const models::SolidField<Distance>> field, const SolidViewOptions& options,
                 const FigureTitle& title) {
  constexpr double kRight_px = 60.0, kBelow_px = 80.0;
  return {static_cast<int>(kPlot.right() + kRight_px), static_cast<int>(kPlot.bottom() + kBelow_px),
          [field = std::move(field), options, title](Canvas& canvas) {
            const Vec3 least = field->least_m, most = field->most_m;
            const View view = view_of(0.5 * (least + most), 0.5 * norm(most - least), options);
            // A margin beyond the box, so that rays meet a face in the box's plane from outside.
            const double beyond_m = 2.0 * field->distance.cell_m();
            const Vec3 margin{beyond_m, beyond_m, beyond_m};
            const Rendered solid = rendered(field->distance, view, least - margin, most + margin);
            draw_title(canvas, title, kPlot.x, kPlot.width);
            canvas.picture(solid.picture, kPlot);
            draw_box(canvas, view, solid.depth_m, least, most);
            canvas.text(
                fmt::format("Seen in perspective from {} degrees to the {} and {} degrees {}. Paler is "
                            "farther away. Edges of the bounding box are drawn where they are visible.",
                            label_of(std::abs(options.azimuth_deg), 1.0),
                            options.azimuth_deg < 0.0 ? "left" : "right",
                            label_of(std::abs(options.elevation_deg), 1.0),
                            options.elevation_deg < 0.0 ? "below" : "above"),
                {kPlot.x, kPlot.bottom() + 20.0},
                {.size_px = 13.0, .colour = {80, 80, 80}, .wrap_px = kPlot.width});
          }};
}

}  // namespace

std::vector<Parameter> parameters_of(SolidViewOptions& o) {
  return {
      {"azimuth_deg", &o.azimuth_deg, {-180.0, 180.0}, "degrees", "camera's azimuth, positive to the right"},
      {"elevation_deg", &o.elevation_deg, {-89.0, 89.0}, "degrees", "camera's elevation"},
      {"half_angle_deg", &o.half_angle_deg, {2.0, 40.0}, "degrees", "half of the solid's angular size"}};
}

Figure solid_figure(std::shared_ptr<const models::Field> field, const SolidViewOptions& options,
                    const FigureTitle& title) {
  return figure_of(std::move(field), options, title);
}

Figure solid_figure(std::shared_ptr<const models::FieldOnLattice> field, const SolidViewOptions& options,
                    const FigureTitle& title) {
  return figure_of(std::move(field), options, title);
}

}  // namespace palpable::draw
