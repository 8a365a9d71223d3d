// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/geometry/polyline.hpp"

#include <span>
#include <vector>

namespace palpable::formats {

/// The pieces of lines that a finger can tell apart: none is nearer to another one than `apart_m` (> 0), so
/// that of several lines that run side by side the first one is left. Where a line crosses or meets an
/// earlier one, its pieces end on that. Pieces shorter than four times `apart_m` are left out, and those
/// that end on another line if they are shorter than twice that. One for one with `lines`, which are in the
/// order of their importance.
std::vector<std::vector<Polyline>> spaced_lines(std::span<const Polyline> lines, double apart_m);

}  // namespace palpable::formats
