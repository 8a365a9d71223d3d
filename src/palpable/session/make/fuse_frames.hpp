// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/mesh.hpp"
#include "palpable/session/make/make_scene.hpp"

#include <string>
#include <vector>

namespace palpable::session {

/// Whether what was named is several depth maps of one scene: more than two files of kind depth, or any with
/// a file of poses.
bool fuses_frames(const MakeOptions& options);

/// The surface that several depth maps saw, closed by what is filled behind.
struct FusedSurface {
  Mesh surface;
  double voxel_m = 0.0;
  Transform<SceneFrame, models::InputFrame> scene_from_input;
  std::vector<std::string> notes;
};

/// Reads options.inputs as depth maps, their camera (options.calibration or their sidecars), and their poses:
/// a CSV `frame,qw,qx,qy,qz,tx,ty,tz`, world from camera, camera x right, y down, z forward, `frame` being
/// the last number in a file's name. Without poses every camera stands in the origin. The scene is the
/// world; where the world is a camera's own (a pose is the identity), it is turned so that y is up and z
/// towards the person. Errors: invalid_input, naming the file; usage where --near or --far make no sense.
Result<FusedSurface> fused_surface(const MakeOptions& options, const Work& work);

}  // namespace palpable::session
