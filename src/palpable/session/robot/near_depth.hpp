// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/frame.hpp"
#include "palpable/core/picture/camera.hpp"
#include "palpable/core/picture/image.hpp"
#include "palpable/core/result.hpp"
#include "palpable/core/work.hpp"
#include "palpable/vision/motion/depth/multi_view_depth.hpp"

#include <cstddef>
#include <span>

namespace palpable::session {

/// A picture of a wrist camera, and where the camera was in the frame of the robot that stands (x ahead, y
/// left, z up, metres).
struct WristPicture {
  Image picture;
  Transform<WorldFrame, CameraFrame> base_from_camera;
};

struct NearDepthOptions {
  /// Depths that are searched, m; 0 < near < far.
  double near_m = 0.15;
  double far_m = 3.0;
  /// Pictures are reduced to at most this many pixels.
  std::size_t most_pixels = 320 * 240;
  vision::MultiViewOptions sweep = {};
  /// Wider than that of videos: the pictures are few and near each other.
  vision::ConsistencyOptions consistency{.tolerance = 0.03};
};

/// What a wrist camera sees, as from one of its pictures.
struct NearView {
  DepthMap depth;
  Transform<WorldFrame, CameraFrame> base_from_camera;
  Image colour;
};

/// Metric depth of the pictures of a camera that was moved sideways ("mono-stereo", Park & Howard 2012,
/// section 4.2), as seen from the middle one, by the depth of posed frames (vision::multi_view_depth()): the
/// scale is that of the arm's motion. Level surfaces are favoured beside those that face the camera. Unknown
/// where the outer pictures' depths do not confirm it. `camera`: of the pictures' size; at least three
/// pictures, in the order of the motion. Long work, on all threads. Errors: invalid_input for fewer pictures,
/// or of another size; as vision::multi_view_depth(); interrupted.
Result<NearView> near_depth(std::span<const WristPicture> pictures, const Pinhole& camera,
                            const NearDepthOptions& options, const Work& work);

}  // namespace palpable::session
