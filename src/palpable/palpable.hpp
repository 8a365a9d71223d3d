// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \mainpage Palpable
/// Makes pictures touchable: values in memory (a picture pair, a depth map, a mesh, points) become a scene by
/// a recipe (palpable::recipes), a scene and a force law become a Touchable (palpable::haptics), and a
/// ServoLoop renders it on a device (palpable::device). SI units everywhere; docs/conventions.md explains the
/// frames.

// What a program needs to touch a scene: core, models, device and haptics, which need no vision library.
#include "palpable/core/frame.hpp"
#include "palpable/core/geometry/mesh.hpp"
#include "palpable/core/geometry/point_cloud.hpp"
#include "palpable/core/note.hpp"
#include "palpable/core/result.hpp"
#include "palpable/core/work.hpp"
#include "palpable/device/callback_device.hpp"
#include "palpable/device/device.hpp"
#include "palpable/device/drivers/open.hpp"
#include "palpable/haptics/law/laws.hpp"
#include "palpable/haptics/servo/servo_loop.hpp"
#include "palpable/haptics/servo/start_touch.hpp"
#include "palpable/models/relief/relief_solid.hpp"
#include "palpable/models/scene/scene.hpp"

// Making scenes from values, where that is installed.
#if __has_include("palpable/recipes/relief/relief_recipe.hpp")
#include "palpable/recipes/contours_recipe.hpp"
#include "palpable/recipes/relief/relief_recipe.hpp"
#include "palpable/recipes/solid/field_recipe.hpp"
#include "palpable/recipes/solid/fused_depth_recipe.hpp"
#include "palpable/recipes/solid/grid_recipe.hpp"
#include "palpable/vision/rectification/stereo_rectification.hpp"
#endif

// Scenes and models as files, where that is installed.
#if __has_include("palpable/formats/scene/scene_file.hpp")
#include "palpable/formats/mesh/stl.hpp"
#include "palpable/formats/scene/scene_file.hpp"
#endif

// Pictures, depth maps, meshes and points from files, where that is installed.
#if __has_include("palpable/sources/picture/picture.hpp")
#include "palpable/sources/depth/depth_picture.hpp"
#include "palpable/sources/picture/picture.hpp"
#include "palpable/sources/solid/mesh_file.hpp"
#include "palpable/sources/solid/points_file.hpp"
#endif
