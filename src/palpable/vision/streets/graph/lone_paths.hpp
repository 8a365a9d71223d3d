// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/vision/streets/colours/map_frame.hpp"
#include "palpable/vision/streets/lines/centre_lines.hpp"

namespace palpable::vision {

/// Removes paths that hang together with no street and end nowhere within `border_px` of the map's border:
/// dashes of something else. Any thread.
void remove_lone_paths(CentreLines& graph, const MapFrame& frame, double border_px);

}  // namespace palpable::vision
