// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/draw/canvas/figure.hpp"

#include "palpable/core/files/atomic_file.hpp"
#include "palpable/draw/canvas/canvas.hpp"

#include <memory>
#include <span>
#include <string>
#include <vector>

#include <cairo-pdf.h>
#include <cairo-svg.h>
#include <cairo.h>

namespace palpable::draw {
namespace {

using Surface = std::unique_ptr<cairo_surface_t, decltype(&cairo_surface_destroy)>;
using Context = std::unique_ptr<cairo_t, decltype(&cairo_destroy)>;

constexpr double kPointsPerPixel = 72.0 / 96.0;

cairo_status_t append(void* closure, const unsigned char* data, unsigned int length) {
  auto& bytes = *static_cast<std::vector<std::byte>*>(closure);
  const auto* first = reinterpret_cast<const std::byte*>(data);
  bytes.insert(bytes.end(), first, first + length);
  return CAIRO_STATUS_SUCCESS;
}

cairo_status_t paint_on(cairo_surface_t* surface, const Figure& figure, double scale) {
  const Context context(cairo_create(surface), &cairo_destroy);
  cairo_scale(context.get(), scale, scale);
  Canvas canvas(context.get());
  canvas.fill({0.0, 0.0, static_cast<double>(figure.width_px), static_cast<double>(figure.height_px)},
              {255, 255, 255});
  figure.paint(canvas);
  return cairo_status(context.get());
}

cairo_status_t render_png(const Figure& figure, std::vector<std::byte>& bytes) {
  const Surface surface(cairo_image_surface_create(CAIRO_FORMAT_RGB24, figure.width_px, figure.height_px),
                        &cairo_surface_destroy);
  const cairo_status_t painted = paint_on(surface.get(), figure, 1.0);
  return painted != CAIRO_STATUS_SUCCESS ? painted
                                         : cairo_surface_write_to_png_stream(surface.get(), append, &bytes);
}

template <class Create>
cairo_status_t render_vectors(const Figure& figure, std::vector<std::byte>& bytes, Create create) {
  const Surface surface(
      create(append, &bytes, figure.width_px * kPointsPerPixel, figure.height_px * kPointsPerPixel),
      &cairo_surface_destroy);
  const cairo_status_t painted = paint_on(surface.get(), figure, kPointsPerPixel);
  cairo_surface_finish(surface.get());
  return painted != CAIRO_STATUS_SUCCESS ? painted : cairo_surface_status(surface.get());
}

}  // namespace

Result<std::vector<std::byte>> png_of(const Figure& figure) {
  std::vector<std::byte> bytes;
  const cairo_status_t status = render_png(figure, bytes);
  if (status != CAIRO_STATUS_SUCCESS)
    return Error{ErrorCode::failed, std::string("could not be drawn: ") + cairo_status_to_string(status), {}};
  return bytes;
}

Result<void> write_figure(const Figure& figure, const std::filesystem::path& path) {
  const std::string ending = path.extension().string();
  std::vector<std::byte> bytes;
  cairo_status_t status = CAIRO_STATUS_SUCCESS;
  if (ending == ".png") {
    status = render_png(figure, bytes);
  } else if (ending == ".svg") {
    status = render_vectors(figure, bytes, cairo_svg_surface_create_for_stream);
  } else if (ending == ".pdf") {
    status = render_vectors(figure, bytes, cairo_pdf_surface_create_for_stream);
  } else {
    return Error{ErrorCode::usage, "a drawing is written as .png, .svg or .pdf", path.string()};
  }
  if (status != CAIRO_STATUS_SUCCESS)
    return Error{ErrorCode::failed, std::string("could not be drawn: ") + cairo_status_to_string(status),
                 path.string()};
  return write_file_atomically(path, bytes);
}

}  // namespace palpable::draw
