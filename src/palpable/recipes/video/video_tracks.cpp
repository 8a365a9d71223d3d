// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/recipes/video/video_tracks.hpp"

#include "palpable/recipes/video/video_advice.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

namespace palpable::recipes {
namespace {

using vision::PointTrack;

int least_shared(const VideoRecipe& recipe) {
  return recipe.following.times_least * recipe.motion.least_points;
}

// Indices of the pictures that share too few points with the one before.
std::vector<int> gaps_in(const std::vector<PointTrack>& tracks, int pictures, const VideoRecipe& recipe) {
  const std::vector<int> shared = shared_points(tracks, pictures);
  const int least = least_shared(recipe);
  std::vector<int> out;
  for (std::size_t i = 0; i < shared.size(); ++i)
    if (shared[i] < least) out.push_back(static_cast<int>(i) + 1);
  return out;
}

// Tracks of points that pictures on both sides of the gap before picture `gap` show.
Result<std::vector<PointTrack>> tracks_across(std::span<const Raster<std::uint8_t>> pictures, int gap,
                                              const VideoRecipe& recipe, const Work& work) {
  const int first = std::max(0, gap - recipe.following.bridge);
  const int end = std::min(static_cast<int>(pictures.size()), gap + recipe.following.bridge);
  auto tracks = vision::match_photos(
      pictures.subspan(static_cast<std::size_t>(first), static_cast<std::size_t>(end - first)), recipe.photos,
      work);
  if (!tracks) return tracks;
  for (PointTrack& track : *tracks) track.first_frame += first;
  std::erase_if(
      *tracks, [&](const PointTrack& track) { return track.first_frame >= gap || track.end_frame() <= gap; });
  return tracks;
}

}  // namespace

bool are_followed(std::span<const PointTrack> tracks, int pictures, const VideoRecipe& recipe) {
  if (pictures < 3) return shared_points(tracks, pictures).front() >= least_shared(recipe);
  std::vector<int> shared(static_cast<std::size_t>(pictures - 2), 0);
  for (const PointTrack& track : tracks)
    for (int i = track.first_frame; i + 2 < std::min(track.end_frame(), pictures); ++i)
      if (track.in_frame(i) && track.in_frame(i + 1) && track.in_frame(i + 2))
        ++shared[static_cast<std::size_t>(i)];
  const int least = least_shared(recipe);
  const auto good = std::count_if(shared.begin(), shared.end(), [&](int count) { return count >= least; });
  return static_cast<double>(good) >= recipe.following.most_frames * static_cast<double>(shared.size());
}

Result<VideoTracks> tracks_of_video(std::span<const Raster<std::uint8_t>> pictures, const VideoRecipe& recipe,
                                    const Work& work) {
  auto followed = vision::track_points(pictures, recipe.tracks, work);
  if (!followed) return followed.error();
  VideoTracks out{*std::move(followed)};
  const int count = static_cast<int>(pictures.size());
  if (!are_followed(out.tracks, count, recipe)) {
    auto matched = vision::match_photos(pictures, recipe.photos, work);
    if (!matched) return matched.error();
    return VideoTracks{*std::move(matched), false};
  }
  for (const int gap : gaps_in(out.tracks, count, recipe)) {
    auto across = tracks_across(pictures, gap, recipe, work);
    if (!across) return across.error();
    std::move(across->begin(), across->end(), std::back_inserter(out.tracks));
  }
  return out;
}

}  // namespace palpable::recipes
