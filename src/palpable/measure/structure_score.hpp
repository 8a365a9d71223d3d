// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/geometry/mesh.hpp"
#include "palpable/core/geometry/point_cloud.hpp"
#include "palpable/core/parameters.hpp"
#include "palpable/core/picture/camera.hpp"
#include "palpable/core/result.hpp"
#include "palpable/core/work.hpp"
#include "palpable/measure/camera_path_score.hpp"

#include <cstddef>
#include <optional>
#include <span>
#include <variant>
#include <vector>

namespace palpable::measure {

/// The true surface, in the truth's world frame: triangles of any orientation, closed or not, or points on
/// it. A distance to points is an upper bound of the distance to the surface between them.
using TrueSurface = std::variant<Mesh, PointCloud>;

/// A camera that filmed the true surface.
struct TrueCamera {
  Transform<TrueWorldFrame, CameraFrame> pose;
  /// If not given, it sees in all directions.
  std::optional<Pinhole> pinhole;
};

struct StructureScoreOptions {
  /// A true point counts as found within this distance of a result point, share of the diagonal, 0.0001 …
  /// 0.5.
  double found_within = 0.01;
  /// Share of the points at each end of each axis that the box of the scored region ignores, 0 … 0.2;
  /// otherwise a few wrong points far away would enlarge it.
  double box_tail = 0.01;
  /// Distances above this quantile are truncated to it in the truncated RMS, 0.5 … 1.
  double truncated_at = 0.98;
  /// Side of the pieces into which true triangles are divided for completeness, share of the diagonal, 0.0005
  /// … 0.1.
  double piece = 0.005;
  /// A true point is visible if at least one of this many evenly chosen cameras sees it, 1 … 1000.
  int most_cameras = 24;
};
std::vector<Parameter> parameters_of(StructureScoreOptions& options);

/// Percentages are relative to the diagonal of the scored region: the box of the result points without
/// StructureScoreOptions::box_tail on each side. For completeness the region is larger on every side by
/// StructureScoreOptions::found_within.
struct StructureScore {
  std::size_t points = 0;
  /// In the unit of the truth.
  double diagonal = 0.0;
  /// Distances of the result points from the true surface.
  double accuracy_rms_percent = 0.0;
  double accuracy_truncated_rms_percent = 0.0;
  double accuracy_median_percent = 0.0;
  /// Share of the true surface in the region, by area (for points: by number), that has a result point
  /// nearby; 0 if none of it is there.
  double completeness_percent = 0.0;
  /// The same for the part that a camera can see; nullopt without cameras.
  std::optional<double> visible_completeness_percent;
};

/// Compares reconstructed surface points with the true surface. `cameras`: those that filmed it, for the
/// visible part. A point is visible if it is in the picture of a camera and no triangle is in between; points
/// occlude nothing. Long work: reports progress, polls cancel. Errors: usage for options out of range;
/// invalid_input for fewer than ten points, for points at one position, and for an empty true surface;
/// interrupted.
Result<StructureScore> score_structure(const PointCloud& found,
                                       const Transform<TrueWorldFrame, WorldFrame>& true_from_found,
                                       const TrueSurface& truth, std::span<const TrueCamera> cameras,
                                       const StructureScoreOptions& options, const Work& work);

}  // namespace palpable::measure
