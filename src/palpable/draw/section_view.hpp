// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/draw/figure.hpp"
#include "palpable/draw/heading.hpp"
#include "palpable/models/relief/relief.hpp"

namespace palpable::draw {

/// A cut through the relief from left to right at height `y_m` of the picture: the cut's place on a small
/// map, and the profile as the hand meets it, heights stretched where that helps (said on the page).
Figure section_figure(models::Relief relief, double y_m, const Heading& heading);

}  // namespace palpable::draw
