// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/draw/view/force_view.hpp"

#include "palpable/draw/canvas/sheet.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace palpable::draw {
namespace {

constexpr Rgb8 kArrow{20, 60, 140};
constexpr Rgb8 kCutArrow{190, 30, 30};

Raster<Rgb8> lightened(const Raster<Rgb8>& picture) {
  Raster<Rgb8> out = picture;
  const auto lighten = [](std::uint8_t v) { return static_cast<std::uint8_t>(v + (255 - v) * 55 / 100); };
  for (Rgb8& p : out.values()) p = {lighten(p.r), lighten(p.g), lighten(p.b)};
  return out;
}

/// The largest number of the form 1, 2 or 5 times a power of ten that is at most `value`.
double round_down(double value) {
  const double power = std::pow(10.0, std::floor(std::log10(value)));
  for (const double factor : {5.0, 2.0})
    if (factor * power <= value) return factor * power;
  return power;
}

/// The force whose arrow is as long as the spacing: the 90th percentile, so that nine of ten arrows are drawn
/// in full.
double full_force_N(const std::vector<ForceArrow>& arrows) {
  std::vector<double> sizes;
  for (const ForceArrow& a : arrows)
    if (std::isfinite(a.fx_N) && std::isfinite(a.fy_N)) sizes.push_back(std::hypot(a.fx_N, a.fy_N));
  if (sizes.empty()) return 1.0;
  const auto nine_of_ten = sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() * 9 / 10);
  std::nth_element(sizes.begin(), nine_of_ten, sizes.end());
  return *nine_of_ten > 1e-9 ? *nine_of_ten : std::max(*std::max_element(sizes.begin(), sizes.end()), 1e-6);
}

}  // namespace

Figure force_figure(models::Relief relief, const Raster<Rgb8>& texture, std::vector<ForceArrow> arrows,
                    double spacing_m, const FigureTitle& title) {
  const Sheet sheet = sheet_for(relief.size_x_m() / relief.size_y_m());
  const double half_x = 0.5 * kMm * relief.size_x_m(), half_y = 0.5 * kMm * relief.size_y_m();
  const Plot plot{sheet.plot, -half_x, half_x, -half_y, half_y};
  return {
      sheet.width_px, sheet.height_px,
      [backdrop = lightened(texture), arrows = std::move(arrows), spacing_m, title, sheet,
       plot](Canvas& canvas) {
        const double longest_px = 0.95 * kMm * spacing_m / (plot.right - plot.left) * plot.area.width;
        const double full_N = full_force_N(arrows);
        const double px_per_N = longest_px / full_N;
        canvas.picture(backdrop, sheet.plot);
        bool any_cut = false;
        for (const ForceArrow& a : arrows) {
          const double size = std::hypot(a.fx_N, a.fy_N);
          if (!(size * px_per_N > 0.5)) continue;
          const bool cut = size > full_N * 1.001;
          any_cut = any_cut || cut;
          const double scale = std::min(px_per_N, longest_px / size);
          const CanvasPoint centre = plot.at(kMm * a.x_m, kMm * a.y_m);
          const double dx = 0.5 * scale * a.fx_N, dy = -0.5 * scale * a.fy_N;
          canvas.arrow({centre.x - dx, centre.y - dy}, {centre.x + dx, centre.y + dy},
                       {cut ? kCutArrow : kArrow, 1.7});
        }
        draw_axes(canvas, plot, "to the right, mm", "upwards, mm");
        draw_scale_bar(canvas, plot);
        const double known_N = round_down(full_N);
        CanvasPoint key{sheet.bar.x, sheet.plot.y + 12.0};
        key.y += canvas.text("force on the hand", key, {.size_px = 14.0, .bold = true}) + 14.0;
        canvas.arrow({key.x, key.y + 8.0}, {key.x + known_N * px_per_N, key.y + 8.0}, {kArrow, 1.7});
        canvas.text(fmt::format("{:g} N", known_N), {key.x + longest_px + 12.0, key.y}, {.size_px = 14.0});
        if (any_cut) {
          key.y += 34.0;
          canvas.arrow({key.x, key.y + 8.0}, {key.x + longest_px, key.y + 8.0}, {kCutArrow, 1.7});
          canvas.text(fmt::format("over {:.2g} N,\ndrawn short", full_N), {key.x + longest_px + 12.0, key.y},
                      {.size_px = 14.0});
        }
        draw_title_and_caption(
            canvas, sheet, title,
            "The middle of an arrow is the position of the hand; its length is the force in the "
            "picture's plane. No arrow: the force is too small to draw.");
      }};
}

}  // namespace palpable::draw
