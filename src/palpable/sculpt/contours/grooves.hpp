// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/parameters.hpp"
#include "palpable/core/work.hpp"
#include "palpable/models/contours/boundary_map.hpp"
#include "palpable/models/relief/relief.hpp"

#include <vector>

namespace palpable::sculpt {

struct GrooveOptions {
  /// Full width of a groove; lines of about 4 mm trace well by touch (methods.md 9). 0.5 … 20 mm.
  double width_m = 0.004;
  /// Depth at its middle, 0.1 … 10 mm.
  double depth_m = 0.0015;
  /// At least this many samples across half a groove, so that its profile is a curve and not a step, unless
  /// the relief would be longer than the limit. 1 … 64; 2 … 16384 samples.
  double samples_across_half = 6.0;
  int most_samples = 2048;
};
std::vector<Parameter> parameters_of(GrooveOptions& options);

/// A plate of the map's size with a groove along every boundary line: its profile across is a cosine, so the
/// walls are smooth and the hand slides into the line and along it. Passive: a relief for `proxy` and
/// `rolling`. Its top is at depth_m, its grooves reach down to 0. Errors: usage for options out of range.
Result<models::Relief> grooves_from_boundary_map(const models::BoundaryMap& map,
                                                 const GrooveOptions& options);

}  // namespace palpable::sculpt
