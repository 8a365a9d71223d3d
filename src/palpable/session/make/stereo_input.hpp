// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/note.hpp"
#include "palpable/core/result.hpp"
#include "palpable/core/work.hpp"
#include "palpable/sources/stereo/stereo_file.hpp"
#include "palpable/vision/stereo/problem/stereo.hpp"

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace palpable::session {

/// How a pair is rectified before matching.
enum class Rectification {
  /// By the calibration; without one, by matched features, if the pictures are not rectified yet.
  automatic,
  /// Not at all: the pictures are used as they are.
  never
};

/// Pixels of a picture above which a pair is reduced, unless chosen otherwise.
inline constexpr std::size_t kMostPairPixels = 2'000'000;

/// The files of a pair and what is known about its cameras.
struct StereoInput {
  /// Two pictures, left first, or one that holds both.
  std::vector<std::filesystem::path> pictures;
  /// OpenCV yml/xml, Middlebury calib.txt or JSON; empty = none.
  std::filesystem::path calibration;
  sources::StereoLayout layout = sources::StereoLayout::automatic;
  Rectification rectification = Rectification::automatic;
  /// The distance in metres by which a single camera was moved sideways between the pictures.
  std::optional<double> moved_m;
  /// Pictures with more pixels than this are reduced to it, and their calibration with them, with a note: a
  /// finger feels no difference, and matching takes memory and time with the 1.5th power of the pixels. > 0.
  std::size_t most_pixels = kMostPairPixels;
};

/// How a pair was rectified.
enum class RectifiedBy { nothing, calibration, features, movement };
std::string_view name_of(RectifiedBy rectified_by);

/// A rectified pair, ready for matching.
struct ReadyPair {
  vision::StereoPair pair;
  RectifiedBy rectified_by = RectifiedBy::nothing;
  /// Vertical residual: RMS of y_left - y_right of matched features, px, before and after rectification; NaN
  /// if it was not measured (the calibration states a rectified pair, or Rectification::never) or there are
  /// no features.
  double residual_before_px = 0.0;
  double residual_px = 0.0;
  int features = 0;
  /// Information for the user.
  std::vector<Note> notes;
};

/// Reads a pair and rectifies it. A pair of calibrated cameras is undistorted and rectified; a pair of
/// unknown cameras is rectified by its features; a pair that is rectified already (or that the calibration
/// states to be) is not changed. Errors: invalid_input naming the file, usage for options that do not fit,
/// interrupted.
Result<ReadyPair> read_stereo_pair(const StereoInput& input, const Work& work);

}  // namespace palpable::session
