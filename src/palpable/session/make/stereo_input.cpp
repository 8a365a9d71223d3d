// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/session/make/stereo_input.hpp"

#include "palpable/session/make/places.hpp"
#include "palpable/sources/calibration/calibration.hpp"
#include "palpable/vision/image/reduced_picture.hpp"
#include "palpable/vision/rectification/stereo_rectification.hpp"
#include "palpable/vision/stereo/methods/match.hpp"

#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include <fmt/format.h>

namespace palpable::session {
namespace {

vision::LensCamera lens_of(const sources::CameraModel& camera) { return {camera.matrix, camera.distortion}; }

Result<std::optional<sources::Calibration>> calibration_of(const StereoInput& input, const Image& picture) {
  using Found = std::optional<sources::Calibration>;
  if (input.calibration.empty()) return Found();
  auto calibration = sources::read_calibration(input.calibration);
  if (!calibration) return calibration.error();
  auto fitted = sources::calibration_for(std::move(*calibration), picture.width, picture.height);
  if (!fitted) return at_place(fitted.error(), input.calibration);
  return Found(std::move(*fitted));
}

/// Reduces a pair that is too large, and its calibration, which fits its present size.
Result<void> reduce(const StereoInput& input, ReadyPair& ready,
                    std::optional<sources::Calibration>& calibration) {
  auto left = vision::reduced(ready.pair.left, input.most_pixels);
  if (!left) return {};
  ready.notes.emplace_back(fmt::format(
      "The pictures were reduced from {} to {} pixels each: a finger feels no difference, and matching is "
      "possible in little memory.",
      size_text(ready.pair.left.width, ready.pair.left.height), size_text(left->width, left->height)));
  ready.pair.right = *vision::reduced(ready.pair.right, input.most_pixels);
  ready.pair.left = *std::move(left);
  if (!calibration) return {};
  auto scaled =
      sources::calibration_for(*std::move(calibration), ready.pair.left.width, ready.pair.left.height);
  if (!scaled) return at_place(scaled.error(), input.calibration);
  calibration = *std::move(scaled);
  return {};
}

void take(ReadyPair& ready, vision::RectifiedPair rectified, RectifiedBy rectified_by) {
  ready.pair = std::move(rectified.pair);
  ready.residual_before_px = rectified.residual_before_px;
  ready.residual_px = rectified.residual_px;
  ready.features = rectified.features;
  if (rectified.changed) ready.rectified_by = rectified_by;
  ready.notes.insert(ready.notes.end(), rectified.notes.begin(), rectified.notes.end());
}

/// The camera of pictures from one moved camera: from the calibration; else a typical one, with a note.
vision::LensCamera moved_camera(const std::optional<sources::Calibration>& calibration, ReadyPair& ready) {
  if (calibration) return lens_of(calibration->left);
  ready.notes.emplace_back(
      "The camera's focal length is not known; a field of view of 65 degrees was assumed, so all depths may "
      "be wrong by one common factor.",
      Reason::needs_calibration);
  return vision::usual_camera(ready.pair.left.width, ready.pair.left.height);
}

Result<void> rectify_moved(const StereoInput& input, const std::optional<sources::Calibration>& calibration,
                           ReadyPair& ready, const Work& work) {
  auto rectified =
      vision::rectify_moved_camera(ready.pair, moved_camera(calibration, ready), *input.moved_m, work);
  if (!rectified) return rectified.error();
  take(ready, std::move(*rectified), RectifiedBy::movement);
  return {};
}

Result<void> rectify_by_features(ReadyPair& ready, const Work& work) {
  auto rectified = vision::rectify_uncalibrated(ready.pair, work);
  if (!rectified) return rectified.error();
  take(ready, std::move(*rectified), RectifiedBy::features);
  return {};
}

/// Rectifies by the calibration, which states a rectified pair, two cameras with their poses, or only their
/// lenses.
Result<void> rectify_calibrated(const sources::Calibration& calibration, ReadyPair& ready, const Work& work) {
  if (calibration.rig) {
    ready.pair.rig = calibration.rig;
    return {};
  }
  const vision::LensCamera left = lens_of(calibration.left);
  const vision::LensCamera right = calibration.right ? lens_of(*calibration.right) : left;
  if (calibration.right && calibration.rotation && calibration.translation_m) {
    auto rectified = vision::rectify_calibrated(
        ready.pair, {left, right, *calibration.rotation, *calibration.translation_m});
    if (!rectified) return rectified.error();
    take(ready, std::move(*rectified), RectifiedBy::calibration);
    return {};
  }
  if (!calibration.right)
    ready.notes.emplace_back(
        "The calibration describes one camera: both pictures were assumed to come from it, and depth has no "
        "unit, because the distance between the two positions is unknown.",
        Reason::needs_camera_movement);
  auto straight = vision::undistorted(ready.pair, left, right);
  if (!straight) return straight.error();
  ready.pair = std::move(*straight);
  return rectify_by_features(ready, work);
}

Result<void> rectify(const StereoInput& input, const std::optional<sources::Calibration>& calibration,
                     ReadyPair& ready, const Work& work) {
  if (input.moved_m) return rectify_moved(input, calibration, ready, work);
  if (calibration) return rectify_calibrated(*calibration, ready, work);
  return rectify_by_features(ready, work);
}

}  // namespace

std::string_view name_of(RectifiedBy rectified_by) {
  constexpr std::array<std::string_view, 4> kNames{"nothing", "calibration", "features", "movement"};
  return kNames[static_cast<std::size_t>(rectified_by)];
}

Result<ReadyPair> read_stereo_pair(const StereoInput& input, const Work& work) {
  if (input.pictures.size() > 2)
    return Error{ErrorCode::usage, "a stereo pair is two pictures, or one that holds both side by side", {}};
  auto two = sources::read_stereo(input.pictures, input.layout);
  if (!two) return two.error();
  auto calibration = calibration_of(input, two->left);
  if (!calibration) return calibration.error();
  ReadyPair ready;
  ready.pair = {std::move(two->left), std::move(two->right), {}};
  ready.notes.assign(two->notes.begin(), two->notes.end());
  if (const auto done = reduce(input, ready, *calibration); !done) return done.error();
  ready.residual_before_px = ready.residual_px = std::numeric_limits<double>::quiet_NaN();
  if (*calibration)
    ready.notes.insert(ready.notes.end(), (*calibration)->notes.begin(), (*calibration)->notes.end());
  if (input.rectification == Rectification::never && !input.moved_m) {
    if (*calibration) ready.pair.rig = (*calibration)->rig;
    return ready;
  }
  if (const auto done = rectify(input, *calibration, ready, work); !done)
    return at_place(done.error(),
                    input.calibration.empty() ? names_of(input.pictures) : input.calibration.string());
  return ready;
}

}  // namespace palpable::session
