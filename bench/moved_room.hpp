// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/picture/image.hpp"
#include "palpable/core/picture/raster.hpp"
#include "palpable/vision/stereo/problem/stereo.hpp"

#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

#include "scene_surfaces.hpp"
#include <opencv2/core.hpp>

// Furnished rooms, ray-cast for a camera in any pose, with exact depth: pairs of a camera that was moved in
// any direction, on which rectification and `fit` are judged. No test uses them.
namespace palpable::bench {

/// A camera: x right, y down, z forward; metres and pixels.
struct RoomCamera {
  cv::Vec3d position_m{0, 0, 0};
  /// Rotation vector that turns the camera's axes into the room's, radians.
  cv::Vec3d turn{0, 0, 0};
  double focal_px = 400.0;
  /// Distance of the principal point from the picture's middle, px.
  double off_middle_px = 0.0;
  /// How far the camera moves and turns while the rows are read.
  cv::Vec3d readout_move_m{0, 0, 0}, readout_turn{0, 0, 0};
  double gain = 1.0;
  double noise = 1.5 / 255.0;
};

/// A ball, or a box turned about the vertical axis.
struct Furniture {
  enum class Form { ball, box } form = Form::box;
  cv::Vec3d centre_m, half_m;
  double turn = 0.0;
  Texture texture;
};

/// A room of 5 m x 2.8 m with walls, floor, ceiling and 8 to 14 pieces of furniture.
class FurnishedRoom {
 public:
  explicit FurnishedRoom(std::uint64_t seed);

  struct View {
    Image picture;
    /// Along the camera's axis, m.
    Raster<float> depth_m;
  };
  View seen_by(const RoomCamera& camera, int width, int height, std::uint64_t noise_seed) const;

 private:
  struct Ray {
    cv::Vec3d from_m, towards;
  };
  struct Met {
    double distance;
    Colour colour;
  };
  Met first_met(const Ray& ray) const;

  double half_width_m_, floor_m_, ceiling_m_, back_m_;
  std::array<Texture, 5> walls_;
  std::vector<Furniture> pieces_;
};

/// How the camera was moved between two pictures.
enum class Movement {
  sideways,
  upwards,
  oblique,
  forward,
  backward,
  rolled,
  turned,
  zoomed_sideways,
  zoomed_up,
  axis_off,
  hand_held,
  rolling_shutter,
  // From here on no depth can be known.
  zoom_only,
  turn_only,
  turn_and_zoom,
  twice,
  elsewhere,
  mirrored,
};
inline constexpr int kMovements = 18;
std::string_view name_of(Movement movement);
bool is_hopeless(Movement movement);

struct MovedPair {
  vision::StereoPair pair;
  /// Of the left picture, m.
  Raster<float> depth_m;
  double focal_px = 0.0;
  /// From the left camera to the right one.
  double moved_m = 0.0;
};

/// 480 x 360 pixels. Deterministic.
MovedPair moved_pair(Movement movement, std::uint64_t seed);

}  // namespace palpable::bench
