// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/raster.hpp"

#include <utility>

namespace palpable::draw {

/// The values between which nearly all of a map lies: a few wild pixels must not use up the colours. 0 … 1
/// where nothing is finite; never empty.
std::pair<float, float> usual_range(const Raster<float>& values);

}  // namespace palpable::draw
