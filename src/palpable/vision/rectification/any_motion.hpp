// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/vision/rectification/pair_motion.hpp"
#include "palpable/vision/rectification/vertical_offsets.hpp"
#include "palpable/vision/stereo/problem/epipolar_frame.hpp"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

// Inside vision's sources only: common rows for a camera that was not moved straight to the side.
namespace palpable::vision {

struct AnyMotionOptions {
  /// The motion explains at least this share of the matches. 0 … 1.
  double least_share = 0.6;
  /// Of these, at least this share lies beyond what a camera that only turned and zoomed explains. 0 … 1.
  double least_beyond_turn = 0.03;
  /// Above this part of the direction along the axis over the part across it, the frame is polar.
  double polar_forward = 0.36;
  /// The rectifying rotations do it if common rows move no corner of either picture farther than this, px of
  /// a picture of 480 columns.
  double kept_px = 8.0;
  /// Repeated patterns and distorted lenses mislead features: only a motion of at least so many points that
  /// explains this share of them, at most this share of the tolerance off their lines (RMS), is used without
  /// tracking corners; another one must explain this many times the features of the rectifying rotations. 20
  /// … 100000; 0 … 1 each; 1 … 10.
  int clear_points = 200;
  double clear_share = 0.9;
  double clear_residual_share = 0.2;
  double more_matches = 1.1;
  /// Rows are moved only if that explains this many times the matches of a rigid motion, or as many this many
  /// times nearer (RMS).
  double more_by_offsets = 1.08;
  double nearer_by_offsets = 1.5;
};

struct AnyMotion {
  EpipolarFrame frame;
  /// "upwards", "forward": for people.
  std::string words;
};

/// How the camera moved, if a rigid motion explains the matches; its parallax may be none.
std::optional<PairMotion> find_any_motion(const std::vector<FeatureMatch>& matches,
                                          const SharedCamera& camera, double tolerance_px,
                                          const AnyMotionOptions& options = {});

/// Whether near and far moved differently.
bool has_parallax(const PairMotion& motion, const AnyMotionOptions& options = {});

/// Whether common rows of such a motion nearly keep both pictures, so that the rectifying rotations bring
/// them there.
bool keeps_pictures(const PairMotion& motion, int width, int height, const AnyMotionOptions& options = {});

/// Whether it needs no tracked corners beside the features.
bool is_clear(const PairMotion& motion, std::size_t matches, double tolerance_px,
              const AnyMotionOptions& options = {});

/// Whether it explains more matches than the rectifying rotations, which explain `on_rows`.
bool explains_more(const PairMotion& motion, std::size_t on_rows, const AnyMotionOptions& options = {});

/// Whether rows that are moved by `offsets` explain clearly more matches than the motion, or as many clearly
/// nearer: a surface of offsets must not take away parallax.
bool offsets_explain_more(const VerticalOffsets& offsets, const PairMotion& motion,
                          const std::vector<FeatureMatch>& matches, double tolerance_px,
                          const AnyMotionOptions& options = {});

/// The frame of pictures whose camera moved like that.
AnyMotion frame_of_motion(const PairMotion& motion, int width, int height,
                          const AnyMotionOptions& options = {});

}  // namespace palpable::vision
