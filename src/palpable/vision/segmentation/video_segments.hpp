// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/parameters.hpp"
#include "palpable/core/picture/image.hpp"
#include "palpable/core/result.hpp"
#include "palpable/vision/segmentation/segment_features.hpp"

#include <vector>

namespace palpable::vision {

/// A point of a frame, px, and its motion since the previous frame of the sequence, px.
struct MovedPoint {
  double x = 0.0, y = 0.0;
  double dx = 0.0, dy = 0.0;
};

/// A frame of a video with what else is known of it.
struct SegmentFrame {
  Raster<Rgb8> picture;
  /// Of tracks or of a dense flow; a pixel has the motion of the nearest point. Empty: not known.
  std::vector<MovedPoint> motion;
  /// Height above the table in any unit, NaN where it is not known; such pixels have the height of the
  /// nearest known one. Empty, or of the picture's size.
  Raster<float> height;
};

struct VideoSegmentOptions {
  /// Pixels are grouped into square cells of this side, px, 1 … 16.
  int cell_px = 2;
  /// Standard deviation, in the picture, of the filter that smooths colours except across edges, px, 0 … 20.
  double smooth_px = 2.0;
  /// Differences that count as one: of CIELAB colours, 1 … 100;
  double colour_levels = 15.0;
  /// of positions, share of the diagonal, 0.01 … 10;
  double position_share = 0.3;
  /// of motions, share of the frame's range of motions, 0.01 … 10, and at least so much, px, 0.1 … 100;
  double motion_share = 0.25;
  double motion_px = 1.0;
  /// of heights, share of the frame's range of heights, 0.01 … 10.
  double height_share = 0.15;
  /// What differs more from all segments, in these units and apart from its position, begins one, 0.1 … 100.
  double new_distance = 2.0;
  /// Adjacent segments that differ less become one, 0 … 100.
  double merge_distance = 0.8;
  /// Fragments with a smaller interior (cells without a neighbour in another segment: thin strips have none)
  /// join the neighbour that they resemble most, share of the picture, 0 … 0.5.
  double least_share = 0.003;
  /// Segments at the beginning, 1 … 255.
  int most_segments = 30;
  /// Rounds of assignment and new centres, 1 … 100.
  int iterations = 8;
};
std::vector<Parameter> parameters_of(VideoSegmentOptions& options);

struct VideoSegment {
  /// The same in all frames; no other segment of the video has it. From 0.
  int identity = 0;
  int pixels = 0;
};

/// A frame divided into connected segments.
struct FrameSegments {
  /// The identity of each pixel's segment.
  Raster<int> of_pixel;
  std::vector<VideoSegment> segments;
};

/// Divides the frames of a video into segments by k-means with connectivity constraints (Kompatsiaris &
/// Strintzis 2000). Cells join the centre that is nearest in colour, motion and height, and in position
/// relative to the segment's size. Segments that fall apart are separated, small fragments join the neighbour
/// that they resemble, similar neighbours become one, and the number of segments follows from that. The first
/// frame's centres are found by the max-min distance; each further frame begins with those of the frame
/// before, which keeps their identities. Deterministic. One thread at a time.
class VideoSegmenter {
 public:
  explicit VideoSegmenter(const VideoSegmentOptions& options) : options_(options) {}

  /// The next frame; all have the same size. Errors: usage for options out of range; invalid_input for a
  /// frame of another size than the first, an empty one, or a height map of another size.
  Result<FrameSegments> add(const SegmentFrame& frame);

 private:
  VideoSegmentOptions options_;
  int width_ = 0, height_ = 0;
  int next_identity_ = 0;
  std::vector<SegmentCentre> centres_;
};

}  // namespace palpable::vision
