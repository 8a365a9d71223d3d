// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/geometry/mesh.hpp"
#include "palpable/core/parameters.hpp"
#include "palpable/core/picture/image.hpp"
#include "palpable/core/result.hpp"
#include "palpable/core/work.hpp"
#include "palpable/models/field/superquadric.hpp"
#include "palpable/recipes/solid/correction_reach.hpp"
#include "palpable/recipes/video/measured_surface.hpp"
#include "palpable/recipes/video/model_shapes.hpp"
#include "palpable/recipes/video/video_model.hpp"
#include "palpable/sculpt/correction/surface_correction.hpp"
#include "palpable/vision/segmentation/video_segments.hpp"

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

namespace palpable::recipes {

/// How superquadrics are predicted and then corrected by the depth maps (Moustakas et al. 2007).
struct CorrectedModelOptions {
  /// Of the first frame, from which the first superquadrics follow.
  vision::VideoSegmentOptions segments;
  MeasuredSurfaceOptions measured;
  /// reach_m and transition_m are not used: they follow from the evidence.
  sculpt::CorrectionOptions correction{
      .most_match_angle_deg = 60.0, .most_turn_deg = 75.0, .averaged_measurements = 64};
  /// Superquadrics are fitted to the points of the first map, of this many times as many, and so on, 2 … 100.
  int map_factor = 4;
  /// Further shapes are fitted to points farther than this share of the extent from all shapes, 0.001 … 0.5,
  /// if they are at least this share of all points, 0 … 1.
  double rest_share = 0.015;
  double least_rest = 0.01;
  /// Most passes of the correction over all maps, 1 … 20; a pass that lowers the error by less than this
  /// share is the last, 0 … 1.
  int passes = 3;
  double least_gain = 0.02;
  /// Spacing of the predicted surface's samples, in spacings of the measured surface's corners, 0.5 … 10; at
  /// most so many samples along the model's extent, 32 … 1024.
  double sample_spacings = 1.0;
  /// Shapes are at least so many spacings of samples thick where their surface is sampled, 1 … 10.
  double least_thickness_spacings = 3.0;
  int most_samples = 200;
  /// The measured points are the model's.
  CorrectionReachOptions reach;
  /// The error of a step is the mean distance of this many of the model's points from its surface, 100 …
  /// 100 000; each counts at most as this share of the extent, 0.001 … 1.
  int error_points = 3000;
  double most_error_share = 0.03;
};
std::vector<Parameter> parameters_of(CorrectedModelOptions& options);

/// One step in which a model was refined.
struct ModelStep {
  enum class Kind {
    /// Superquadrics from the segments of one picture, with an assumed depth.
    segments,
    /// Superquadrics from the points of the depth maps so far.
    superquadrics,
    /// The closed surface of all superquadrics as samples, from which the corrections start.
    sampling,
    /// The surface corrected by one depth map.
    correction
  };
  Kind kind = Kind::segments;
  /// Index of the last depth map that was used.
  std::size_t map = 0;
  /// The model's error after the step if it was taken, else the error that it would have had; in the unit of
  /// the model's axes (CorrectedModelOptions::error_points).
  double error = 0.0;
  /// A step that would raise the error is not taken, except for sampling.
  bool taken = true;
};

/// A model's superquadrics and their correction, in the model's axes.
struct CorrectedModel {
  ModelShapes shapes;
  /// Closed; corrected as far as `steps` says. Empty if the superquadrics themselves have a smaller error.
  Mesh surface;
  std::vector<ModelStep> steps;
  /// Errors before and after the corrections, in the unit of the axes.
  double predicted_error = 0.0, corrected_error = 0.0;
  double reach = 0.0, transition = 0.0;
};

/// Called after each step with the model's surface; for evaluation.
using ModelStepObserver = std::function<void(const ModelStep&, const Mesh&)>;

/// The method of Moustakas et al. 2007: superquadrics are predicted from the segments of the first frame
/// (their depth is that of the scene, their thickness the mean of their other sizes), fitted again to the
/// structure of the first, the first four, … and all depth maps, further ones are added where points are far
/// from all, and their closed surface is then corrected by the measured surface of each map in turn
/// (sculpt::correct_surface()), in several passes. A step that would raise the error is not
/// taken, so each step lowers it or leaves it. `maps`: in the order of the video, cropped to the model, at
/// least one. `first`: the picture of the first map. Deterministic. Long work. Errors: usage for options out
/// of range; as shapes_of_model(), sculpt::dual_contour() and sculpt::correct_surface().
Result<CorrectedModel> corrected_model(const VideoModel& model, std::span<const vision::FrameDepth> maps,
                                       const Raster<Rgb8>& first, const ModelShapesOptions& shapes,
                                       const CorrectedModelOptions& options,
                                       const ModelStepObserver& observer, const Work& work);

}  // namespace palpable::recipes
