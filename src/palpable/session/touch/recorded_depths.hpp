// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/picture/image.hpp"
#include "palpable/core/result.hpp"
#include "palpable/session/touch/frame_recorder.hpp"
#include "palpable/session/touch/live_source.hpp"

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

namespace palpable::session {

/// Writes the frames of a depth camera as files of frames:FOLDER: NUMBER.depth.png, NUMBER.color.png where
/// there is a picture, NUMBER.pose.txt where the camera's pose is stated, and depth.json, which states the
/// unit and the camera of the first frame that states one. The unit is 1 mm if the first frame's depths are
/// whole millimetres, or if it reaches beyond 6.5 m; else 0.1 mm. What is farther than 65 535 units is
/// written as unknown.
class DepthRecorder {
 public:
  /// Errors: as FrameRecorder::open().
  static Result<std::unique_ptr<DepthRecorder>> open(const std::filesystem::path& folder);

  /// `frame`, with the newest colour picture.
  void keep(const LiveFrame& frame, const std::optional<Image>& colour);
  /// FrameRecorder::notice().
  std::optional<std::string> notice() { return recorder_->notice(); }

 private:
  DepthRecorder(std::filesystem::path folder, std::unique_ptr<FrameRecorder> recorder)
      : folder_(std::move(folder)), recorder_(std::move(recorder)) {}

  std::filesystem::path folder_;
  std::unique_ptr<FrameRecorder> recorder_;
  /// Of the first frame; 0 before it.
  double metres_per_unit_ = 0.0;
  bool has_written_ = false, has_stated_camera_ = false;
};

}  // namespace palpable::session
