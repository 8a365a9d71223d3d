// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/motion/tracks/affine_tracks.hpp"

#include <iterator>
#include <utility>

namespace palpable::vision {
namespace {

// A shorter rest of a track is not worth a template.
constexpr int kLeastFrames = 5;

using Frames = std::span<const Raster<std::uint8_t>>;

// The frames from `first` on, to before `end`.
PointTrack part_of(const PointTrack& track, int first, int end) {
  const auto begin = track.places.begin() - track.first_frame;
  return {first, {begin + first, begin + end}};
}

// The places in the frames after (step 1) or before (step -1) `middle`, until the patch is lost.
std::vector<ImagePoint> aligned_places(const PatchTemplate& patch, const PointTrack& track, int middle,
                                       int step, Frames frames) {
  std::vector<ImagePoint> out;
  PatchPlace place{track.in(middle)};
  for (int frame = middle + step; frame >= track.first_frame && frame < track.end_frame(); frame += step) {
    // From frame to frame the track is good.
    place.centre.x += track.in(frame).x - track.in(frame - step).x;
    place.centre.y += track.in(frame).y - track.in(frame - step).y;
    if (!patch.align(frames[static_cast<std::size_t>(frame)], place)) break;
    out.push_back(place.centre);
  }
  return out;
}

std::vector<PointTrack> aligned_parts(const PointTrack& track, Frames frames, const PatchOptions& options) {
  std::vector<PointTrack> out, waiting{track};
  while (!waiting.empty()) {
    const PointTrack part = std::move(waiting.back());
    waiting.pop_back();
    const int middle = (part.first_frame + part.end_frame()) / 2;
    const PatchTemplate patch(frames[static_cast<std::size_t>(middle)], part.in(middle), options);
    if (!patch.is_valid()) continue;
    const auto before = aligned_places(patch, part, middle, -1, frames),
               after = aligned_places(patch, part, middle, 1, frames);
    PointTrack found{middle - static_cast<int>(before.size()), {before.rbegin(), before.rend()}};
    found.places.push_back(part.in(middle));
    found.places.insert(found.places.end(), after.begin(), after.end());
    if (found.first_frame - part.first_frame >= kLeastFrames)
      waiting.push_back(part_of(part, part.first_frame, found.first_frame));
    if (part.end_frame() - found.end_frame() >= kLeastFrames)
      waiting.push_back(part_of(part, found.end_frame(), part.end_frame()));
    if (found.places.size() > 1) out.push_back(std::move(found));
  }
  return out;
}

}  // namespace

std::vector<PointTrack> affine_tracks(std::span<const Raster<std::uint8_t>> frames,
                                      std::span<const PointTrack> tracks, const PatchOptions& options,
                                      const Work& work) {
  std::vector<std::vector<PointTrack>> parts(tracks.size());
  parallel_for(work, static_cast<int>(tracks.size()), 16, [&](int begin, int end) {
    for (int i = begin; i < end && !work.cancelled(); ++i) {
      const auto at = static_cast<std::size_t>(i);
      parts[at] = aligned_parts(tracks[at], frames, options);
    }
  });
  std::vector<PointTrack> out;
  for (std::vector<PointTrack>& some : parts)
    out.insert(out.end(), std::make_move_iterator(some.begin()), std::make_move_iterator(some.end()));
  return out;
}

}  // namespace palpable::vision
