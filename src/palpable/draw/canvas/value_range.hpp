// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/picture/raster.hpp"

#include <utility>

namespace palpable::draw {

/// The range for a colour scale: the 0.5 % and 99.5 % quantiles of the finite values, so that a few outliers
/// do not use up the colours. 0 … 1 if nothing is finite; never empty.
std::pair<float, float> display_range(const Raster<float>& values);

}  // namespace palpable::draw
