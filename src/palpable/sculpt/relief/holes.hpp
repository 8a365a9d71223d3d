// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/picture/raster.hpp"

namespace palpable::sculpt {

/// Closes holes (NaN) smoothly: each takes the values of its rim, first through a pyramid of means (Gortler
/// 1996, "pull-push"), then relaxed towards the membrane over the rim. Known values stay as they are. At
/// least one value must be known.
void fill_unknown_heights(Raster<float>& values);

}  // namespace palpable::sculpt
