// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/geometry/point_cloud.hpp"
#include "palpable/core/picture/camera.hpp"
#include "palpable/core/picture/video_frame.hpp"
#include "palpable/core/result.hpp"
#include "palpable/core/work.hpp"
#include "palpable/recipes/made_scene.hpp"
#include "palpable/recipes/solid/field_recipe.hpp"
#include "palpable/recipes/video/corrected_model.hpp"
#include "palpable/recipes/video/model_growth.hpp"
#include "palpable/recipes/video/model_shapes.hpp"
#include "palpable/recipes/video/video_advice.hpp"
#include "palpable/recipes/video/video_model.hpp"
#include "palpable/recipes/video/video_scale.hpp"
#include "palpable/sculpt/points/depth_fusion.hpp"
#include "palpable/vision/motion/depth/covered_frames.hpp"
#include "palpable/vision/motion/depth/video_depth.hpp"
#include "palpable/vision/motion/structure/moving_points.hpp"
#include "palpable/vision/motion/structure/recursive_motion.hpp"
#include "palpable/vision/motion/tracks/photo_tracks.hpp"
#include "palpable/vision/motion/tracks/usable_frames.hpp"

#include <optional>
#include <vector>

namespace palpable::recipes {

/// How a video's camera path is computed.
enum class VideoMotion {
  /// All frames together (vision::motion_from_tracks()).
  batch,
  /// Frame by frame, by an extended Kalman filter (vision::motion_by_filter()), as Moustakas et al. 2007.
  filter
};

/// What a video's field is made of.
enum class VideoSurface {
  /// The depth maps, fused.
  fused,
  /// Superquadrics that were fitted to the points (shapes_of_model()).
  superquadrics,
  /// These superquadrics, corrected by each depth map in turn (corrected_model()).
  corrected
};

/// When points are followed from frame to frame; if this fails, they are matched between pictures instead.
struct FollowingOptions {
  /// Share of the frames that must share enough points with both of the next two, 0 … 1.
  double most_frames = 0.8;
  /// Enough points are this many times as many as a frame's pose needs, 1 … 20.
  int times_least = 3;
  /// Where a frame shares fewer with the one before, so many frames on each side of the gap are matched, 1 …
  /// 20.
  int bridge = 3;
};
std::vector<Parameter> parameters_of(FollowingOptions& options);

/// What of a fused surface becomes a field; see FusedDepthRecipe.
struct VideoSurfaceOptions {
  double least_part = 0.05;
  /// The surface of two houses in 256 voxels has 230 000; nine photographs of a chair without texture beside
  /// it gave a million, and a field that was not done after four minutes of processor time.
  int most_triangles = 400000;
};
std::vector<Parameter> parameters_of(VideoSurfaceOptions& options);

/// How a video of a model becomes a field.
struct VideoRecipe {
  VideoMotion motion_method = VideoMotion::batch;
  VideoSurface surface = VideoSurface::fused;
  /// Frames after the one of this number are not used; not given: all are.
  std::optional<int> until;
  /// Without it the scale is that of a printed marker, if one is seen, else arbitrary.
  std::optional<KnownLength> length;
  /// Pixels of the frames per pixel of the video; only passed on.
  double reduction = 1.0;
  vision::UsableFrameOptions frames;
  vision::TrackOptions tracks;
  FollowingOptions following;
  /// Of pictures that were taken too far apart to be followed.
  vision::PhotoMatchOptions photos;
  vision::BatchMotionOptions motion;
  vision::FilterMotionOptions filter;
  /// Which points move by themselves.
  vision::MovingPointOptions moving;
  /// What covers single frames.
  vision::CoveredFrameOptions covered;
  vision::VideoDepthOptions depth;
  VideoModelOptions model;
  VideoSurfaceOptions fused;
  ModelShapesOptions shapes;
  CorrectedModelOptions corrected;
  /// How a growing model is shown to `grown`.
  GrowthOptions growth;
  /// Receives the states of a model that is being corrected, in the order of their errors, on the thread
  /// that makes it. May be empty; not called for other surfaces.
  TakeState grown;
  VideoScaleOptions scale;
  VideoAdviceOptions advice;
  sculpt::FusionOptions fusion;
  FieldRecipe field;
};

/// Intermediate results of a video's scene; positions in the world frame of the poses, in metres if `metric`,
/// else in arbitrary scale.
struct VideoReconstruction {
  struct Pose {
    int frame_number = 0;
    vision::CameraPose world_from_camera;
  };
  std::vector<Pose> poses;
  struct Depth {
    int frame_number = 0;
    DepthMap map;
    vision::CameraPose world_from_camera;
    Raster<Rgb8> picture;
  };
  /// Not reduced to the model, and with what other maps measured where they are unknown.
  std::vector<Depth> depth_maps;
  /// Points on the observed surfaces.
  PointCloud structure;
  bool metric = false;
  /// Pixels of the frames per pixel of the video.
  double reduction = 1.0;
  Pinhole camera;
  Transform<SceneFrame, WorldFrame> scene_from_world;
  VideoFigures figures;
  /// The steps in which a corrected model was refined; empty for other surfaces. In metres of the scene.
  struct Step {
    ModelStep::Kind kind = ModelStep::Kind::segments;
    /// Number of the last frame whose depth was used.
    int frame_number = 0;
    double error_m = 0.0;
    bool taken = true;
  };
  std::vector<Step> steps;
  /// What to do better, for people without technical knowledge.
  std::vector<Note> advice;
};

/// All parameters of a video, those of the field apart.
std::vector<Parameter> parameters_of(VideoRecipe& recipe);

/// The field of what a video shows: blurred frames and copies are left out, points are followed, or matched
/// where the pictures were taken too far apart, the camera's path is found
/// (vision::motion_from_tracks()), the depth of frames along it is computed and fused. The plane on which
/// most of it stands becomes the base, its upward direction points to the person. With a known scale the
/// scene keeps its metres, centred, the ground at z = 0; otherwise it is scaled to fit a hand. Frames in
/// order, all of the camera's size. Long work. Errors: usage for a known length in a frame that is not used;
/// as vision::motion_from_tracks(), vision::depth_of_video(), sculpt::fused_depth() and
/// field_from_level_set().
Result<MadeScene> field_from_video(const std::vector<VideoFrame>& frames, const vision::VideoCamera& camera,
                                   const VideoRecipe& recipe, const Work& work);

}  // namespace palpable::recipes
