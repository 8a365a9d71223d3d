// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/draw/canvas/canvas.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <span>
#include <string>

#include <pango/pangocairo.h>

namespace palpable::draw {
namespace {

using Surface = std::unique_ptr<cairo_surface_t, decltype(&cairo_surface_destroy)>;
using Pattern = std::unique_ptr<cairo_pattern_t, decltype(&cairo_pattern_destroy)>;
using Layout = std::unique_ptr<PangoLayout, decltype(&g_object_unref)>;

constexpr Rgb8 kHatchGround{232, 232, 232};
constexpr Rgb8 kHatchLine{150, 150, 150};

void set_colour(cairo_t* context, Rgb8 c, double alpha) {
  cairo_set_source_rgba(context, c.r / 255.0, c.g / 255.0, c.b / 255.0, alpha);
}

Surface surface_of(const Raster<Rgb8>& pixels) {
  Surface surface(cairo_image_surface_create(CAIRO_FORMAT_RGB24, pixels.width(), pixels.height()),
                  &cairo_surface_destroy);
  if (cairo_surface_status(surface.get()) != CAIRO_STATUS_SUCCESS) return surface;
  cairo_surface_flush(surface.get());
  unsigned char* data = cairo_image_surface_get_data(surface.get());
  const int stride = cairo_image_surface_get_stride(surface.get());
  for (int y = 0; y < pixels.height(); ++y) {
    auto* row = reinterpret_cast<std::uint32_t*>(data + static_cast<std::ptrdiff_t>(y) * stride);
    for (int x = 0; x < pixels.width(); ++x) {
      const Rgb8 p = pixels(x, y);
      row[x] = (static_cast<std::uint32_t>(p.r) << 16U) | (static_cast<std::uint32_t>(p.g) << 8U) | p.b;
    }
  }
  cairo_surface_mark_dirty(surface.get());
  return surface;
}

Surface alpha_of(const Raster<std::uint8_t>& mask) {
  Surface surface(cairo_image_surface_create(CAIRO_FORMAT_A8, mask.width(), mask.height()),
                  &cairo_surface_destroy);
  if (cairo_surface_status(surface.get()) != CAIRO_STATUS_SUCCESS) return surface;
  cairo_surface_flush(surface.get());
  unsigned char* data = cairo_image_surface_get_data(surface.get());
  const int stride = cairo_image_surface_get_stride(surface.get());
  for (int y = 0; y < mask.height(); ++y)
    for (int x = 0; x < mask.width(); ++x)
      data[static_cast<std::ptrdiff_t>(y) * stride + x] = mask(x, y) != 0 ? 255 : 0;
  cairo_surface_mark_dirty(surface.get());
  return surface;
}

Layout layout_of(cairo_t* context, std::string_view utf8, const TextStyle& style) {
  Layout layout(pango_cairo_create_layout(context), &g_object_unref);
  PangoFontDescription* font = pango_font_description_new();
  pango_font_description_set_family(font, "DejaVu Sans, Noto Sans, sans-serif");
  pango_font_description_set_absolute_size(font, style.size_px * PANGO_SCALE);
  pango_font_description_set_weight(font, style.bold ? PANGO_WEIGHT_BOLD : PANGO_WEIGHT_NORMAL);
  pango_layout_set_font_description(layout.get(), font);
  pango_font_description_free(font);
  // A file name may hold any bytes; Pango wants UTF-8.
  char* valid = g_utf8_make_valid(utf8.data(), static_cast<gssize>(utf8.size()));
  pango_layout_set_text(layout.get(), valid, -1);
  g_free(valid);
  if (style.wrap_px > 0.0) {
    pango_layout_set_width(layout.get(), static_cast<int>(style.wrap_px * PANGO_SCALE));
    pango_layout_set_wrap(layout.get(), PANGO_WRAP_WORD_CHAR);
    constexpr std::array kAlign{PANGO_ALIGN_LEFT, PANGO_ALIGN_CENTER, PANGO_ALIGN_RIGHT};
    pango_layout_set_alignment(layout.get(), kAlign[static_cast<std::size_t>(style.align)]);
  }
  return layout;
}

CanvasPoint size_of(PangoLayout* layout) {
  int width = 0, height = 0;
  pango_layout_get_size(layout, &width, &height);
  return {static_cast<double>(width) / PANGO_SCALE, static_cast<double>(height) / PANGO_SCALE};
}

}  // namespace

void Canvas::set_stroke(StrokeStyle style) {
  set_colour(context_, style.colour, style.alpha);
  cairo_set_line_width(context_, style.width);
}

void Canvas::fill(Rect area, Rgb8 colour, double alpha) {
  set_colour(context_, colour, alpha);
  cairo_rectangle(context_, area.x, area.y, area.width, area.height);
  cairo_fill(context_);
}

void Canvas::frame(Rect area, StrokeStyle style) {
  set_stroke(style);
  cairo_rectangle(context_, area.x, area.y, area.width, area.height);
  cairo_stroke(context_);
}

void Canvas::line(CanvasPoint from, CanvasPoint to, StrokeStyle style) { path(std::array{from, to}, style); }

void Canvas::path(std::span<const CanvasPoint> points, StrokeStyle style) {
  if (points.empty()) return;
  set_stroke(style);
  cairo_set_line_join(context_, CAIRO_LINE_JOIN_ROUND);
  cairo_move_to(context_, points.front().x, points.front().y);
  for (const CanvasPoint point : points.subspan(1)) cairo_line_to(context_, point.x, point.y);
  cairo_stroke(context_);
}

void Canvas::polygon(std::span<const CanvasPoint> points, Rgb8 colour, double alpha) {
  if (points.empty()) return;
  set_colour(context_, colour, alpha);
  cairo_move_to(context_, points.front().x, points.front().y);
  for (const CanvasPoint point : points.subspan(1)) cairo_line_to(context_, point.x, point.y);
  cairo_close_path(context_);
  cairo_fill(context_);
}

void Canvas::disc(CanvasPoint centre, double radius, Rgb8 colour, double alpha) {
  set_colour(context_, colour, alpha);
  cairo_new_sub_path(context_);
  cairo_arc(context_, centre.x, centre.y, radius, 0.0, 6.283185307179586);
  cairo_fill(context_);
}

void Canvas::arrow(CanvasPoint from, CanvasPoint to, StrokeStyle style) {
  const double dx = to.x - from.x, dy = to.y - from.y;
  const double length = std::hypot(dx, dy);
  if (length <= 0.0) return;
  const double ux = dx / length, uy = dy / length;
  const double head = std::min(3.6 * style.width + 2.0, length);
  const double half = 0.42 * head;
  const CanvasPoint neck{to.x - head * ux, to.y - head * uy};
  const std::array tip{to, CanvasPoint{neck.x - half * uy, neck.y + half * ux},
                       CanvasPoint{neck.x + half * uy, neck.y - half * ux}};
  cairo_set_line_cap(context_, CAIRO_LINE_CAP_ROUND);
  constexpr Rgb8 kRim{255, 255, 255};
  for (const bool rim : {true, false}) {
    const StrokeStyle stroke = rim ? StrokeStyle{kRim, style.width + 1.8, 0.75} : style;
    line(from, neck, stroke);
    if (rim) {
      const std::array outline{tip[0], tip[1], tip[2], tip[0]};
      path(outline, {kRim, 1.8, 0.75});
    }
    polygon(tip, stroke.colour, style.alpha);
  }
}

void Canvas::picture(const Raster<Rgb8>& pixels, Rect area) {
  if (pixels.empty()) return;
  const Surface surface = surface_of(pixels);
  cairo_save(context_);
  cairo_rectangle(context_, area.x, area.y, area.width, area.height);
  cairo_clip(context_);
  cairo_translate(context_, area.x, area.y);
  cairo_scale(context_, area.width / pixels.width(), area.height / pixels.height());
  cairo_set_source_surface(context_, surface.get(), 0.0, 0.0);
  cairo_pattern_set_filter(cairo_get_source(context_), CAIRO_FILTER_GOOD);
  cairo_pattern_set_extend(cairo_get_source(context_), CAIRO_EXTEND_PAD);
  cairo_paint(context_);
  cairo_restore(context_);
}

void Canvas::hatch(Rect area) {
  cairo_save(context_);
  cairo_rectangle(context_, area.x, area.y, area.width, area.height);
  cairo_clip(context_);
  fill(area, kHatchGround);
  constexpr double kStep = 8.0;
  for (double x = area.x - area.height; x < area.right(); x += kStep)
    line({x, area.bottom()}, {x + area.height, area.y}, {kHatchLine, 1.4});
  cairo_restore(context_);
}

void Canvas::hatch(const Raster<std::uint8_t>& mask, Rect area) {
  if (mask.empty()) return;
  const Surface surface = alpha_of(mask);
  const Pattern pattern(cairo_pattern_create_for_surface(surface.get()), &cairo_pattern_destroy);
  cairo_matrix_t pixels_from_area;
  cairo_matrix_init_scale(&pixels_from_area, mask.width() / area.width, mask.height() / area.height);
  cairo_matrix_translate(&pixels_from_area, -area.x, -area.y);
  cairo_pattern_set_matrix(pattern.get(), &pixels_from_area);
  cairo_pattern_set_filter(pattern.get(), CAIRO_FILTER_NEAREST);
  cairo_push_group(context_);
  hatch(area);
  cairo_pop_group_to_source(context_);
  cairo_mask(context_, pattern.get());
}

CanvasPoint Canvas::text_size(std::string_view utf8, const TextStyle& style) {
  return size_of(layout_of(context_, utf8, style).get());
}

double Canvas::text(std::string_view utf8, CanvasPoint at, const TextStyle& style) {
  const Layout layout = layout_of(context_, utf8, style);
  const CanvasPoint size = size_of(layout.get());
  const double width = style.wrap_px > 0.0 ? style.wrap_px : size.x;
  const double shift = style.align == Align::left ? 0.0 : style.align == Align::centre ? width / 2.0 : width;
  cairo_save(context_);
  cairo_translate(context_, at.x, at.y);
  if (style.upward) cairo_rotate(context_, -1.5707963267948966);
  cairo_move_to(context_, -shift, 0.0);
  if (style.rim) {
    pango_cairo_layout_path(context_, layout.get());
    cairo_set_line_join(context_, CAIRO_LINE_JOIN_ROUND);
    set_stroke({{255, 255, 255}, 3.5, 0.9});
    cairo_stroke(context_);
    cairo_move_to(context_, -shift, 0.0);
  }
  set_colour(context_, style.colour, 1.0);
  pango_cairo_show_layout(context_, layout.get());
  cairo_restore(context_);
  return size.y;
}

}  // namespace palpable::draw
