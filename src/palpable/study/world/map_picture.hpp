// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/study/world/map_study.hpp"

namespace palpable::study {

/// A map beside the truth: above, from above without the ceiling, the map's points by their distance from the
/// room's surface (grey to 2 cm, yellow to 4 cm, red beyond), and the true room; below, one camera's view of
/// the map's depth (near is bright, unknown is blue) and the true depth. 10 pixels are 10 cm from above.
Raster<Rgb8> map_picture(const Room& room, const MapRun& run, const Pinhole& camera);

}  // namespace palpable::study
