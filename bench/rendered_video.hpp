// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/frame.hpp"
#include "palpable/core/picture/camera.hpp"
#include "palpable/core/picture/image.hpp"
#include "palpable/core/picture/raster.hpp"
#include "palpable/core/work.hpp"

#include <cstdint>
#include <string>
#include <vector>

#include "table_model.hpp"

// Rendered videos of table-top models with exact poses and depth, on which the parameters of videos are
// chosen. No test uses them. docs/video.md says which seeds.
namespace palpable::bench {

/// How a video was taken; drawn from its seed.
struct VideoConditions {
  enum class Path { arc, sweep, spiral } path = Path::arc;
  /// Angle that the camera goes round the model, and its height above the table plane, degrees; its distance,
  /// m.
  double arc_deg = 40.0, elevation_deg = 45.0, distance_m = 0.65;
  /// Standard deviation of the hand's shake: position, m, and direction, radians.
  double shake_m = 0.001, shake_rad = 0.003;
  /// Share of the time between frames in which the shutter is open, and in which the rows are read.
  double exposure = 0.2, readout = 0.0;
  /// Standard deviation of the noise, grey levels of 255; change of the exposure along the video, share.
  double noise = 2.0, exposure_drift = 0.05;
};

/// A video of 640 x 480 pixels, rendered frame by frame. Deterministic.
class RenderedVideo {
 public:
  explicit RenderedVideo(std::uint32_t seed, int frames = 60);

  /// Lays a printed marker on the board (vision::marker_cells()).
  void add_marker(int side_mm);

  std::uint32_t seed() const { return seed_; }
  int frames() const { return frames_; }
  const Pinhole& camera() const { return camera_; }
  const VideoConditions& conditions() const { return conditions_; }
  /// "seed 3: arc, 6 parts, rolling shutter …", for tables.
  std::string description() const;
  /// The camera when the middle row of a frame is exposed.
  Transform<WorldFrame, CameraFrame> pose(int frame) const { return pose_at(frame); }
  Raster<Rgb8> picture(int frame, const Work& work) const;
  /// Exact, along the optical axis, as seen from pose(frame); metres; 0 for what is not the model or near it.
  Raster<float> depth(int frame, const Work& work) const;

 private:
  Transform<WorldFrame, CameraFrame> pose_at(double frame) const;
  Vec3 shake_at(double frame, int axis) const;

  std::uint32_t seed_;
  int frames_;
  Pinhole camera_{560, 560, 319.5, 239.5, 640, 480};
  VideoConditions conditions_;
  TableModel model_;
};

}  // namespace palpable::bench
