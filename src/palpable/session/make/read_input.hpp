// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/geometry/level_set.hpp"
#include "palpable/core/geometry/point_cloud.hpp"
#include "palpable/core/geometry/street_map.hpp"
#include "palpable/core/note.hpp"
#include "palpable/core/picture/image.hpp"
#include "palpable/core/picture/video_frame.hpp"
#include "palpable/core/result.hpp"
#include "palpable/core/work.hpp"
#include "palpable/models/field/superquadric.hpp"
#include "palpable/models/scene/scene.hpp"
#include "palpable/recipes/relief/relief_recipe.hpp"
#include "palpable/recipes/solid/fused_depth_recipe.hpp"
#include "palpable/recipes/video/video_recipe.hpp"
#include "palpable/session/make/stereo_input.hpp"
#include "palpable/sources/depth/depth_picture.hpp"
#include "palpable/sources/input/input.hpp"
#include "palpable/sources/map/extract_window.hpp"
#include "palpable/sources/solid/mesh_file.hpp"

#include <cstddef>
#include <filesystem>
#include <optional>
#include <variant>
#include <vector>

namespace palpable::session {

/// The files that a scene is made from, and what is known of them.
struct InputOptions {
  /// One or more: a scene, a picture pair (left first), one file that holds a pair, a depth map, a picture
  /// and its depth map, several depth maps, a mesh, points, superquadrics, a level set.
  std::vector<std::filesystem::path> files;
  /// Recognised by content if not given.
  std::optional<sources::InputKind> kind;
  /// Camera calibration: OpenCV yml/xml, Middlebury calib.txt or JSON; empty = none.
  std::filesystem::path calibration;
  /// Poses of several depth maps: CSV `frame,qw,qx,qy,qz,tx,ty,tz`, world_from_camera, camera x right, y
  /// down, z forward; `frame` is the last number in a depth map's file name. Empty = every camera is at the
  /// origin.
  std::filesystem::path poses;
  /// Settings of a depth file; those that are not given come from its sidecar or from the file.
  sources::DepthSettings depth;
  /// The arrangement of both pictures of a pair in one file.
  sources::StereoLayout layout = sources::StereoLayout::automatic;
  /// For a pair: whether to rectify it, and the distance in metres by which one camera was moved.
  Rectification rectification = Rectification::automatic;
  std::optional<double> moved_m;
  /// For a pair: as StereoInput::most_pixels.
  std::size_t most_pair_pixels = kMostPairPixels;
  /// For an OpenStreetMap extract: the part that is shown.
  sources::ExtractWindow window;
};

/// The frames of a video, and its camera.
struct VideoInput {
  std::vector<VideoFrame> frames;
  vision::VideoCamera camera;
  /// Size of a frame here, as a share of that in the file.
  double reduction = 1.0;
};

/// The values that were read from the files.
using InputValues = std::variant<Image, VideoInput, ReadyPair, recipes::DepthInput,
                                 std::vector<recipes::PosedDepth>, sources::MeshFile, PointCloud,
                                 std::vector<models::Superquadric>, LevelSet, StreetMap, models::Scene>;

struct ReadInput {
  InputValues values;
  std::vector<Note> notes;
};

/// Whether the files are several depth maps of one scene: more than two of kind depth, or any with poses.
bool holds_depth_maps(const InputOptions& options);

/// Recognises the kind of the files. Errors: as sources::recognise_input().
Result<sources::Input> recognise(const InputOptions& options);

/// Reads files of a kind that recognise() returned, or those of holds_depth_maps(), as values in memory; a
/// pair is rectified. Long work. Errors: invalid_input, naming the file; usage for options that do not fit;
/// interrupted.
Result<ReadInput> read_input(const sources::Input& input, const InputOptions& options, const Work& work);

/// Reads the single file as a picture, whatever its kind. Errors: usage for more than one file; as
/// sources::read_picture().
Result<Image> read_one_picture(const InputOptions& options);

}  // namespace palpable::session
