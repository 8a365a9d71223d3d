// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/camera.hpp"
#include "palpable/core/image.hpp"
#include "palpable/core/point_cloud.hpp"
#include "palpable/core/result.hpp"
#include "palpable/core/work.hpp"
#include "palpable/recipes/field_recipe.hpp"
#include "palpable/recipes/made_scene.hpp"
#include "palpable/sculpt/points/depth_fusion.hpp"
#include "palpable/vision/motion/video_depth.hpp"

#include <vector>

namespace palpable::recipes {

/// A frame of a video.
struct FilmedFrame {
  /// Its number in the video, counted from 0.
  int number = 0;
  Raster<Rgb8> picture;
};

/// Options for making a field from a video of a model.
struct VideoRecipe {
  vision::TrackOptions tracks;
  vision::BatchMotionOptions motion;
  vision::VideoDepthOptions depth;
  sculpt::FusionOptions fusion;
  FieldRecipe field;
};

/// Intermediate results of a video's scene; positions in the world frame of the poses, in arbitrary scale.
struct VideoReconstruction {
  struct Pose {
    int frame_number = 0;
    vision::CameraPose world_from_camera;
  };
  std::vector<Pose> poses;
  struct Depth {
    int frame_number = 0;
    DepthMap map;
  };
  std::vector<Depth> depth_maps;
  /// Points on the observed surfaces.
  PointCloud structure;
  /// RMS reprojection error of the tracked points, px.
  double reprojection_rms_px = 0.0;
};

/// Makes a field from a video: points are tracked, the camera's poses are estimated
/// (vision::motion_from_tracks()), and the depth of frames is computed and fused. The plane on which most of
/// the scene stands becomes the base; its upward direction points to the user. Frames in order, all of the
/// camera's size. Long work. Errors: as vision::motion_from_tracks(), vision::depth_of_video(),
/// sculpt::fused_depth() and field_from_level_set().
Result<MadeScene> field_from_video(const std::vector<FilmedFrame>& frames, const vision::VideoCamera& camera,
                                   const VideoRecipe& recipe, const Work& work);

}  // namespace palpable::recipes
