// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/frame.hpp"
#include "palpable/core/note.hpp"
#include "palpable/core/parameters.hpp"
#include "palpable/vision/motion/structure/camera_motion.hpp"

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace palpable::recipes {

/// Figures of a video and its reconstruction.
struct VideoFigures {
  /// Frames that were read; of these, blurred ones and copies of the frame before, which were left out.
  int frames = 0, blurred = 0, copies = 0;
  /// Further blurred frames, which were used because those around them are no better.
  int soft = 0;
  /// Width of the strongest edges (vision::edge_width_px()), the median of the frames, px.
  double edge_width_px = 0.0;
  /// Frames whose camera position was found, and the number of the frames that were tried.
  int posed = 0, tried = 0;
  /// Numbers of the frames before which a video was cut.
  std::vector<int> cuts;
  /// Median number of points that a frame shares with the next one.
  double followed_points = 0.0;
  /// Share of the points that move by themselves (vision::moving_points()).
  double moving_points = 0.0;
  /// The largest area of a frame that is covered by something that other frames do not show, share of the
  /// picture (vision::covered_shares()).
  double covered = 0.0;
  /// Mean grey level, 0 … 1.
  double brightness = 0.0;
  /// Share of the pixels of the depth maps whose depth is known.
  double known_depth = 0.0;
  double reprojection_rms_px = 0.0;
  /// Whether a camera saw this side of the model at more than a grazing angle.
  bool left_seen = false, right_seen = false, front_seen = false, back_seen = false;
};

/// When a video gets advice. Every limit is one at which the result became visibly worse.
struct VideoAdviceOptions {
  /// Fewer frames than this, 0 … 1000.
  int least_frames = 12;
  /// More blurred frames than this share, 0 … 1.
  double most_blurred = 0.2;
  /// Wider edges than this show that all frames are blurred, px, 1 … 8.
  double most_edge_width_px = 4.5;
  /// Fewer frames with a camera position than this share, 0 … 1.
  double least_posed = 0.9;
  /// Fewer points from frame to frame than this, 0 … 20 000.
  int least_points = 150;
  /// A greater share of points that move by themselves, 0 … 1.
  double most_moving = 0.05;
  /// … or a greater covered area, share of the picture, 0 … 1.
  double most_covered = 0.005;
  /// Darker pictures than this, 0 … 1.
  double least_brightness = 0.18;
  /// Less known depth than this, 0 … 1.
  double least_known_depth = 0.5;
  /// Pictures whose grey levels (1 % to 99 % of them) differ by less show one plain colour, levels of 255, 0
  /// … 255.
  int least_contrast = 25;
  /// A side is seen from this angle on, degrees, 0 … 90.
  double side_angle_deg = 10.0;
  /// A frame that shares fewer than this share of its points with the one before begins after a cut, 0 … 1.
  double cut_share = 0.08;
};
std::vector<Parameter> parameters_of(VideoAdviceOptions& options);

/// The number of points that each frame shares with the next one; `frame_count` - 1 of them.
std::vector<int> shared_points(std::span<const vision::PointTrack> tracks, int frame_count);

/// The frames that begin after a cut: indices of frames that share hardly any point with the one before,
/// although both neighbours share many with theirs, and beyond which the camera's path does not go on.
/// `poses`: of each frame; nullopt where none was found.
std::vector<int> cuts_in(std::span<const vision::PointTrack> tracks,
                         std::span<const std::optional<vision::CameraPose>> poses,
                         const VideoAdviceOptions& options);

/// Which sides of a model at `centre` the cameras at `positions` saw. Axes: x right, y to the back, z up.
void add_seen_sides(std::span<const Vec3> positions, Vec3 centre, const VideoAdviceOptions& options,
                    VideoFigures& figures);

/// What to do better, for people without technical knowledge; the most important first. Empty for a good
/// video.
std::vector<Note> advice_on(const VideoFigures& figures, const VideoAdviceOptions& options);

}  // namespace palpable::recipes
