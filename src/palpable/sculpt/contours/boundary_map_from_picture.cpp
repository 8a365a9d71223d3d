// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sculpt/contours/boundary_map_from_picture.hpp"

#include "palpable/vision/contours/contour_steps.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace palpable::sculpt {

Result<models::BoundaryMap> boundary_map_from_contours(const vision::ContourMap& contours,
                                                       const BoundaryMapOptions& options, const Work& work) {
  const int w = contours.strength.width();
  const int h = contours.strength.height();
  if (w < 2 || h < 2) return invalid_input("a boundary map needs at least 2 x 2 pixels");
  Raster<models::BoundaryPixel> edges(w, h);
  for (std::size_t i = 0; i < edges.count(); ++i) {
    const float tx = contours.tangent_x.values()[i];
    const float ty = -contours.tangent_y.values()[i];
    const float s = contours.strength.values()[i];
    edges.values()[i] = {s * (tx * tx - ty * ty), s * 2.0F * tx * ty};
  }
  const double pixel_m = std::min(options.width_m / w, options.height_m / h);
  return models::BoundaryMap::from_edges(std::move(edges), pixel_m, options.radius_px,
                                         {contours.threshold, contours.boundary_fraction}, work);
}

TangentMap tangents_of(const Raster<models::BoundaryPixel>& pixels) {
  const Raster<float> zero(pixels.width(), pixels.height());
  TangentMap out{zero, zero, zero};
  for (std::size_t i = 0; i < pixels.count(); ++i) {
    const models::BoundaryPixel p = pixels.values()[i];
    const auto [tx, ty] = vision::halve_angle(p.c2, p.s2);
    out.x.values()[i] = tx;
    out.y.values()[i] = -ty;
    out.strength.values()[i] = std::sqrt(p.c2 * p.c2 + p.s2 * p.s2);
  }
  return out;
}

Raster<float> boundary_lines(const models::BoundaryMap& map, const vision::LineOptions& options,
                             const Work& work) {
  const TangentMap e = tangents_of(map.edges());
  return vision::ridge_lines(e.strength, e.x, e.y, map.origin().threshold, options, work);
}

}  // namespace palpable::sculpt
