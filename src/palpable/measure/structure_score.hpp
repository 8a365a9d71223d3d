// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/camera.hpp"
#include "palpable/core/mesh.hpp"
#include "palpable/core/parameters.hpp"
#include "palpable/core/point_cloud.hpp"
#include "palpable/core/result.hpp"
#include "palpable/core/work.hpp"
#include "palpable/measure/camera_path_score.hpp"

#include <cstddef>
#include <optional>
#include <span>
#include <variant>
#include <vector>

namespace palpable::measure {

/// The true surface, in the truth's world: triangles of any orientation, closed or not, or points on it. A
/// distance to points is at least the distance to the surface between them.
using TrueSurface = std::variant<Mesh, PointCloud>;

/// A camera that filmed the true surface.
struct TrueCamera {
  Transform<TrueWorldFrame, CameraFrame> pose;
  /// Not given: it sees in all directions.
  std::optional<Pinhole> pinhole;
};

struct StructureScoreOptions {
  /// A true place counts as found within this distance of a result point, share of the diagonal, 0.0001 …
  /// 0.5.
  double found_within = 0.01;
  /// Share of the points on each side of each axis that the scored region's box does not consider, 0 … 0.2: a
  /// few wrong points far away would enlarge it otherwise.
  double box_tail = 0.01;
  /// Distances beyond this quantile count as large as it in the truncated RMS, 0.5 … 1.
  double truncated_at = 0.98;
  /// Length of the pieces into which true triangles are cut for completeness, share of the diagonal, 0.0005 …
  /// 0.1.
  double piece = 0.005;
  /// A true place was visible where at least one of so many cameras, evenly chosen, sees it, 1 … 1000.
  int most_cameras = 24;
};
std::vector<Parameter> parameters_of(StructureScoreOptions& options);

/// Figures in percent are of the diagonal of the scored region: the box of the result points, less
/// StructureScoreOptions::box_tail on each side. For completeness the region reaches farther on every side by
/// StructureScoreOptions::found_within.
struct StructureScore {
  std::size_t points = 0;
  /// In the truth's unit.
  double diagonal = 0.0;
  /// Distances of the result points from the true surface.
  double accuracy_rms_percent = 0.0;
  double accuracy_truncated_rms_percent = 0.0;
  double accuracy_median_percent = 0.0;
  /// Share of the true surface in the region, by its area (of points: by their number), that has a result
  /// point nearby; 0 where none of it lies there.
  double completeness_percent = 0.0;
  /// The same of that part which a camera can see; not given without cameras.
  std::optional<double> visible_completeness_percent;
};

/// Compares points that were found on a surface with the true surface. `cameras`: those that filmed it, for
/// the visible part; a place is visible where a camera has it in its picture and no triangle lies between.
/// Points hide nothing. Long work: reports progress, polls cancel. Errors: usage for options out of range;
/// invalid_input for fewer than ten points, for points in one place, and for a true surface that is empty;
/// interrupted.
Result<StructureScore> score_structure(const PointCloud& found,
                                       const Transform<TrueWorldFrame, WorldFrame>& true_from_found,
                                       const TrueSurface& truth, std::span<const TrueCamera> cameras,
                                       const StructureScoreOptions& options, const Work& work);

}  // namespace palpable::measure
