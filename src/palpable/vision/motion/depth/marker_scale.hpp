// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/picture/raster.hpp"
#include "palpable/vision/motion/depth/video_depth.hpp"
#include "palpable/vision/motion/structure/camera_motion.hpp"
#include "palpable/vision/motion/tracks/printed_marker.hpp"

#include <cstdint>
#include <optional>
#include <span>

namespace palpable::vision {

/// The scale of a reconstruction, from a printed marker.
struct MarkerScale {
  double metres_per_unit = 0.0;
  int side_mm = 0;
  /// Frames that showed the marker.
  int frames = 0;
  /// Greatest difference of a side from their mean, share.
  double difference = 0.0;
};

/// Finds a marker in the frames that have a pose, triangulates its corners and compares their distances with
/// its side. Of several markers the one that most frames show counts. `greys`: one picture for each pose, of
/// the camera's size. nullopt if fewer than two frames show one, or if its corners do not form a square.
/// Polls cancel and returns nullopt then.
std::optional<MarkerScale> scale_from_markers(std::span<const Raster<std::uint8_t>> greys,
                                              const CameraMotion& motion, const MarkerOptions& options,
                                              const Work& work);

/// Multiplies all lengths of a reconstruction.
void scale_motion(CameraMotion& motion, double factor);
void scale_depth(std::span<FrameDepth> maps, double factor);

}  // namespace palpable::vision
