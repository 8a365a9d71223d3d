// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/recipes/video/video_advice.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include <fmt/format.h>

namespace palpable::recipes {
namespace {

std::string joined(const std::vector<std::string>& words) {
  std::string out;
  for (std::size_t i = 0; i < words.size(); ++i)
    out += (i == 0 ? "" : i + 1 == words.size() ? " and " : ", ") + words[i];
  return out;
}

}  // namespace

std::vector<Parameter> parameters_of(VideoAdviceOptions& o) {
  return {
      {"least_frames", &o.least_frames, {0, 1000}, "", "Advice on length: least number of frames"},
      {"most_blurred", &o.most_blurred, {0, 1}, "", "Advice on blur: greatest share of blurred frames"},
      {"most_edge_width_px",
       &o.most_edge_width_px,
       {1, 8},
       "px",
       "Advice on blur: greatest width of the strongest edges"},
      {"least_posed",
       &o.least_posed,
       {0, 1},
       "",
       "Advice on the path: least share of frames with a position"},
      {"least_points",
       &o.least_points,
       {0, 20000},
       "",
       "Advice on texture: least points from frame to frame"},
      {"most_moving",
       &o.most_moving,
       {0, 1},
       "",
       "Advice on hands in view: greatest share of points that move by themselves"},
      {"most_covered",
       &o.most_covered,
       {0, 1},
       "",
       "The same: greatest area that is covered in one frame alone, share of the picture"},
      {"least_brightness", &o.least_brightness, {0, 1}, "", "Advice on light: least mean grey level"},
      {"least_known_depth",
       &o.least_known_depth,
       {0, 1},
       "",
       "Advice on surfaces: least share of known depth"},
      {"least_contrast",
       &o.least_contrast,
       {0, 255},
       "levels",
       "Least contrast of pictures that show something"},
      {"side_angle_deg", &o.side_angle_deg, {0, 90}, "degrees", "Least angle at which a side counts as seen"},
      {"cut_share", &o.cut_share, {0, 1}, "", "Share of the points that stay, below which a video was cut"}};
}

std::vector<int> shared_points(std::span<const vision::PointTrack> tracks, int frame_count) {
  std::vector<int> out(static_cast<std::size_t>(std::max(0, frame_count - 1)), 0);
  for (const vision::PointTrack& track : tracks)
    for (int i = track.first_frame; i + 1 < std::min(track.end_frame(), frame_count); ++i)
      if (track.in_frame(i) && track.in_frame(i + 1)) ++out[static_cast<std::size_t>(i)];
  return out;
}

std::vector<int> cuts_in(std::span<const vision::PointTrack> tracks,
                         std::span<const std::optional<vision::CameraPose>> poses,
                         const VideoAdviceOptions& options) {
  const std::vector<int> shared = shared_points(tracks, static_cast<int>(poses.size()));
  const auto any_of = [](std::span<const std::optional<vision::CameraPose>> part) {
    return std::any_of(part.begin(), part.end(), [](const auto& pose) { return pose.has_value(); });
  };
  std::vector<int> out;
  for (std::size_t i = 1; i + 1 < shared.size(); ++i)
    if (shared[i] < options.cut_share * std::min(shared[i - 1], shared[i + 1]) &&
        !(any_of(poses.first(i + 1)) && any_of(poses.subspan(i + 1))))
      out.push_back(static_cast<int>(i) + 1);
  return out;
}

void add_seen_sides(std::span<const Vec3> positions, Vec3 centre, const VideoAdviceOptions& options,
                    VideoFigures& figures) {
  const double least = std::sin(options.side_angle_deg * std::numbers::pi / 180);
  for (const Vec3& position : positions) {
    const Vec3 to = unit(position - centre);
    figures.left_seen |= -to.x >= least;
    figures.right_seen |= to.x >= least;
    figures.front_seen |= -to.y >= least;
    figures.back_seen |= to.y >= least;
  }
}

std::vector<Note> advice_on(const VideoFigures& f, const VideoAdviceOptions& options) {
  std::vector<Note> out;
  if (f.frames < options.least_frames)
    out.emplace_back(fmt::format(
        "There are only {} pictures: film for at least five seconds, or take more pictures.", f.frames));
  if (!f.cuts.empty())
    out.emplace_back(fmt::format(
        "The video was cut before frame {}: only one part of it could be used. Film the model in one go.",
        f.cuts.front()));
  if (const int blurred = f.blurred + f.soft; blurred > options.most_blurred * f.frames)
    out.emplace_back(
        fmt::format("{} of {} pictures are blurred: film more slowly, or in more light.", blurred, f.frames));
  else if (f.edge_width_px > options.most_edge_width_px)
    out.emplace_back(
        "All pictures are blurred: film more slowly and in more light, and let the camera focus on the "
        "model.");
  if (f.posed < options.least_posed * f.tried)
    out.emplace_back(
        fmt::format("The camera's position is known in only {} of {} pictures: film more slowly, with "
                    "the whole model in view.",
                    f.posed, f.tried));
  if (f.followed_points < options.least_points)
    out.emplace_back(
        "Few details could be followed from picture to picture: put the model on a printed cloth or a "
        "newspaper, and film it in even light.");
  if (f.moving_points > options.most_moving || f.covered > options.most_covered)
    out.emplace_back(
        "Something moved while you filmed, such as a hand: keep hands and people out of view, and do not "
        "touch "
        "the model.");
  if (f.brightness < options.least_brightness) out.emplace_back("The pictures are dark: film in more light.");
  if (f.known_depth < options.least_known_depth)
    out.emplace_back(
        fmt::format("Only {:.0f} % of the pictures could be measured: plain, shiny and transparent "
                    "surfaces need some texture, such as small stickers.",
                    100 * f.known_depth));
  std::vector<std::string> unseen;
  const std::array<std::pair<bool, const char*>, 4> sides{std::pair(f.left_seen, "the left side"),
                                                          {f.right_seen, "the right side"},
                                                          {f.front_seen, "the front"},
                                                          {f.back_seen, "the back"}};
  for (const auto& [seen, name] : sides)
    if (!seen) unseen.emplace_back(name);
  if (!unseen.empty()) {
    std::string names = joined(unseen);
    names.front() = 'T';
    out.emplace_back(
        fmt::format("{} {} never seen, so the shape there is a guess: walk around the model while you film.",
                    names, unseen.size() == 1 ? "was" : "were"));
  }
  return out;
}

}  // namespace palpable::recipes
