// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/vision/rectification/pair_motion.hpp"
#include "palpable/vision/rectification/vertical_offsets.hpp"
#include "palpable/vision/stereo/problem/epipolar_frame.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

// Inside vision's sources only: common rows for a camera that was not moved to the side.
namespace palpable::vision {

struct AnyMotionOptions {
  /// Within these of sideways, the rectifying rotations do it: degrees between the direction and the rows,
  /// part of the direction along the axis over the part across it, and roll in degrees.
  double sideways_deg = 10.0;
  double sideways_forward = 0.3;
  double sideways_roll_deg = 15.0;
  /// Difference of the focal lengths, as a share.
  double sideways_zoom = 0.01;
  /// Above this part along the axis, the frame is polar.
  double polar_forward = 0.36;
  /// The motion explains this many times the matches of the rectifying rotations, and at least this share of
  /// all matches; where rows would have to be moved, at least this share of the matches that this explains: a
  /// surface of offsets must not take away parallax.
  double more_matches = 1.1;
  double least_share = 0.6;
  double instead_of_offsets = 0.93;
  /// And at most this many times as far from their lines (RMS): pictures whose rows are displaced fit a wrong
  /// motion badly.
  double as_near_as_offsets = 1.5;
  /// The rectifying rotations change the left picture too much if they roll it by more, degrees, or leave
  /// less of it, as a share: another plane of epipolar lines would be taken for rows.
  double most_roll_deg = 5.0;
  double least_kept = 0.8;
  /// Least parallax, RMS, px; and least share of it with one sign.
  double least_parallax_px = 1.0;
  double least_same_sign = 0.9;
};

struct AnyMotion {
  EpipolarFrame frame;
  std::vector<FeatureMatch> inliers;
  /// RMS distance of the inliers from common rows in the frame, px.
  double residual_px = 0.0;
  /// "upwards", "forward": for people.
  std::string words;
};

/// How the camera moved, if a rigid motion explains the matches with parallax of one sign.
std::optional<PairMotion> find_any_motion(const std::vector<FeatureMatch>& matches, int width, int height,
                                          double tolerance_px, const AnyMotionOptions& options = {});

/// Whether rectifying rotations can bring the pictures of such a motion to common rows.
bool is_sideways(const PairMotion& motion, const AnyMotionOptions& options = {});

/// Whether it explains more matches than the rectifying rotations, which explain `on_rows`.
bool explains_more(const PairMotion& motion, std::size_t on_rows, const AnyMotionOptions& options = {});

/// Whether it explains the features about as well, and as closely, as rows that are moved by `offsets`: it
/// has seven numbers, and they many.
bool explains_offsets(const PairMotion& motion, const VerticalOffsets& offsets,
                      const std::vector<FeatureMatch>& matches, double tolerance_px,
                      const AnyMotionOptions& options = {});

/// Whether a rectified left picture is still nearly the given one.
bool keeps_picture(const Matrix3& homography, int width, int height, const AnyMotionOptions& options = {});

/// The frame of pictures whose camera moved like that. Nothing where none is found. Deterministic for a seed.
std::optional<AnyMotion> frame_of_motion(const PairMotion& motion, const std::vector<FeatureMatch>& matches,
                                         int width, int height, double tolerance_px, std::uint64_t seed,
                                         const AnyMotionOptions& options = {});

}  // namespace palpable::vision
