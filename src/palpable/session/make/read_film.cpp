// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/session/make/read_film.hpp"

#include "palpable/session/make/places.hpp"
#include "palpable/sources/calibration/calibration.hpp"
#include "palpable/sources/video/read_video.hpp"

#include <algorithm>
#include <utility>
#include <vector>

namespace palpable::session {
namespace {

// A field of view of 62 degrees along the longer side, as in most phones.
vision::VideoCamera usual_camera(int width, int height) {
  constexpr double kOfLongerSide = 0.83;
  const double focal_length = kOfLongerSide * std::max(width, height);
  return {{focal_length, focal_length, (width - 1) / 2.0, (height - 1) / 2.0, width, height}, false};
}

Result<vision::VideoCamera> camera_of(const sources::Video& video, const std::filesystem::path& calibration,
                                      std::vector<Note>& notes) {
  const int width = video.frames.front().picture.width(), height = video.frames.front().picture.height();
  if (calibration.empty()) {
    notes.emplace_back("The camera's focal length is not given: it was estimated from the video.",
                       Reason::needs_calibration);
    return usual_camera(width, height);
  }
  const auto read = sources::read_calibration(calibration);
  if (!read) return read.error();
  // The frames may have been reduced.
  const auto fitting = sources::calibration_for(*read, width, height);
  if (!fitting) return at_place(fitting.error(), calibration.string());
  const auto& bend = fitting->left.distortion;
  if (std::any_of(bend.begin(), bend.end(), [](double k) { return k != 0.0; }))
    notes.emplace_back(
        "The lens's distortion, which the calibration states, is not corrected in videos yet.");
  return vision::VideoCamera{sources::pinhole_of(fitting->left), true};
}

}  // namespace

Result<ReadInput> read_film(const sources::Input& input, const InputOptions& options, const Work& work) {
  auto video = sources::read_video(input.files, work);
  if (!video) return video.error();
  std::vector<Note> notes = input.notes;
  const auto camera = camera_of(*video, options.calibration, notes);
  if (!camera) return camera.error();
  return ReadInput{Film{std::move(video->frames), *camera}, std::move(notes)};
}

}  // namespace palpable::session
