// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/picture/image.hpp"
#include "palpable/vision/streets/centre_lines.hpp"

namespace palpable::vision {

struct CasingOptions {
  /// A casing is darker than the street and than what is beside it by at least this much, grey levels.
  double least_contrast = 8.0;
  /// Beside land that is darker than the street by this much, a casing cannot be seen: the border counts as
  /// one, grey levels.
  double dark_land = 40.0;
  /// A map draws its streets with casings if this part of their length has them.
  double least_cased_part = 0.7;
  /// On such a map, a line that has a casing on less than this part of its length is no street.
  double least_line_part = 0.15;
};

/// Part of a line's length, 0 ... 1, on which a thin darker line, or land that is much darker, bounds the
/// street on at least one side. Any
/// thread.
double cased_part(const Raster<Rgb8>& picture, const CentreLine& line, const CasingOptions& options = {});

}  // namespace palpable::vision
