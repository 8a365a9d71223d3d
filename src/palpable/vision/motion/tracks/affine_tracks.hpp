// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/vision/motion/tracks/patch_alignment.hpp"
#include "palpable/vision/motion/tracks/point_tracks.hpp"

#include <cstdint>
#include <span>
#include <vector>

// Inside vision's sources only.
namespace palpable::vision {

/// Tracks without drift: the surroundings of each point in the middle one of its frames are aligned with all
/// others, as a surface that is seen from another side, instead of from frame to frame. Where that fails, the
/// track ends, and the rest of it is a track of its own if it has at least five frames. The tracks must have
/// places in all of their frames, and the frames one size. Long work: polls cancel and returns early then.
std::vector<PointTrack> affine_tracks(std::span<const Raster<std::uint8_t>> frames,
                                      std::span<const PointTrack> tracks, const PatchOptions& options,
                                      const Work& work);

}  // namespace palpable::vision
