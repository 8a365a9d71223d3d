// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/models/relief/relief.hpp"

#include <vector>

namespace palpable::describe {

/// A place seen from above, scene frame, metres.
struct Place {
  double x_m = 0.0;
  double y_m = 0.0;
};

/// A local maximum of a surface.
struct Peak {
  /// The middle of its top: of what is as high but for a fiftieth of the prominence. Its highest place where
  /// that middle is not on the top, as of a rim.
  Place place;
  /// There.
  double height_m = 0.0;
  /// Topographic prominence: how far one must go down from it before going up to anything higher; of the
  /// highest one, down to the lowest place.
  double prominence_m = 0.0;
  /// Of the region around it that lies above half of its prominence, seen from above.
  double area_m2 = 0.0;
};

/// Which maxima count as objects that rise.
struct PeakOptions {
  /// Least prominence, as a share of the surface's range of height, 0 ... 1. A tenth leaves out the texture
  /// and the matching errors of stereo reliefs.
  double least_prominence = 0.1;
  /// Least area, as a share of the surface's, 0 ... 1: on 100 x 100 mm a patch of 2.2 x 2.2 mm, which a
  /// fingertip just feels.
  double least_area = 5e-4;
  /// Whether the surface is turned over, as an engraved scene is touched: its hollows rise.
  bool turned_over = false;
};

/// The peaks that `options` let through, the most prominent first; none of a level surface. Heights are read
/// at 128 places along the longer side, and each peak's place and height from the surface's own samples.
std::vector<Peak> find_peaks(const models::Relief& surface, const PeakOptions& options = {});

}  // namespace palpable::describe
