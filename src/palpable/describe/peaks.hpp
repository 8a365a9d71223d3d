// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/geometry/place.hpp"
#include "palpable/describe/ground_tilt.hpp"
#include "palpable/models/relief/relief.hpp"

#include <optional>
#include <vector>

namespace palpable::describe {

using palpable::Place;

/// A local maximum of a surface.
struct Peak {
  /// The middle of its top: the region at most a fiftieth of the prominence lower. The highest place if that
  /// middle is not on the top, as on a rim.
  Place place;
  /// Height at `place`.
  double height_m = 0.0;
  /// Topographic prominence, above the plane of a tilted ground: the least descent on any path to higher
  /// ground; for the highest peak, the descent to the lowest place.
  double prominence_m = 0.0;
  /// Area, seen from above, of the region around it above half of its prominence.
  double area_m2 = 0.0;
};

/// Which maxima count as objects.
struct PeakOptions {
  /// Least prominence as a share of the surface's height range, above the plane of a tilted ground, 0 ... 1.
  /// A tenth excludes texture and the matching errors of stereo reliefs. On a tilted ground the least
  /// prominence is at least the tolerance of the plane (GroundTiltOptions).
  double least_prominence = 0.1;
  /// Least area as a share of the surface's, 0 ... 1: on 100 x 100 mm a patch of 2.2 x 2.2 mm, about the
  /// smallest that a fingertip feels.
  double least_area = 5e-4;
  /// Whether the surface is inverted, as when a scene is touched engraved: then hollows are the peaks.
  bool turned_over = false;
  /// Whether heights are compared above the plane of a tilted ground (ground_tilt.hpp), whose high edge is
  /// then no peak.
  bool above_ground = true;
  /// Places along the longer side of the grid on which peaks are searched, 2 ... 4096; at most the surface's
  /// own samples.
  int longest_side = 128;
};

/// The peaks that satisfy `options`, the most prominent first; none on a level surface. They are searched on
/// a grid (PeakOptions::longest_side); place and height of each peak come from the surface's own samples.
std::vector<Peak> find_peaks(const models::Relief& surface, const PeakOptions& options = {});

/// The least prominence of a peak of this surface, metres.
double least_prominence_m(const models::Relief& surface, const PeakOptions& options = {});

/// The plane of a tilted ground, searched on that grid; of an inverted surface, that of its hollows. nullopt
/// if there is none, or if it rises by less than options.least_prominence of the surface's height range.
std::optional<GroundPlane> tilted_ground(const models::Relief& surface, const PeakOptions& options = {});

}  // namespace palpable::describe
