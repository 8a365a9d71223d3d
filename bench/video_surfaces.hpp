// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/result.hpp"
#include "palpable/core/work.hpp"
#include "palpable/measure/camera_path_score.hpp"
#include "palpable/recipes/video/video_recipe.hpp"

#include <string>
#include <vector>

#include "rendered_video.hpp"

namespace palpable::bench {

/// How well a surface agrees with what the cameras of a rendered video saw of its objects.
struct SurfaceFigures {
  /// Distances of the visible true places from the surface, mm; those within 1 % of the model's diagonal, %.
  double median_mm = 0, mean_mm = 0, within_percent = 0;
  /// Vertices of the surface that a camera would see in front of the true surface by more than that, %.
  double in_air_percent = 0;
  /// Diagonal of the box around the visible true places of the objects.
  double diagonal_mm = 0;
};

/// A surface of a video's model, or a step on the way to it.
struct NamedSurface {
  std::string name;
  SurfaceFigures figures;
  double seconds = 0;
};

/// Which surfaces are made: the fused one, or also the corrected one.
enum class Surfaces { none, fused, corrected };

/// Makes the surfaces of a video's model from its depth maps, fused and corrected step by step, and compares
/// each with the truth. `maps`: in the unit of the poses. `pictures`: of all frames.
Result<std::vector<NamedSurface>> surfaces_of(const RenderedVideo& video,
                                              std::vector<vision::FrameDepth> maps,
                                              const std::vector<Raster<Rgb8>>& pictures,
                                              const measure::CameraPathScore& path, Surfaces which,
                                              recipes::VideoRecipe& recipe, const Work& work);

}  // namespace palpable::bench
