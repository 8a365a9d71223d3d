// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/rectification/stereo_rectification.hpp"

#include "palpable/vision/image/opencv_image.hpp"
#include "palpable/vision/rectification/any_motion.hpp"
#include "palpable/vision/rectification/feature_matches.hpp"
#include "palpable/vision/rectification/rectification_input.hpp"
#include "palpable/vision/rectification/rectifying_rotations.hpp"
#include "palpable/vision/rectification/tracked_matches.hpp"
#include "palpable/vision/rectification/vertical_offsets.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <opencv2/imgproc.hpp>

namespace palpable::vision {
namespace {

using Options = StereoRectificationOptions;

/// The picture rectified by `homography`, with rows moved by the vertical offsets if given.
Image warped(const Image& image, const RectifyingTransform& by, const Matrix3& homography,
             const VerticalOffsets* offsets = nullptr) {
  const Matrix3 back = inverse(homography);
  cv::Mat from(image.height, image.width, CV_32FC2);
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      const double lower = offsets != nullptr ? offsets->offset_px(x, y) : 0.0;
      const PicturePoint p = source_point(by, back, {1.0 * x, y + lower});
      from.at<cv::Point2f>(y, x) = {static_cast<float>(p.x), static_cast<float>(p.y)};
    }
  cv::Mat out;
  cv::remap(view_of(image), out, from, {}, cv::INTER_LINEAR, cv::BORDER_REPLICATE);
  return image_from(out, image);
}

RectifiedPair unchanged(const StereoPair& pair, const std::vector<FeatureMatch>& matches,
                        const Options& options) {
  RectifiedPair out;
  out.pair = pair;
  out.features = static_cast<int>(matches.size());
  out.residual_before_px = vertical_rms_px(matches);
  out.residual_px = out.residual_before_px;
  if (out.features < options.least_matches)
    out.notes.push_back(fmt::format(
        "Only {} points were matched between the two pictures, too few to tell whether they are rectified.",
        out.features));
  return out;
}

/// A way to rectify a pair: rotations of its cameras or, if no rotation explains the matches, vertical
/// offsets of the right picture's rows.
struct RectificationCandidate {
  RectifyingRotations rotations;
  std::optional<VerticalOffsets> offsets;
  /// The greatest offset.
  double greatest_px = 0.0;

  /// The inliers in the rectified pictures.
  std::vector<FeatureMatch> rectified_inliers() const {
    std::vector<FeatureMatch> rectified = rectified_matches(rotations.inliers, rotations.transform);
    if (offsets)
      for (FeatureMatch& m : rectified) m = offsets->corrected(m);
    return rectified;
  }
  double residual_px() const { return vertical_rms_px(rectified_inliers()); }
};

/// A candidate, and the matches that it was estimated from.
struct RectificationEstimate {
  std::vector<FeatureMatch> matches;
  RectificationCandidate candidate;
  /// Share of the corners tracked last that were on common rows already.
  double share = 0.0;
};

/// Features, and the rigid motion that explains them if there is one.
struct RigidFeatures {
  std::vector<FeatureMatch> features;
  std::optional<PairMotion> motion;
};

/// The rotations, unless vertical offsets explain much more, and more than a rigid motion, whose parallax
/// they would take away; then the left picture does not change.
RectificationCandidate candidate_of(const std::vector<FeatureMatch>& matches, RectifyingRotations rotations,
                                    const Image& picture, const RigidFeatures& rigid,
                                    const Options& options) {
  const double tolerance_px = feature_tolerance_px(picture.width, picture.height, options.features);
  const VerticalOffsetScore score =
      cross_validate_offsets(matches, picture.width, picture.height, tolerance_px, options.offsets);
  const double other_px = vertical_rms_px(rectified_matches(rotations.inliers, rotations.transform));
  auto offsets = score.is_better_than(rotations.inliers.size(), other_px, options.offsets)
                     ? VerticalOffsets::through(matches, picture.width, picture.height, options.offsets)
                     : std::nullopt;
  if (!offsets ||
      (rigid.motion && !offsets_explain_more(*offsets, *rigid.motion, rigid.features, tolerance_px)))
    return {std::move(rotations), {}, 0.0};
  RectifyingRotations none;
  for (const FeatureMatch& m : matches)
    if (const FeatureMatch corrected = offsets->corrected(m);
        std::abs(corrected.right_y - corrected.left_y) <= tolerance_px)
      none.inliers.push_back(m);
  return {std::move(none), std::move(offsets), score.greatest_px};
}

StereoPair rectified(const StereoPair& pair, const RectificationCandidate& candidate) {
  const RectifyingTransform& transform = candidate.rotations.transform;
  return {warped(pair.left, transform, transform.left),
          warped(pair.right, transform, transform.right, candidate.offsets ? &*candidate.offsets : nullptr),
          {}};
}

/// The match in the pictures before they were rectified.
FeatureMatch source_match(FeatureMatch m, const RectificationCandidate& candidate) {
  const RectifyingTransform& transform = candidate.rotations.transform;
  if (candidate.offsets) m.right_y += candidate.offsets->offset_px(m.right_x, m.right_y);
  const PicturePoint p = source_point(transform, inverse(transform.left), {m.left_x, m.left_y}),
                     q = source_point(transform, inverse(transform.right), {m.right_x, m.right_y});
  return {p.x, p.y, q.x, q.y};
}

double share_on_rows(const std::vector<FeatureMatch>& matches, double tolerance_px) {
  const RectifyingTransform none;
  return static_cast<double>(inliers_of(matches, none, tolerance_px).size()) /
         static_cast<double>(std::max<std::size_t>(1, best_alternatives(matches, none).size()));
}

/// After a first rectification by features, corners are tracked between the pictures, since features are few
/// and absent in repeated patterns.
Result<RectificationEstimate> estimate_from(const StereoPair& pair, const SharedCamera& camera,
                                            const RigidFeatures& rigid, RectifyingRotations first,
                                            const Options& options, const Work& work) {
  const double tolerance_px = feature_tolerance_px(pair.left.width, pair.left.height, options.features);
  const std::vector<FeatureMatch>& features = rigid.features;
  RectificationEstimate out{features, candidate_of(features, std::move(first), pair.left, rigid, options)};
  for (int round = 0; round < options.rounds; ++round) {
    if (static_cast<int>(out.candidate.rotations.inliers.size()) < options.least_matches) return out;
    if (work.cancelled()) return Work::interrupted();
    const auto tracked = tracked_matches(rectified(pair, out.candidate), out.candidate.rectified_inliers(),
                                         work, options.tracking);
    if (!tracked) return tracked.error();
    out.share = share_on_rows(*tracked, 0.5 * tolerance_px);
    out.matches = features;
    for (const FeatureMatch& m : *tracked) out.matches.push_back(source_match(m, out.candidate));
    RectifyingRotations rotations =
        find_rectifying_rotations(out.matches, camera, tolerance_px, work.seed, options.rotations);
    out.matches = best_alternatives(out.matches, rotations.transform);
    out.candidate = candidate_of(out.matches, std::move(rotations), pair.left, rigid, options);
    if (out.share > options.rectified_matches_share) break;
  }
  return out;
}

/// With few features, some may agree on wrong rotations by chance, which misleads the tracking of corners. If
/// most corners are off their rows, estimation restarts from a rough estimate, and the candidate with more
/// inliers is used.
Result<RectificationEstimate> estimate(const StereoPair& pair, const SharedCamera& camera,
                                       const RigidFeatures& rigid, RectifyingRotations first,
                                       const Options& options, const Work& work) {
  auto out = estimate_from(pair, camera, rigid, std::move(first), options, work);
  if (!out || out->share > options.restart_share) return out;
  const double tolerance_px = feature_tolerance_px(pair.left.width, pair.left.height, options.features);
  auto again =
      estimate_from(pair, camera, rigid,
                    find_rough_rotations(rigid.features, camera, tolerance_px, work.seed, options.rotations),
                    options, work);
  if (!again) return again;
  return again->candidate.rotations.inliers.size() > out->candidate.rotations.inliers.size() ? again : out;
}

/// Rectifies the pair unless the residual is too large; `out` initially holds the input pair.
void rectify(RectifiedPair& out, const RectificationEstimate& estimate, const Options& options) {
  const RectificationCandidate& candidate = estimate.candidate;
  const double residual_px = candidate.residual_px();
  if (!(residual_px <= options.most_residual_px && residual_px <= out.residual_before_px)) {
    out.notes.push_back(
        fmt::format("The pictures could not be rectified: matched points differ vertically by {:.1f} pixels "
                    "(RMS), and by {:.1f} at best.",
                    out.residual_before_px, residual_px));
    return;
  }
  StereoPair result = rectified(out.pair, candidate);
  out.pair.left = std::move(result.left);
  out.pair.right = std::move(result.right);
  out.residual_px = residual_px;
  out.changed = true;
  if (out.residual_before_px <= options.rectified_px) return;
  out.notes.push_back(
      fmt::format("The pictures were rectified: matched points differed vertically by {:.1f} pixels (RMS), "
                  "now by {:.2f} over {} of {} points.",
                  out.residual_before_px, out.residual_px, out.features, estimate.matches.size()));
  if (candidate.offsets)
    out.notes.push_back(
        fmt::format("The right picture's rows are displaced vertically by up to {:.1f} pixels, which no "
                    "rotation of a camera explains (a rolling shutter, a loose scan): they were moved onto "
                    "the left one's.",
                    candidate.greatest_px));
}

/// The pair with the frame of its camera's motion; the pictures stay as they are.
RectifiedPair in_frame_of(const PairMotion& motion, const StereoPair& pair, const Options& options) {
  const AnyMotion found = frame_of_motion(motion, pair.left.width, pair.left.height);
  RectifiedPair out = unchanged(pair, motion.inliers, options);
  out.pair.rig.reset();
  out.pair.frame = found.frame;
  out.residual_px = motion.residual_px;
  out.changed = true;
  out.notes.push_back(
      fmt::format("The camera was moved {}: the pictures are matched along that direction ({} points within "
                  "{:.2f} pixels of it).",
                  found.words, out.features, out.residual_px));
  return out;
}

}  // namespace

Result<RectifiedPair> rectify_uncalibrated(const StereoPair& pair, const Work& work, const Options& options) {
  if (const auto ok = check_input(pair, options); !ok) return ok.error();
  try {
    work.report(0.0, "looking for the same points in both pictures");
    const std::vector<FeatureMatch> features = match_features(pair, options.features);
    if (work.cancelled()) return Work::interrupted();
    const double tolerance_px = feature_tolerance_px(pair.left.width, pair.left.height, options.features);
    const SharedCamera camera = unknown_camera(pair.left.width, pair.left.height);
    const auto as_they_are = inliers_of(features, RectifyingTransform{}, tolerance_px);
    RectifyingRotations first =
        find_rectifying_rotations(features, camera, tolerance_px, work.seed, options.rotations);
    if (vertical_rms_px(as_they_are) <= options.rectified_px &&
        static_cast<double>(as_they_are.size()) >=
            options.rectified_matches_share * static_cast<double>(first.inliers.size()))
      return unchanged(pair, as_they_are, options);
    const RigidFeatures rigid{features, find_any_motion(features, camera, tolerance_px)};
    const bool needs_frame = rigid.motion && has_parallax(*rigid.motion) &&
                             !keeps_pictures(*rigid.motion, pair.left.width, pair.left.height);
    if (needs_frame && is_clear(*rigid.motion, features.size(), tolerance_px))
      return in_frame_of(*rigid.motion, pair, options);
    const std::size_t on_rows = first.inliers.size();
    const auto found = estimate(pair, camera, rigid, std::move(first), options, work);
    if (needs_frame && found && !found->candidate.offsets && explains_more(*rigid.motion, on_rows))
      return in_frame_of(*rigid.motion, pair, options);
    if (!found) return found.error();
    RectifiedPair out = unchanged(pair, found->candidate.rotations.inliers, options);
    if (out.features < options.least_matches) return out;
    rectify(out, *found, options);
    if (out.changed) out.pair.rig.reset();
    if (rigid.motion && !has_parallax(*rigid.motion))
      out.notes.emplace_back(
          "Near and far moved alike between the pictures, as if the camera was turned or zoomed in one "
          "place, or everything is equally far: for depth, move it to the side and do not zoom.");
    return out;
  } catch (const cv::Exception& e) {
    return failure("rectified", e);
  }
}

Result<RectifiedPair> rectify_moved_camera(const StereoPair& pair, const LensCamera& camera, double moved_m,
                                           const Work& work, const Options& options) {
  if (const auto ok = check_input(pair, options); !ok) return ok.error();
  auto straight = undistorted(pair, camera, camera);
  if (!straight) return straight.error();
  try {
    work.report(0.0, "looking for the same points in both pictures");
    // Pixels are square: one focal length serves both axes.
    const SharedCamera shared{camera.matrix[0], camera.matrix[2], camera.matrix[5], true};
    const std::vector<FeatureMatch> features = match_features(*straight, options.features);
    if (work.cancelled()) return Work::interrupted();
    const double tolerance_px = feature_tolerance_px(pair.left.width, pair.left.height, options.features);
    const RigidFeatures rigid{features, find_any_motion(features, shared, tolerance_px)};
    if (rigid.motion && has_parallax(*rigid.motion)) {
      RectifiedPair out = in_frame_of(*rigid.motion, *straight, options);
      // Disparities of a polar frame are in units of its scale.
      const double unit_px = out.pair.frame->polar ? out.pair.frame->polar->scale_px : shared.focal_px;
      out.pair.rig = StereoRig{
          {shared.focal_px, shared.focal_px, shared.cx, shared.cy, pair.left.width, pair.left.height},
          moved_m * unit_px / shared.focal_px,
          0.0};
      return out;
    }
    RectifyingRotations first =
        find_rectifying_rotations(features, shared, tolerance_px, work.seed, options.rotations);
    const auto found = estimate(*straight, shared, rigid, std::move(first), options, work);
    if (!found) return found.error();
    const std::vector<FeatureMatch>& inliers = found->candidate.rotations.inliers;
    RectifiedPair out = unchanged(*straight, inliers, options);
    out.pair.rig =
        StereoRig{{shared.focal_px, shared.focal_px, shared.cx, shared.cy, pair.left.width, pair.left.height},
                  moved_m,
                  0.0};
    if (out.features < options.least_matches) return out;
    const double parallax_px = parallax_rms_px(inliers, shared);
    if (parallax_px < options.least_parallax_px)
      out.notes.push_back(fmt::format(
          "The camera hardly moved between the two pictures: matched points shift by {:.2f} pixels (RMS) "
          "beyond what a rotation explains, so their depth cannot be trusted; move it farther to the side.",
          parallax_px));
    rectify(out, *found, options);
    return out;
  } catch (const cv::Exception& e) {
    return failure("rectified", e);
  }
}

}  // namespace palpable::vision
