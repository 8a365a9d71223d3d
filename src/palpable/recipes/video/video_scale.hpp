// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/note.hpp"
#include "palpable/vision/motion/depth/marker_scale.hpp"
#include "palpable/vision/motion/depth/video_depth.hpp"

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace palpable::recipes {

/// A length between two places of a frame.
struct KnownLength {
  /// Metres, > 0.
  double length_m = 0.0;
  int frame_number = 0;
  /// In pixels of the frame; pixel centres are at integers.
  vision::ImagePoint from, to;
};

struct VideoScaleOptions {
  vision::MarkerOptions marker;
  /// Where the depth of a place is unknown, the nearest known one within this distance counts, px, 0 … 50.
  int reach_px = 8;
};
std::vector<Parameter> parameters_of(VideoScaleOptions& options);

/// Metres per unit of a reconstruction, and a note on where it comes from; no scale: the note says why.
struct VideoScale {
  std::optional<double> metres_per_unit;
  std::vector<Note> notes;
};

/// The scale from a printed marker in the frames; without a marker no scale and no note.
VideoScale scale_from_markers(std::span<const Raster<std::uint8_t>> greys, const vision::CameraMotion& motion,
                              const VideoScaleOptions& options, const Work& work);

/// The scale from a known length, by the depth at its two places. `maps`: among them one of its frame, which
/// is the frame of this index.
VideoScale scale_from_length(const KnownLength& length, int frame_index,
                             std::span<const vision::FrameDepth> maps, const VideoScaleOptions& options);

}  // namespace palpable::recipes
