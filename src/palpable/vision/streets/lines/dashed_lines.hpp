// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/parameters.hpp"
#include "palpable/core/picture/image.hpp"
#include "palpable/core/picture/raster.hpp"
#include "palpable/vision/streets/lines/centre_lines.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace palpable::vision {

struct DashedLineOptions {
  /// Least difference between a dash and what is around it, in one channel, levels, 1 ... 255, and the least
  /// part of the strongest difference nearby, 0 ... 1.
  double contrast = 35.0;
  double separation = 0.5;
  /// Dashes are at most this wide and this long, pixels. 1 ... 20 and 2 ... 100.
  double widest_px = 4.0;
  double longest_px = 18.0;
  /// Farthest middles of two dashes that follow each other, pixels. 2 ... 100.
  double most_step_px = 22.0;
  /// Between them the difference falls below this part of that of the dashes. 0 ... 1.
  double gap_part = 0.45;
  /// Largest difference of their colours, RGB levels, 0 ... 442, and of their widths, as a factor, 1 ... 10.
  double most_colour_difference = 90.0;
  double most_width_ratio = 2.0;
  /// Largest turn from one step to the next one, degrees, 0 ... 90, and largest ratio of their lengths, 1
  /// ... 10.
  double most_turn_deg = 40.0;
  double most_step_ratio = 1.5;
  /// A line has at least this many dashes and this length, pixels. 3 ... 100 and 0 ... 1000.
  int fewest_dashes = 4;
  double least_length_px = 24.0;
  /// What is beside a line is this far from its edge, and what is farther away this far, pixels, 0.5 ... 20
  /// and 1 ... 50. It is the same if it differs by at most this in one channel, levels. 0 ... 255.
  double beside_px = 2.5;
  double farther_px = 7.0;
  double same_colour = 8.0;
  /// The edge of an area, such as the casing of a tunnel, has different colours on its two sides, and a
  /// border lies in a wide line, over more than this part of its dashes. 0 ... 1.
  double most_edge_part = 0.5;
  /// A line is left out if more than this part of it lies on streets. 0 ... 1.
  double most_on_street = 0.4;
};
std::vector<Parameter> parameters_of(DashedLineOptions& options);

/// Lines of dark dashes or dots in even steps, which maps draw for tracks and paths. `of_other`: colours of
/// dashes that are something else, such as that of water for streams in pipes. `street` (of the picture's
/// size) is not 0 where a street is seen. No line joins another one. Any thread.
CentreLines dashed_lines(const Raster<Rgb8>& picture, const Raster<std::uint8_t>& street,
                         std::span<const Rgb8> of_other, const DashedLineOptions& options = {});

}  // namespace palpable::vision
