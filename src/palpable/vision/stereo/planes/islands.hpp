// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/vision/stereo/cost/cost_volume.hpp"
#include "palpable/vision/stereo/planes/planes.hpp"

namespace palpable::vision {

/// Repeated patterns feign small surfaces in front of the real one, and both views agree about them. But what
/// really stands in front hides something from the other camera: the pixels it would hide must not match well
/// themselves. Takes each small surface before its surroundings whose pixels cost more, together with those
/// that it would hide without reason, than on a plane of its surroundings carried on, back to that plane; in
/// `start` too.
void remove_feigned_islands(const CostVolume& volume, PlaneMap& map, PlaneMap& start);

}  // namespace palpable::vision
