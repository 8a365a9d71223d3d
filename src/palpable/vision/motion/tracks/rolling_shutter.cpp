// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/motion/tracks/rolling_shutter.hpp"

#include "palpable/vision/motion/tracks/polynomial_derivatives.hpp"

#include <array>

namespace palpable::vision {

PlaceMotion place_motion(const PointTrack& track, int frame, std::span<const int> frame_numbers) {
  const NodeFrames nodes =
      node_frames(frame, frame_numbers, [&](int other) { return track.in_frame(other); });
  std::array<double, kMostNodes> x{}, y{};
  for (std::size_t i = 0; i < nodes.count; ++i)
    x[i] = track.in(nodes.frames[i]).x, y[i] = track.in(nodes.frames[i]).y;
  const std::span<const double> times(nodes.times.data(), nodes.count);
  const Derivatives along_x = derivatives_at_zero(times, {x.data(), nodes.count}),
                    along_y = derivatives_at_zero(times, {y.data(), nodes.count});
  return {{along_x.first, along_y.first}, {along_x.second, along_y.second}};
}

ImagePoint reading_place(ImagePoint place, int width, int height) {
  return {(place.x + 0.5) / width - 0.5, (place.y + 0.5) / height - 0.5};
}

std::vector<PointTrack> without_rolling_shutter(std::span<const PointTrack> tracks, const Readout& readout,
                                                int width, int height, std::span<const int> frame_numbers) {
  std::vector<PointTrack> out(tracks.begin(), tracks.end());
  if (readout == Readout{}) return out;
  for (std::size_t i = 0; i < tracks.size(); ++i)
    for (int frame = tracks[i].first_frame; frame < tracks[i].end_frame(); ++frame) {
      if (!tracks[i].in_frame(frame)) continue;
      const ImagePoint seen = tracks[i].in(frame), at = reading_place(seen, width, height);
      const double t = readout.rows * at.y + readout.columns * at.x;
      const auto [velocity, acceleration] = place_motion(tracks[i], frame, frame_numbers);
      out[i].places[static_cast<std::size_t>(frame - tracks[i].first_frame)] = {
          seen.x - t * velocity.x + t * t / 2 * acceleration.x,
          seen.y - t * velocity.y + t * t / 2 * acceleration.y};
    }
  return out;
}

}  // namespace palpable::vision
