// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/picture/raster.hpp"
#include "palpable/core/work.hpp"
#include "palpable/vision/segmentation/ground_plane.hpp"
#include "palpable/vision/segmentation/regions.hpp"

#include <cstdint>

// Inside vision's sources only.
namespace palpable::vision {

/// The pixels that belong to a plane, 255 / 0, cleaned by a majority filter. A pixel belongs to the plane if
/// its neighbourhood lies on it and, for a ground, is parallel to it, since the foot of an object lies on it
/// too but rises from it. A region that is mostly on the plane also includes its pixels that are slightly off
/// or unknown, but not objects of its colour.
Raster<std::uint8_t> plane_mask(const Regions& regions, const Raster<float>& disparity_px,
                                const GroundPlane& fit, PlaneDirection direction,
                                const GroundMaskOptions& options, const Work& work);

/// Majority filter over a square of `reach` pixels to each side: removes holes and specks from single wrong
/// matches.
Raster<std::uint8_t> majority(const Raster<std::uint8_t>& mask, int reach);

}  // namespace palpable::vision
