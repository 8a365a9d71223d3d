// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/camera.hpp"
#include "palpable/core/work.hpp"
#include "palpable/models/relief/relief.hpp"
#include "palpable/models/scene/scene.hpp"
#include "palpable/sculpt/relief/detail.hpp"
#include "palpable/sculpt/relief/resample.hpp"

#include <optional>

namespace palpable::sculpt {

/// Which way the picture's near parts go.
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
  /// Depth window: what is nearer or farther is held at the window's ends. In the map's own unit (metres;
  /// pixels of disparity where no camera is known). Not given: the 0.5th and 99.5th percentile.
  std::optional<double> near;
  std::optional<double> far;
  /// Multiplies the relief's height, 0.1 ... 10, still bounded by the size's depth where that is given.
  double exaggerate = 1.0;
  Sense sense = Sense::raise;
  HeightOf height_of = HeightOf::depth;
  DetailOperator detail = DetailOperator::relief;
  DetailOptions detail_options;
  /// How many times higher than the relief the scene would be in its own proportions (detail.hpp), 1.5 ...
  /// 100.
  double compression = 10.0;
  /// No place of the relief becomes steeper than this (rise over run), 0.1 ... 100.
  double steepest_slope = 3.0;
  /// Forms narrower than this are smoothed away (width of a Gaussian at half its height): what the device
  /// cannot place the hand on. 0 = none, at most 0.01 m.
  double smooth_m = 0.0;
  /// The depths are brought to this many samples on the longer side, 2 ... 4096, before they are mapped;
  /// none: as many as the picture has.
  Resampling resampling = Resampling::none;
  int samples_on_a_side = 512;
  /// Longer sides than this are averaged down first.
  int most_pixels_on_a_side = 2048;
};

/// A relief from metric depth, near parts high, base at z = 0: window, holes closed smoothly, mapped to
/// height, size given, slope limited (docs/relief.md). Long work: reports progress, polls cancel. Errors:
/// invalid_input where no pixel has a finite depth or the map is smaller than 2 x 2, usage for options out of
/// their range, interrupted.
Result<models::Relief> relief_from_depth(const DepthMap& depth, const ReliefOptions& options,
                                         const Work& work);

/// The same from disparity: through metric depth where the camera is known and options.height_of wants it;
/// else the disparity itself, in pixels, takes the place of nearness.
Result<models::Relief> relief_from_disparity(const DisparityMap& disparity, const ReliefOptions& options,
                                             const Work& work);

/// Where the pixels of a width x height picture lie on its relief: x and y by the relief's size, y turned
/// upwards. z has no single scale (the mapping of depth to height is not one), so the input's z is turned and
/// scaled as x is.
Transform<SceneFrame, models::InputFrame> scene_from_picture(const models::Relief& relief, int width,
                                                             int height);

}  // namespace palpable::sculpt
