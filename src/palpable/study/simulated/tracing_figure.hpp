// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/image.hpp"
#include "palpable/core/vec3.hpp"
#include "palpable/study/simulated/closed_line.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace palpable::study {

/// A picture to be traced and the line that is right, as in "Design and implementation of a graphic-haptic
/// display system" (2006): practice lines and semicircles, and the three of its figure 8.
struct TracingFigure {
  /// "rectangle", "letter-h", "ultrasound", "line-045", "semicircle-090", …
  std::string name;
  /// 8-bit grey, dark on light.
  Raster<std::uint8_t> picture;
  /// Of a pixel when the picture covers the paper's device, 14 x 10 cm.
  double pixel_m = 0.0;
  /// In the scene's plane, m.
  std::vector<Vec3> nominal;
  LineByLength::Ends ends = LineByLength::Ends::closed;
};

/// Sizes are not stated in the paper. These are ours: outlines of 260, 352 and 72 mm stand to each other as
/// the paper's times without assistance do (26.1, 35.3 and 7.3 s). Each picture is 700 x 500 pixels; edges
/// are sampled by area.
TracingFigure rectangle_figure();
TracingFigure letter_h_figure();
/// A dark region of smooth outline in fully developed speckle (Burckhardt 1978): the size of a smoothed
/// complex Gaussian field, 12 dB less inside, attenuated with depth, compressed to 50 dB.
TracingFigure ultrasound_figure(std::uint64_t seed);
/// Strokes 2 mm wide, 60 mm long or across, turned to the left by this angle; the nominal line is their
/// middle.
TracingFigure line_figure(int angle_deg);
TracingFigure semicircle_figure(int angle_deg);

/// All of the paper: lines and semicircles at 0, 45, 90 and 135 degrees, then its three pictures.
std::vector<TracingFigure> all_tracing_figures(std::uint64_t seed);

/// As other modules take a picture.
Image image_of(const TracingFigure& figure);

}  // namespace palpable::study
