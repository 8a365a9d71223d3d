// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/draw/view/marks_view.hpp"

#include "palpable/core/check.hpp"
#include "palpable/draw/canvas/canvas.hpp"
#include "palpable/draw/canvas/sheet.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

namespace palpable::draw {
namespace {

/// Tinted pixels keep part of their brightness. Each kind of mark has stripes of its own period, so that
/// kinds can be distinguished without colour.
Rgb8 tinted(Rgb8 pixel, Rgb8 colour, int x, int y, int kind) {
  const double luma = (0.299 * pixel.r + 0.587 * pixel.g + 0.114 * pixel.b) / 255.0;
  const bool stripe = (x + y) / (3 + 2 * kind) % 2 == 0;
  const double light = 0.55 + 0.45 * luma, share = stripe ? 0.85 : 0.6;
  const auto mix = [&](std::uint8_t from, std::uint8_t to) {
    return static_cast<std::uint8_t>(std::lround((1.0 - share) * from + share * light * to));
  };
  return {mix(pixel.r, colour.r), mix(pixel.g, colour.g), mix(pixel.b, colour.b)};
}

}  // namespace

Figure marks_figure(Raster<Rgb8> picture, Raster<std::uint8_t> marks, std::vector<Mark> kinds,
                    const FigureTitle& title, const std::string& caption) {
  PALPABLE_CHECK(picture.width() == marks.width() && picture.height() == marks.height());
  const Sheet sheet = sheet_for(static_cast<double>(picture.width()) / picture.height());
  return {
      sheet.width_px, sheet.height_px,
      [=, picture = std::move(picture), marks = std::move(marks), kinds = std::move(kinds)](Canvas& canvas) {
        Raster<Rgb8> pixels = picture;
        std::vector<double> counts(kinds.size() + 1);
        for (int y = 0; y < pixels.height(); ++y)
          for (int x = 0; x < pixels.width(); ++x) {
            const int k = marks(x, y);
            if (k > static_cast<int>(kinds.size())) continue;
            counts[static_cast<std::size_t>(k)] += 1.0;
            if (k > 0)
              pixels(x, y) = tinted(pixels(x, y), kinds[static_cast<std::size_t>(k - 1)].colour, x, y, k);
          }
        canvas.picture(pixels, sheet.plot);
        const Plot plot{sheet.plot, 0.0, 1.0 * pixels.width(), 1.0 * pixels.height(), 0.0};
        draw_axes(canvas, plot, "columns, pixels", "rows, pixels");
        double y = sheet.plot.y + 8.0;
        for (std::size_t k = 0; k < kinds.size(); ++k) {
          const Rect key{sheet.bar.x - 14.0, y, 26.0, 20.0};
          Raster<Rgb8> swatch(26, 20, {200, 200, 200});
          for (int v = 0; v < 20; ++v)
            for (int u = 0; u < 26; ++u)
              swatch(u, v) = tinted(swatch(u, v), kinds[k].colour, u, v, static_cast<int>(k) + 1);
          canvas.picture(swatch, key);
          canvas.frame(key, {{70, 70, 70}, 1.2});
          const double share = 100.0 * counts[k + 1] / static_cast<double>(pixels.count());
          y +=
              14.0 + canvas.text(fmt::format("{}, {:.0f} %", kinds[k].meaning, share), {key.right() + 8.0, y},
                                 {.size_px = 13.0, .wrap_px = sheet.width_px - key.right() - 16.0});
        }
        draw_title_and_caption(canvas, sheet, title, caption);
      }};
}

}  // namespace palpable::draw
