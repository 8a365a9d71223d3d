// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/frame.hpp"
#include "palpable/core/picture/camera.hpp"
#include "palpable/core/result.hpp"
#include "palpable/models/relief/relief.hpp"

#include <memory>
#include <optional>

namespace palpable::session {

/// How far a view's relief is moved from its own place, metres of the scene.
struct ViewShift {
  Vec3 by_m;
  bool operator==(const ViewShift&) const = default;
};

/// A view that is touched: its relief at its own place (one sample for each pixel), the depths behind it and
/// where its camera is in the frame of the robot that stands.
struct TouchedView {
  const models::Relief& relief;
  const Raster<float>& depth_m;
  /// nullopt: not known, so that no point is.
  std::optional<Pinhole> camera;
  Transform<WorldFrame, CameraFrame> base_from_camera;
};

/// What is under a hand at this place of a scene that shows a view with this shift, in the frame of the
/// robot. nullopt: beside the view, or no depth is known there or within three pixels.
std::optional<Point<WorldFrame>> point_under(const TouchedView& view, const ViewShift& shift, Vec3 hand_m);

/// The place of a view's relief, without a shift, at which its camera sees a point. nullopt: behind it, or
/// outside of its picture.
std::optional<Vec3> place_of(const TouchedView& view, Point<WorldFrame> point);

/// The shift with which `to` takes the place of `from`, that has the shift `before`, under a hand that stays
/// where it is: the point that is under the hand comes there again, and the surface that a ball of
/// `radius_m` (0: a point) touches is at the same height there, so that the force does not change. If the
/// point is not in `to`, that view is not moved sideways, and `point` is empty.
struct ZoomedShift {
  ViewShift shift;
  std::optional<Point<WorldFrame>> point;
};
ZoomedShift zoomed_shift(const TouchedView& from, const ViewShift& before, const TouchedView& to, Vec3 hand_m,
                         double radius_m);

/// A relief that is moved by a shift, sideways by whole samples. What comes in from beyond its border is as
/// high as the border; nothing is lower than the base. Errors: as Relief::from_samples().
Result<std::shared_ptr<const models::Relief>> shifted(const models::Relief& relief, const ViewShift& shift);

/// The shift after another `dt_s`, on its way back to none while no hand touches: 10 mm/s sideways, 3 mm/s in
/// height.
ViewShift relaxed(const ViewShift& shift, double dt_s);

}  // namespace palpable::session
