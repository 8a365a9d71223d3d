// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/picture/image.hpp"
#include "palpable/core/vec3.hpp"
#include "palpable/study/simulated/closed_line.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace palpable::study {

/// A picture to trace with its nominal line, as in "Design and implementation of a graphic-haptic display
/// system" (2006): practice lines and semicircles, and the three pictures of its figure 8.
struct TracingFigure {
  /// "rectangle", "letter-h", "ultrasound", "line-045", "semicircle-090", …
  std::string name;
  /// 8-bit grey, dark on light.
  Raster<std::uint8_t> picture;
  /// Size of a pixel if the picture covers the paper's device, 14 x 10 cm.
  double pixel_m = 0.0;
  /// The nominal line in the plane z = 0 of the scene frame, m.
  std::vector<Vec3> nominal;
  LineByLength::Ends ends = LineByLength::Ends::closed;
};

/// The paper does not state sizes. Here the outlines are 260, 352 and 72 mm long, proportional to the paper's
/// times without assistance (26.1, 35.3 and 7.3 s). Each picture has 700 x 500 pixels with antialiased edges.
TracingFigure rectangle_figure();
TracingFigure letter_h_figure();
/// A dark region with a smooth outline in fully developed speckle (Burckhardt 1978): the magnitude of a
/// smoothed complex Gaussian field, 12 dB lower inside, attenuated with depth, log-compressed to 50 dB.
TracingFigure ultrasound_figure(std::uint64_t seed);
/// Strokes 2 mm wide, 60 mm long or in diameter, rotated counter-clockwise by this angle; the nominal line is
/// their centre line.
TracingFigure line_figure(int angle_deg);
TracingFigure semicircle_figure(int angle_deg);

/// All figures of the paper: lines and semicircles at 0, 45, 90 and 135 degrees, then its three pictures.
std::vector<TracingFigure> all_tracing_figures(std::uint64_t seed);

/// The figure's picture as an Image.
Image image_of(const TracingFigure& figure);

}  // namespace palpable::study
