// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/work.hpp"
#include "palpable/models/scene/scene.hpp"
#include "palpable/sculpt/contours/grooves.hpp"
#include "palpable/sculpt/field/field_from_source.hpp"
#include "palpable/sculpt/relief/occupancy_from_depth.hpp"
#include "palpable/sculpt/relief/relief_from_depth.hpp"
#include "palpable/session/make/stereo_input.hpp"
#include "palpable/sources/depth/depth_picture.hpp"
#include "palpable/sources/input/input.hpp"
#include "palpable/vision/contours/contours.hpp"
#include "palpable/vision/segmentation/ground.hpp"
#include "palpable/vision/stereo/problem/stereo.hpp"

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace palpable::session {

/// What the input becomes: one picture contours, a mesh a field, all else a relief, unless it is said.
enum class MakeAs { by_input, relief, contours, field, grid };

/// The picture on a pair's relief.
enum class Texture {
  /// The left one.
  left,
  /// The scene as seen from between the cameras, made from both pictures and the depth (Shi & Pai 1997); the
  /// relief is shaped from there too.
  front,
  none
};

/// What becomes of what stands behind the things of a pair's scene.
enum class BackgroundTreatment {
  keep,
  /// It falls to the level of the farthest thing that is left.
  remove
};

/// How a solid's distance is kept.
enum class FieldKeeping {
  /// Where it needs to be known (models::DistanceField): small, exact and smooth.
  adaptive,
  /// At every place of a lattice, for comparison.
  dense,
  /// As Moustakas et al. 2007 kept it at first: by fast marching, distance and force at every place.
  paper
};

/// What a scene is made from, and how.
struct MakeOptions {
  MakeAs as = MakeAs::by_input;
  /// One or more files: a scene, a picture pair (left first), one file that holds a pair, a depth map, a
  /// picture and its depth map.
  std::vector<std::filesystem::path> inputs;
  /// Not given: recognised by content.
  std::optional<sources::InputKind> kind;
  /// OpenCV yml/xml, Middlebury calib.txt or JSON; empty = none.
  std::filesystem::path calibration;
  /// For a pair; not given: default_method().
  std::optional<vision::StereoMethod> method;
  /// 0 = found automatically.
  int max_disparity_px = 0;
  /// Of several depth maps: where their cameras stood (session/make/fuse_frames.hpp); empty = all in one
  /// place.
  std::filesystem::path poses;
  /// What is known of a depth file; what is not given is as its sidecar or the file itself says.
  sources::DepthSettings depth;
  /// How one picture holds a pair.
  sources::StereoLayout layout = sources::StereoLayout::automatic;
  /// For a pair: whether it is rectified, and by how many metres one camera was moved.
  Rectification rectification = Rectification::automatic;
  std::optional<double> moved_m;
  Texture texture = Texture::left;
  /// For a pair: what becomes of the plane that things stand on.
  vision::GroundTreatment ground = vision::GroundTreatment::keep;
  BackgroundTreatment background = BackgroundTreatment::keep;
  sculpt::ReliefOptions relief;
  /// Of one picture: its contours.
  vision::ContourOptions contours;
  /// Radius of the contours' neighbourhood (eq. 7), 1 ... 32 px.
  double neighbourhood_px = 3.0;
  sculpt::GrooveOptions grooves;
  /// Of a volume filled under a relief.
  sculpt::OccupancyOptions grid;
  /// Of a solid.
  sculpt::FieldOptions field;
  FieldKeeping field_keeping = FieldKeeping::adaptive;
  /// Written into the scene's provenance: "palpable 0.1.0".
  std::string made_by;
};

struct MadeScene {
  std::shared_ptr<const models::Scene> scene;
  /// What the person should know of the input, a sentence each.
  std::vector<std::string> notes;
};

/// The method for files: the best there is.
vision::StereoMethod default_method();

/// From input files to a touchable scene, through one method. Long work: reports progress, polls cancel.
/// Errors: invalid_input naming the file, usage for options that do not fit the input, interrupted.
Result<MadeScene> make_scene(const MakeOptions& options, const Work& work);

/// Takes a scene as soon as it is made.
using TakeScene = std::function<void(MadeScene)>;

/// The same for a touch that is to begin at once: where no method is fixed, a pair's scene comes first by the
/// fastest method there is, then by the best one. Errors: as make_scene(); what was made before an error has
/// been taken.
Result<void> make_scenes(const MakeOptions& options, const TakeScene& take, const Work& work);

}  // namespace palpable::session
