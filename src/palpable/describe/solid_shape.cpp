// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/describe/solid_shape.hpp"

#include "palpable/core/check.hpp"
#include "palpable/describe/skeleton.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace palpable::describe {
namespace {

// Around the solid, so that an opening at the raster's rim is open there.
constexpr int kRim_px = 2;

/// The same surface with a rim at the base.
models::Relief with_rim(const models::Relief& surface, double base_m) {
  const auto& samples = surface.samples_m();
  Raster<float> wide(samples.width() + 2 * kRim_px, samples.height() + 2 * kRim_px,
                     static_cast<float>(base_m));
  for (int y = 0; y < samples.height(); ++y)
    for (int x = 0; x < samples.width(); ++x) wide(x + kRim_px, y + kRim_px) = samples(x, y);
  auto relief = models::Relief::from_samples(std::move(wide), surface.pixel_m());
  PALPABLE_CHECK(relief);
  return *std::move(relief);
}

/// Mask of the solid seen from above.
Mask outline_of(const models::Relief& surface) {
  const auto& samples = surface.samples_m();
  const double low_m = surface.lowest_m(), size_m = surface.highest_m() - low_m;
  Mask mask(samples.width(), samples.height(), 0);
  for (std::size_t k = 0; k < mask.count(); ++k)
    mask.values()[k] = is_of_solid(double{samples.values()[k]} - low_m, size_m) ? 1 : 0;
  return mask;
}

/// The mask with its holes filled.
Mask filled(const Mask& mask) {
  Raster<int> outside(mask.width(), mask.height(), 0);
  flood(mask, {0, 0}, 1, outside, Connected::over_sides);
  Mask whole(mask.width(), mask.height(), 0);
  for (std::size_t k = 0; k < whole.count(); ++k) whole.values()[k] = outside.values()[k] == 0 ? 1 : 0;
  return whole;
}

struct PixelBox {
  int left = 0, right = 0, top = 0, bottom = 0;
  int width() const { return right - left + 1; }
  int height() const { return bottom - top + 1; }
};

PixelBox box_of(const std::vector<Pixel>& pixels) {
  PixelBox box{pixels[0].x, pixels[0].x, pixels[0].y, pixels[0].y};
  for (const Pixel p : pixels)
    box = {std::min(box.left, p.x), std::max(box.right, p.x), std::min(box.top, p.y),
           std::max(box.bottom, p.y)};
  return box;
}

/// Intersection over union of the outline and the shape `other(x, y)`, within the outline's box.
template <class Other>
double overlap(const Mask& mask, const PixelBox& box, const Other& other) {
  int both = 0, either = 0;
  for (int y = box.top; y <= box.bottom; ++y)
    for (int x = box.left; x <= box.right; ++x) {
      const bool a = mask(x, y) != 0, b = other(x, y);
      both += a && b ? 1 : 0;
      either += a || b ? 1 : 0;
    }
  return static_cast<double>(both) / std::max(1, either);
}

OutlineKind outline_kind(const Mask& mask, const PixelBox& box, double alike) {
  const double half_x = 0.5 * box.width(), half_y = 0.5 * box.height();
  const double rectangle = overlap(mask, box, [](int, int) { return true; });
  const double ellipse = overlap(mask, box, [&](int x, int y) {
    return std::hypot((x - box.left + 0.5 - half_x) / half_x, (y - box.top + 0.5 - half_y) / half_y) <= 1.0;
  });
  if (std::max(rectangle, ellipse) < alike) return OutlineKind::other;
  if (rectangle >= ellipse) return OutlineKind::rectangular;
  return std::min(half_x, half_y) >= alike * std::max(half_x, half_y) ? OutlineKind::round
                                                                      : OutlineKind::oval;
}

Pixel pixel_at(const models::Relief& surface, Place place) {
  const auto at = [](double share, int count) {
    return std::clamp(static_cast<int>(std::floor(share * count)), 0, count - 1);
  };
  return {at(place.x_m / surface.size_x_m() + 0.5, surface.samples_m().width()),
          at(0.5 - place.y_m / surface.size_y_m(), surface.samples_m().height())};
}

class Openings {
 public:
  Openings(const models::Relief& surface, const Mask& mask, std::size_t least_pixels)
      : surface_(surface), mask_(mask), least_pixels_(least_pixels), marks_(mask.width(), mask.height(), 0) {
    flood(mask, {0, 0}, 1, marks_, Connected::over_sides);
  }

  /// Areas outside the solid that it encloses.
  void add_holes(std::vector<Opening>& openings) {
    for (int y = 0; y < mask_.height(); ++y)
      for (int x = 0; x < mask_.width(); ++x) {
        if (mask_(x, y) != 0 || marks_(x, y) != 0) continue;
        const auto pixels = flood(mask_, {x, y}, 2, marks_, Connected::over_sides);
        if (pixels.size() < least_pixels_) continue;
        openings.push_back(opening(pixels, surface_.highest_m() - surface_.lowest_m(), true));
      }
  }

  /// `pits`: the peaks of the inverted surface.
  void add_hollows(const std::vector<Peak>& pits, std::vector<Opening>& openings) {
    for (const Peak& pit : pits) {
      const Pixel at = pixel_at(surface_, pit.place);
      if (mask_(at.x, at.y) == 0) continue;
      Mask below(mask_.width(), mask_.height(), 0);
      const double half_m = pit.height_m + 0.5 * pit.prominence_m;
      for (std::size_t k = 0; k < below.count(); ++k)
        below.values()[k] =
            double{surface_.samples_m().values()[k]} <= half_m && mask_.values()[k] != 0 ? 1 : 0;
      if (below(at.x, at.y) == 0) continue;
      Raster<int> seen(mask_.width(), mask_.height(), 0);
      openings.push_back(opening(flood(below, at, 1, seen, Connected::over_sides), pit.prominence_m, false));
    }
  }

 private:
  Opening opening(const std::vector<Pixel>& pixels, double depth_m, bool through) const {
    const PixelBox box = box_of(pixels);
    const double pixel_m = surface_.pixel_m();
    return {{pixel_m * (0.5 * (box.left + box.right + 1) - 0.5 * mask_.width()),
             pixel_m * (0.5 * mask_.height() - 0.5 * (box.top + box.bottom + 1))},
            pixel_m * box.width(),
            pixel_m * box.height(),
            depth_m,
            through};
  }

  const models::Relief& surface_;
  const Mask& mask_;
  std::size_t least_pixels_;
  Raster<int> marks_;
};

/// Gives a part the height of the highest sample beside its place: between samples thin tops are lower.
void raise_to_samples(const models::Relief& surface, Peak& part) {
  const auto& samples = surface.samples_m();
  const Pixel at = pixel_at(surface, part.place);
  double highest_m = part.height_m;
  for (int y = std::max(0, at.y - 1); y <= std::min(samples.height() - 1, at.y + 1); ++y)
    for (int x = std::max(0, at.x - 1); x <= std::min(samples.width() - 1, at.x + 1); ++x)
      highest_m = std::max(highest_m, double{samples(x, y)});
  part.prominence_m += highest_m - part.height_m;
  part.height_m = highest_m;
}

/// Whether the heights of a solid differ by less than `least_m`, without the pixels at its outline.
bool is_flat_solid(const models::Relief& surface, const Mask& mask, double least_m) {
  const auto& samples = surface.samples_m();
  double lowest_m = surface.highest_m();
  for (int y = 1; y + 1 < mask.height(); ++y)
    for (int x = 1; x + 1 < mask.width(); ++x)
      if (mask(x, y) != 0 && mask(x - 1, y) != 0 && mask(x + 1, y) != 0 && mask(x, y - 1) != 0 &&
          mask(x, y + 1) != 0)
        lowest_m = std::min(lowest_m, double{samples(x, y)});
  return surface.highest_m() - lowest_m < least_m;
}

/// The highest place: of the highest part, or the highest sample if there is none.
void set_highest(const models::Relief& surface, SolidShape& shape) {
  const auto part = std::max_element(shape.parts.begin(), shape.parts.end(),
                                     [](const Peak& a, const Peak& b) { return a.height_m < b.height_m; });
  constexpr double kTop = 0.01;
  const double range_m = surface.highest_m() - surface.lowest_m();
  if (part != shape.parts.end() && part->height_m >= surface.highest_m() - kTop * range_m) {
    shape.highest = part->place;
    shape.highest_m = part->height_m;
    return;
  }
  const auto& samples = surface.samples_m();
  const auto most = static_cast<int>(std::max_element(samples.values().begin(), samples.values().end()) -
                                     samples.values().begin());
  shape.highest = {(most % samples.width() + 0.5 - 0.5 * samples.width()) * surface.pixel_m(),
                   (0.5 * samples.height() - most / samples.width() - 0.5) * surface.pixel_m()};
  shape.highest_m = surface.highest_m();
}

}  // namespace

std::vector<Parameter> parameters_of(SolidShapeOptions& o) {
  return {{"least_prominence", &o.least_prominence, {0.0, 1.0}, "", "least part, as a share of the height"},
          {"least_area", &o.least_area, {0.0, 1.0}, "", "least part, as a share of the area"},
          {"alike", &o.alike, {0.5, 1.0}, "", "overlap from which an outline is called by a shape"}};
}

SolidShape solid_shape(const models::Relief& from_above, double base_m, const SolidShapeOptions& options) {
  PALPABLE_CHECK(check_ranges(options));
  const models::Relief surface = with_rim(from_above, base_m);
  const Mask mask = outline_of(surface);
  SolidShape shape;
  std::vector<Pixel> all;
  Raster<int> marks(mask.width(), mask.height(), 0);
  for (int y = 0; y < mask.height(); ++y)
    for (int x = 0; x < mask.width(); ++x)
      if (mask(x, y) != 0) all.push_back({x, y});
  if (all.empty()) return shape;
  const PixelBox box = box_of(all);
  const auto least_pixels =
      static_cast<std::size_t>(std::ceil(options.least_area * box.width() * box.height()));
  for (const Pixel p : all)
    if (marks(p.x, p.y) == 0 && flood(mask, p, 1, marks, Connected::over_corners_too).size() >= least_pixels)
      ++shape.pieces;
  const Mask whole = filled(mask);
  shape.outline = outline_kind(whole, box, options.alike);
  shape.left_right =
      overlap(whole, box, [&](int x, int y) { return whole(box.left + box.right - x, y) != 0; });
  shape.top_bottom =
      overlap(whole, box, [&](int x, int y) { return whole(x, box.top + box.bottom - y) != 0; });
  PeakOptions peaks;
  peaks.least_prominence = options.least_prominence;
  peaks.least_area = options.least_area;
  // A solid has a base; a tilted face of it is no ground.
  peaks.above_ground = false;
  peaks.longest_side = std::max(surface.samples_m().width(), surface.samples_m().height());
  shape.parts = find_peaks(surface, peaks);
  for (Peak& part : shape.parts) raise_to_samples(surface, part);
  shape.is_flat =
      is_flat_solid(surface, mask, options.least_prominence * (surface.highest_m() - surface.lowest_m()));
  set_highest(surface, shape);
  Openings openings(surface, mask, least_pixels);
  openings.add_holes(shape.openings);
  peaks.turned_over = true;
  openings.add_hollows(find_peaks(surface, peaks), shape.openings);
  std::stable_sort(shape.openings.begin(), shape.openings.end(), [](const Opening& a, const Opening& b) {
    return a.width_m * a.height_m > b.width_m * b.height_m;
  });
  return shape;
}

}  // namespace palpable::describe
