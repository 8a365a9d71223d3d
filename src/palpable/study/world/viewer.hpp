// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/picture/camera.hpp"
#include "palpable/core/picture/raster.hpp"
#include "palpable/vision/depth_camera/head_fit.hpp"

#include <cstdint>
#include <random>
#include <vector>

namespace palpable::study {

// A person who sits before a screen, as a depth camera at the screen sees them.

/// An ellipsoid in the camera's frame.
struct Ellipsoid {
  Vec3 middle_m;
  Vec3 half_m;
  /// Turned by this angle about the vertical.
  double turn_rad = 0.0;
  /// Absorbs the camera's light in places, as hair does.
  bool is_dark = false;
};

/// A rectangle that faces the camera, in the level frame of the camera.
struct Board {
  Vec3 middle_m;
  double half_width_m = 0.0, half_height_m = 0.0;
};

/// What the person does at one time.
struct ViewerPose {
  /// The head's middle, in the level frame of the camera: x right, y down, z ahead.
  Vec3 head_m;
  double turn_rad = 0.0;
  /// How far each hand is raised: 0 in the lap, 1 beside the head.
  double left_hand = 0.0, right_hand = 0.0;
  /// The right hand passes before the face: its distance from the middle of the face to the right; infinite:
  /// it does not.
  double hand_before_face_m = 0.0;
  bool hides_face = false;
};

struct ViewerOptions {
  std::uint64_t seed = 1;
  Pinhole camera{285.0, 285.0, 159.5, 119.5, 320, 240};
  /// How far the camera looks down, rad.
  double down_rad = 0.0;
  /// The camera has no errors.
  bool is_exact = false;
};

/// The person of a seed (size of the head, hair, place), in a room with walls, a chair with or without a
/// head rest, a round lamp and a board.
class Viewer {
 public:
  explicit Viewer(const ViewerOptions& options);

  /// `time_s` from 0 to kSeconds: sits still; sways, leans and turns the head a little; raises one hand, then
  /// both; moves a hand before the face.
  ViewerPose pose_at(double time_s) const;
  static constexpr double kSeconds = 16.0;
  /// Sits still until then.
  static constexpr double kStill_s = 4.0;
  /// A hand is before the face from then on.
  static constexpr double kHidden_s = 14.0;

  /// What the camera measures, NaN where it sees nothing. Its errors: noise that grows with the square of the
  /// distance, whole eighths of a pixel of disparity, shadows of its projector, mixed and missing readings at
  /// edges, and hair that absorbs light.
  Raster<float> depth(const ViewerPose& pose);
  /// The picture without the person.
  Raster<float> empty_depth();
  /// The middle between the eyes.
  Point<vision::LevelFrame> eyes(const ViewerPose& pose) const;

 private:
  std::vector<Ellipsoid> body(const ViewerPose& pose) const;
  Raster<float> measured(Raster<float> exact_m, const Raster<std::uint8_t>& dark);
  Vec3 in_camera(Vec3 level) const;

  ViewerOptions options_;
  std::mt19937_64 random_;
  double size_ = 1.0, hair_m_ = 0.01;
  Vec3 seat_;
  bool has_head_rest_ = false;
  Raster<float> room_m_;
};

}  // namespace palpable::study
