// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/study/world/drive.hpp"
#include "palpable/study/world/room_view.hpp"
#include "palpable/vision/mapping/camera_memory.hpp"

#include <optional>

namespace palpable::study {

/// What the map is told of the camera's motion.
enum class StatedMotion : std::uint8_t { exact, odometry, none };

/// A depth camera on a robot that drives once round a room and looks from side to side.
struct MapStudyOptions {
  DriveOptions drive;
  WheelNoise wheels;
  StatedMotion motion = StatedMotion::odometry;
  Pinhole camera = camera_of(240, 180, 1.05);
  double height_m = 1.2;
  double down_rad = 0.3;
  /// How far it looks to either side, and how long one sway takes.
  double sway_rad = 0.9;
  double sway_s = 8.0;
  /// The drive ends after as many frames.
  int most_frames = 1'000'000;
  CameraNoise noise{{0.0005, 0.0014}, 0.4, 6.0, 0.0, 0};
  vision::CameraMemoryOptions memory;
};

/// The map after a drive against the room's truth.
struct MapScore {
  int frames = 0;
  double driven_m = 0.0;
  /// Of the map's surface: share within 2 and 4 cm of the room's.
  double right_2cm = 0.0, right_4cm = 0.0;
  /// Of the surface that the camera saw (places 2 cm apart): share that the map has within 2 and 4 cm.
  double kept_2cm = 0.0, kept_4cm = 0.0;
  /// Root mean square of a view's depth error, percent of the truth's range, in views between the frames,
  /// and the share of their pixels that the map has.
  double depth_rms_percent = 0.0;
  double depth_known = 0.0;
  /// The camera's greatest distance from its true place, and what odometry would have.
  double worst_place_m = 0.0, worst_odometry_m = 0.0;
  double map_mib = 0.0;
  /// Processor time of one frame: its pose and its fusion.
  double locate_ms = 0.0, add_ms = 0.0;
};

/// The map of a drive, for pictures.
struct MapRun {
  MapScore score;
  vision::SurfaceMap map;
  std::vector<Transform<WorldFrame, CameraFrame>> poses;
};

/// nullopt if there is no way round this room. The same seed gives the same room, drive and noise.
std::optional<MapRun> run_map_study(std::uint64_t seed, const MapStudyOptions& options);

}  // namespace palpable::study
