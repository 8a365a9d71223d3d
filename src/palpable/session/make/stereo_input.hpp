// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/note.hpp"
#include "palpable/core/result.hpp"
#include "palpable/core/work.hpp"
#include "palpable/sources/stereo/stereo_file.hpp"
#include "palpable/vision/stereo/problem/stereo.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace palpable::session {

/// What is done to a pair before it is matched.
enum class Rectification {
  /// What the calibration says; without one, what the pictures' features say, if they are not rectified yet.
  automatic,
  /// Nothing: the pictures are taken as they come.
  never
};

/// A pair's files and what is known of its cameras.
struct StereoInput {
  /// Two pictures, left first, or one that holds both.
  std::vector<std::filesystem::path> pictures;
  /// OpenCV yml/xml, Middlebury calib.txt or JSON; empty = none.
  std::filesystem::path calibration;
  sources::StereoLayout layout = sources::StereoLayout::automatic;
  Rectification rectification = Rectification::automatic;
  /// One camera that was moved sideways between the pictures, by so many metres.
  std::optional<double> moved_m;
};

/// How a pair came to lie on common scanlines.
enum class RectifiedBy { nothing, calibration, features, movement };
std::string_view name_of(RectifiedBy way);

/// A pair that is ready to be matched.
struct ReadyPair {
  vision::StereoPair pair;
  RectifiedBy rectified_by = RectifiedBy::nothing;
  /// RMS of y_left - y_right of matched features in pixels, before and after; NaN where it was not measured
  /// (the calibration states a rectified pair, Rectification::never) or there are no features.
  double residual_before_px = 0.0;
  double residual_px = 0.0;
  int features = 0;
  /// What the person should know.
  std::vector<Note> notes;
};

/// Reads a pair and rectifies it: a pair of calibrated cameras is undistorted and rectified, one of unknown
/// cameras turned as its features demand, one that is rectified (or that the calibration states to be
/// rectified) left alone. Errors: invalid_input naming the file, usage for options that do not fit,
/// interrupted.
Result<ReadyPair> read_stereo_pair(const StereoInput& input, const Work& work);

}  // namespace palpable::session
