// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/session/make/read_film.hpp"

#include "palpable/sources/calibration/calibration.hpp"
#include "palpable/sources/video/read_video.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

namespace palpable::session {
namespace {

// The camera of reduced pictures; pixel centres are at integers.
Pinhole reduced_to(const Pinhole& camera, int width, int height) {
  const double sx = static_cast<double>(width) / camera.width,
               sy = static_cast<double>(height) / camera.height;
  return {camera.fx * sx, camera.fy * sy, (camera.cx + 0.5) * sx - 0.5, (camera.cy + 0.5) * sy - 0.5,
          width,          height};
}

// A field of view of 62 degrees across the longer side, as most phones have it.
vision::VideoCamera usual_camera(int width, int height) {
  constexpr double kOfLongerSide = 0.83;
  const double focal_length = kOfLongerSide * std::max(width, height);
  return {{focal_length, focal_length, (width - 1) / 2.0, (height - 1) / 2.0, width, height}, false};
}

Result<vision::VideoCamera> camera_of(const sources::Video& video, const std::filesystem::path& calibration) {
  const int width = video.frames.front().picture.width(), height = video.frames.front().picture.height();
  if (calibration.empty()) return usual_camera(width, height);
  const auto read = sources::read_calibration(calibration);
  if (!read) return read.error();
  const Pinhole camera = sources::pinhole_of(read->left);
  constexpr double kSameShape = 0.01;
  const double shape = static_cast<double>(camera.width) * video.full_height /
                       (static_cast<double>(camera.height) * video.full_width);
  if (!(std::abs(shape - 1.0) < kSameShape))
    return invalid_input(
        fmt::format("is for pictures of {}, the frames are {}", size_text(camera.width, camera.height),
                    size_text(video.full_width, video.full_height)),
        calibration.string());
  return vision::VideoCamera{reduced_to(camera, width, height), true};
}

}  // namespace

Result<ReadInput> read_film(const sources::Input& input, const InputOptions& options, const Work& work) {
  auto video = sources::read_video(input.files, work);
  if (!video) return video.error();
  const auto camera = camera_of(*video, options.calibration);
  if (!camera) return camera.error();
  ReadInput out{Film{{}, *camera}, input.notes};
  if (!camera->focal_length_known)
    out.notes.emplace_back("The camera's focal length is not given: it was estimated from the video.",
                           Reason::needs_calibration);
  auto& frames = std::get<Film>(out.values).frames;
  for (sources::VideoFrame& frame : video->frames) frames.push_back({frame.number, std::move(frame.picture)});
  return out;
}

}  // namespace palpable::session
