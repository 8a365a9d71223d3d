// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/picture/camera.hpp"
#include "palpable/core/result.hpp"
#include "palpable/core/vec3.hpp"

#include <array>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace palpable::sources {

/// A camera with lens distortion.
struct CameraModel {
  /// Row-major 3 x 3, pixels, pixel centres at integers: fx 0 cx, 0 fy cy, 0 0 1.
  std::array<double, 9> matrix{1, 0, 0, 0, 1, 0, 0, 0, 1};
  /// OpenCV's order k1 k2 p1 p2 k3 k4 k5 k6 …: 0, 4, 5, 8, 12 or 14 numbers.
  std::vector<double> distortion;
  /// Size of the pictures; 0 if the file does not state it.
  int width = 0;
  int height = 0;
};

/// The content of a calibration file.
struct Calibration {
  CameraModel left;
  /// Present for a pair of cameras.
  std::optional<CameraModel> right;
  /// p_right = rotation * p_left + translation_m, row-major, metres; present if the file states it.
  std::optional<std::array<double, 9>> rotation;
  std::optional<Vec3> translation_m;
  /// The rig for depth_from_disparity(), if the file states a rectified pair (Middlebury, JSON with a
  /// baseline). Empty: the pair must be rectified first.
  std::optional<StereoRig> rig;
  /// Information for the user, one sentence each.
  std::vector<std::string> notes;
};

/// Reads a calibration, recognised by content: OpenCV's yml or xml (M1, D1, M2, D2, R, T, also K1…, or
/// camera_matrix and distortion_coefficients for one camera; image_width, image_height or imageSize; T in
/// metres, or in units of `metres_per_unit`), Middlebury's calib.txt (baseline in mm), or JSON with fx, fy,
/// cx, cy, width, height and optionally baseline_m, doffs. Errors: invalid_input, with the file's name, for
/// what is none of these or states impossible values.
Result<Calibration> read_calibration(const std::filesystem::path& path);
/// The same from memory; errors without a place.
Result<Calibration> decode_calibration(std::span<const std::byte> file);

/// The calibration as OpenCV's yml, as read_calibration() takes it: M1, D1, M2, D2, R, T for two cameras,
/// else camera_matrix and distortion_coefficients. `reprojection_px` is noted in it.
std::string encode_calibration(const Calibration& calibration, double reprojection_px);

/// Adapts a calibration to pictures of this size. Another size with the same aspect ratio: scaled, with a
/// note. Errors: invalid_input for another aspect ratio, or a principal point outside the pictures.
Result<Calibration> calibration_for(Calibration calibration, int width, int height);

/// The left camera without its distortion; its size must be known (calibration_for sets it).
inline Pinhole pinhole_of(const CameraModel& camera) {
  return {camera.matrix[0], camera.matrix[4], camera.matrix[2],
          camera.matrix[5], camera.width,     camera.height};
}

}  // namespace palpable::sources
