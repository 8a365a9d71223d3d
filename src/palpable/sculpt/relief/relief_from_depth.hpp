// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/picture/camera.hpp"
#include "palpable/core/work.hpp"
#include "palpable/models/relief/relief.hpp"
#include "palpable/models/scene/scene.hpp"
#include "palpable/sculpt/relief/depth_order.hpp"
#include "palpable/sculpt/relief/detail.hpp"
#include "palpable/sculpt/relief/resample.hpp"

#include <optional>

namespace palpable::sculpt {

/// Whether near parts are high or deep.
enum class Sense {
  /// Near is high.
  raise,
  /// Near is deep: the relief is engraved.
  engrave
};

/// What height stands for.
enum class HeightOf {
  /// Metric depth, where it is known.
  depth,
  /// A pair's disparity, in pixels, that is nearness by 1 / depth (Shi & Pai 1997).
  disparity
};

/// How depth becomes a relief. The defaults are the same for every picture.
struct ReliefOptions {
  /// Width, height and depth that bound the relief; the picture's aspect ratio is kept. Not given: 100 x 100
  /// mm and 15 mm high. Each 1 mm ... 1 m.
  std::optional<Vec3> size_m;
  /// Depth window: nearer and farther depths are clamped to it. In the map's own unit (metres; pixels of
  /// disparity if no camera is known). Not given: the 0.5th and 99.5th percentile.
  std::optional<double> near;
  std::optional<double> far;
  /// Multiplies the relief's height, 0.1 … 10; a given size still limits it.
  double exaggerate = 1.0;
  Sense sense = Sense::raise;
  HeightOf height_of = HeightOf::depth;
  DetailOperator detail = DetailOperator::relief;
  DetailOptions detail_options;
  /// Height of the scene in its own proportions over that of the relief (detail.hpp), 1.5 … 100.
  double compression = 10.0;
  /// No place of the relief becomes steeper than this (rise over run), 0.1 ... 100.
  double steepest_slope = 3.0;
  /// Features narrower than this are smoothed away (full width at half maximum of a Gaussian): smaller than
  /// the device's positioning accuracy. 0 = none, at most 0.01 m.
  double smooth_m = 0.0;
  /// Resampling of the depths to this many samples on the longer side, 2 … 4096, before they are mapped;
  /// none: the picture's own resolution.
  Resampling resampling = Resampling::none;
  int samples_on_a_side = 512;
  /// Larger pictures are first reduced to this by averaging.
  int most_pixels_on_a_side = 2048;
};

/// A relief from metric depth, near parts high, base at z = 0: window, holes closed smoothly, mapped to
/// height, size given, slope limited (docs/relief.md). `orders`, if not null, receives how its heights keep
/// the order of the depths inside the window. Long work: reports progress, polls cancel. Errors:
/// invalid_input where no pixel has a finite depth or the map is smaller than 2 x 2, usage for options out of
/// their range, interrupted.
Result<models::Relief> relief_from_depth(const DepthMap& depth, const ReliefOptions& options,
                                         const Work& work, DepthOrders* orders = nullptr);

/// The same from disparity: by metric depth if the camera is known and options.height_of asks for it; else
/// disparity in pixels is the nearness.
Result<models::Relief> relief_from_disparity(const DisparityMap& disparity, const ReliefOptions& options,
                                             const Work& work, DepthOrders* orders = nullptr);

/// The transform from pixels of a width x height picture to its relief: x and y by the relief's size, y
/// upwards. The mapping of depth to height is not linear, so z has no scale; it is rotated and scaled as x.
Transform<SceneFrame, models::InputFrame> scene_from_picture(const models::Relief& relief, int width,
                                                             int height);

}  // namespace palpable::sculpt
