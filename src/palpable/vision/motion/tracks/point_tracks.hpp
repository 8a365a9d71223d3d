// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/parameters.hpp"
#include "palpable/core/picture/raster.hpp"
#include "palpable/core/result.hpp"
#include "palpable/core/work.hpp"

#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace palpable::vision {

/// A position in a picture, px; pixel centres are at integers.
struct ImagePoint {
  double x = 0.0, y = 0.0;
  bool operator==(const ImagePoint&) const = default;
};

/// The place of a point in a frame that does not show it.
inline constexpr ImagePoint kNotSeen{std::numeric_limits<double>::quiet_NaN(),
                                     std::numeric_limits<double>::quiet_NaN()};

/// A point of the scene and where frames show it.
struct PointTrack {
  int first_frame = 0;
  /// Its place in first_frame, first_frame + 1, …; kNotSeen in frames between that do not show it.
  std::vector<ImagePoint> places;

  int end_frame() const { return first_frame + static_cast<int>(places.size()); }
  bool in_frame(int frame) const {
    return frame >= first_frame && frame < end_frame() && !std::isnan(in(frame).x);
  }
  /// `frame` from first_frame to before end_frame().
  ImagePoint in(int frame) const { return places[static_cast<std::size_t>(frame - first_frame)]; }
};

struct TrackOptions {
  /// Greatest number of points that are tracked at the same time, 16 … 20 000.
  int most_points = 900;
  /// Least distance of new points from tracked ones, px, 2 … 100.
  double least_distance_px = 9.0;
  /// Corners of lower quality than this share of the best one are not tracked (Shi & Tomasi 1994), 0.0001 …
  /// 1.
  double least_quality = 0.005;
  /// Side of the compared window, px, odd, 5 … 61.
  int window_px = 15;
  /// Pyramid levels above the full picture, 0 … 8.
  int levels = 3;
  /// Forward-backward check: a point that, tracked back, ends farther from its start is lost, px, 0.01 … 10.
  double return_limit_px = 0.5;
  /// Number of frames after which a point's template is taken from a newer frame, 1 … 100: with fewer the
  /// point drifts, with more its appearance changes too much.
  int frames_per_template = 10;
};
std::vector<Parameter> parameters_of(TrackOptions& options);

/// Tracks corners through the frames of a video (Lucas & Kanade 1981, on pyramids as Bouguet 2001; each step
/// forwards and backwards), and detects new ones where none is tracked. Frames are 8-bit grey, all of one
/// size. Tracks of a single frame are omitted. Long work: reports progress, polls cancel. Errors: usage for
/// options out of range; invalid_input for frames of different sizes; interrupted.
Result<std::vector<PointTrack>> track_points(std::span<const Raster<std::uint8_t>> frames,
                                             const TrackOptions& options, const Work& work);

}  // namespace palpable::vision
