// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/frame.hpp"
#include "palpable/core/picture/camera.hpp"

#include <optional>

namespace palpable::vision {

/// A camera's frame, turned about its x axis so that y is along a person's vertical: x right, y down, z level
/// ahead, metres.
struct LevelFrame;

/// How a depth camera sees a person.
struct DownwardCamera {
  Pinhole pinhole;
  /// How far it looks down, rad, within a right angle.
  double down_rad = 0.0;

  /// The direction of a pixel's ray; z times this is a reading's place.
  Vec3 ray(double u, double v) const;
  /// The pixel that sees a place before the camera.
  Vec3 pixel(Vec3 place) const;
};

/// An adult's head as an upright ellipsoid, and where its eyes are (means of published body measures).
struct HeadShape {
  /// Half the width, the height and the length, m.
  Vec3 half_m{0.077, 0.115, 0.098};
  /// The middle between the eyes is so far in front of the ellipsoid's middle, and above it, m.
  double eyes_before_m = 0.083;
  double eyes_above_m = 0.004;
};

/// A head in a depth picture.
struct HeadFit {
  /// The middle of the ellipsoid.
  Point<LevelFrame> middle;
  /// Its size, as a share of HeadShape.
  double size = 1.0;
  /// The share of what should be seen of it that lies on the ellipsoid; unknown depth counts by half.
  double covered = 0.0;
  /// Root mean square distance of the readings on it, m; and that of the same readings from their own plane.
  double rms_m = 0.0;
  double rms_of_plane_m = 0.0;
};

/// Fits the ellipsoid to the readings around it, from a middle that is at most `reach_m` away: weighted least
/// squares over place and size, without what is below the chin, in which readings that are farther from the
/// ellipsoid than a shrinking bound (hands, hair, background) do not count. nullopt if there are too few.
std::optional<HeadFit> fit_head(const Raster<float>& depth_m, const DownwardCamera& camera,
                                Point<LevelFrame> middle, double reach_m, const HeadShape& shape);

}  // namespace palpable::vision
