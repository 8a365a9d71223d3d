// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/session/make/read_video_input.hpp"

#include "palpable/session/make/places.hpp"
#include "palpable/sources/calibration/calibration.hpp"
#include "palpable/sources/video/read_video.hpp"
#include "palpable/vision/rectification/undistortion.hpp"

#include <algorithm>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

namespace palpable::session {
namespace {

// The focal length is refined from the video. It begins with the one that the pictures state, or a field of
// view of 62 degrees across the longer side, as most phones have it.
vision::VideoCamera unknown_camera(const sources::Video& video, std::vector<Note>& notes) {
  constexpr double kUsual = 0.83, kFrameWidth_mm = 36.0;
  const int width = video.frames.front().picture.width(), height = video.frames.front().picture.height();
  const bool stated = video.focal_length_35mm.has_value();
  const double of_longer_side = stated ? *video.focal_length_35mm / kFrameWidth_mm : kUsual;
  notes.emplace_back(stated ? "The camera's focal length was taken from the pictures and refined."
                            : "The camera's focal length is not given: it was estimated from the video.",
                     Reason::needs_calibration);
  const double focal_length = of_longer_side * std::max(width, height);
  return {{focal_length, focal_length, (width - 1) / 2.0, (height - 1) / 2.0, width, height}, false};
}

// Removes the distortion that the calibration states.
Result<void> straighten(sources::Video& video, const sources::CameraModel& camera, const Work& work) {
  const auto& bend = camera.distortion;
  if (std::all_of(bend.begin(), bend.end(), [](double k) { return k == 0.0; })) return {};
  std::vector<Raster<Rgb8>*> pictures;
  for (VideoFrame& frame : video.frames) pictures.push_back(&frame.picture);
  return vision::undistort(pictures, {camera.matrix, bend}, work);
}

Result<vision::VideoCamera> camera_of(sources::Video& video, const std::filesystem::path& calibration,
                                      std::vector<Note>& notes, const Work& work) {
  if (calibration.empty()) return unknown_camera(video, notes);
  const auto read = sources::read_calibration(calibration);
  if (!read) return read.error();
  // The frames may be smaller than those in the file.
  const auto& first = video.frames.front().picture;
  const auto fitting = sources::calibration_for(*read, first.width(), first.height());
  if (!fitting) return at_place(fitting.error(), calibration.string());
  if (auto straight = straighten(video, fitting->left, work); !straight) return straight.error();
  return vision::VideoCamera{sources::pinhole_of(fitting->left), true};
}

Note note_on_lost(const sources::Video& video) {
  const std::string_view pictures = video.lost == 1 ? "picture" : "pictures";
  if (video.first_lost)
    return Note(fmt::format("{} {} of the folder could not be read, and {} were used. {}.", video.lost,
                            pictures, video.frames.size(), video.first_lost->sentence()));
  return Note(fmt::format("The file is damaged: {} of its pictures could not be read, and {} were used.",
                          video.lost, video.frames.size()));
}

}  // namespace

Result<ReadInput> read_video_input(const sources::Input& input, const InputOptions& options,
                                   const Work& work) {
  auto video = sources::read_video(input.files, work);
  if (!video) return video.error();
  // Points are followed in windows of this size.
  constexpr int kLeastSide = 32;
  const auto& first = video->frames.front().picture;
  if (std::min(first.width(), first.height()) < kLeastSide)
    return invalid_input(
        fmt::format("has pictures of {}; a model is found in pictures of at least {}",
                    size_text(first.width(), first.height()), size_text(kLeastSide, kLeastSide)),
        input.files.front().string());
  std::vector<Note> notes = input.notes;
  if (video->lost > 0) notes.push_back(note_on_lost(*video));
  const auto camera = camera_of(*video, options.calibration, notes, work);
  if (!camera) return camera.error();
  const double reduction = static_cast<double>(video->frames.front().picture.width()) / video->full_width;
  return ReadInput{VideoInput{std::move(video->frames), *camera, reduction}, std::move(notes)};
}

}  // namespace palpable::session
