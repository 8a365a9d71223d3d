// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/vision/motion/tracks/point_tracks.hpp"

#include <span>
#include <vector>

namespace palpable::vision {

/// Rolling shutter: the time from the reading of a frame's first row to that of its last one, in times
/// between two frames of the video, -1 … 1; negative if the last one is read first. `columns` is that of an
/// upright video, whose frames the camera's sensor reads from side to side. Zero: all at once.
struct Readout {
  double rows = 0.0;
  double columns = 0.0;
  bool operator==(const Readout&) const = default;
};

/// How a track's place changes: px per frame, and px per frame squared.
struct PlaceMotion {
  ImagePoint velocity, acceleration;
};

/// The movement of a track in one of its frames, by the polynomial through its places in up to four frames
/// around it; zero if it has no other place. `frame_numbers`: of each frame, in the video: equal steps are
/// equal times. Allocates nothing.
PlaceMotion place_motion(const PointTrack& track, int frame, std::span<const int> frame_numbers);

/// Where a pixel is in the order of reading, -0.5 … 0.5: its row and its column.
ImagePoint reading_place(ImagePoint place, int width, int height);

/// The tracks as a camera would have seen them that reads all pixels when this one reads the middle of the
/// frame: each place is moved along its track. `width`, `height` of the frames, px.
std::vector<PointTrack> without_rolling_shutter(std::span<const PointTrack> tracks, const Readout& readout,
                                                int width, int height, std::span<const int> frame_numbers);

}  // namespace palpable::vision
