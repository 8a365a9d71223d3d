// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/camera.hpp"
#include "palpable/core/raster.hpp"
#include "palpable/core/result.hpp"
#include "palpable/models/field/superquadric.hpp"
#include "palpable/sculpt/superquadric/superquadric_residuals.hpp"

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace palpable::sculpt {

/// `solina`: plain Levenberg-Marquardt on the papers' cost (Solina & Bajcsy 1990), as Moustakas 2007 fits.
/// `robust`: points and lines of sight that fit no surface are weighted down, several starts, axes permuted.
enum class FitMethod { robust, solina };
enum class FitDeformation { none, taper, taper_and_bend };

/// What a picture adds to its points: from where they were seen, and the solid's outline.
struct FitView {
  Point<SceneFrame> eye;
  /// Lines of sight that graze the solid; may be empty.
  std::vector<Sight> outline;
};

struct FitOptions {
  FitMethod method = FitMethod::robust;
  FitDeformation deformation = FitDeformation::none;
};

struct FittedSuperquadric {
  models::Superquadric shape;
  /// Standard deviation of the points that belong to the shape, and their share of all.
  double noise_m = 0.0;
  double inlier_share = 1.0;
  /// Mean distance of those points to the surface, to first order.
  double error_m = 0.0;
};

/// Fits one superquadric to points of a surface (the scene's frame, metres): of all around, or of one side
/// with its `view`. At least 12 points, finite, not all on one plane or line (a plane has no volume). Errors:
/// invalid_input.
Result<FittedSuperquadric> fit_superquadric(std::span<const Vec3> points_m,
                                            const std::optional<FitView>& view,
                                            const FitOptions& options = {});

/// The lines of sight through the outline of `label` in a label picture: one between each pair of neighbours
/// of which one has the label and the other not, the border of the picture left out. `scene_from_camera` is
/// the camera's pose.
std::vector<Sight> outline_of(const Raster<std::uint8_t>& labels, std::uint8_t label, const Pinhole& camera,
                              const Transform<SceneFrame, CameraFrame>& scene_from_camera);

}  // namespace palpable::sculpt
