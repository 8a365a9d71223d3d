// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sources/calibration/calibration.hpp"

#include <span>

#include <fmt/format.h>

namespace palpable::sources {
namespace {

/// A matrix for OpenCV's FileStorage; the shortest digits that convert back to the same value.
std::string matrix_text(const char* name, int rows, std::span<const double> values) {
  // In YAML "1." is a real number, while "1" would be an integer.
  std::string data;
  for (const double v : values) {
    std::string number = fmt::format("{}", v);
    if (number.find_first_of(".e") == std::string::npos) number += ".";
    data += (data.empty() ? "" : ", ") + number;
  }
  return fmt::format("{}: !!opencv-matrix\n   rows: {}\n   cols: {}\n   dt: d\n   data: [ {} ]\n", name, rows,
                     values.size() / static_cast<std::size_t>(rows), data);
}

std::string lens_text(const char* matrix, const char* distortion, const CameraModel& camera) {
  std::string text = matrix_text(matrix, 3, camera.matrix);
  if (!camera.distortion.empty()) text += matrix_text(distortion, 1, camera.distortion);
  return text;
}

}  // namespace

std::string encode_calibration(const Calibration& c, double reprojection_px) {
  std::string text =
      fmt::format("%YAML:1.0\n---\nimage_width: {}\nimage_height: {}\nreprojection_error_px: {}\n",
                  c.left.width, c.left.height, reprojection_px);
  if (!c.right) return text + lens_text("camera_matrix", "distortion_coefficients", c.left);
  text += lens_text("M1", "D1", c.left) + lens_text("M2", "D2", *c.right);
  if (c.rotation) text += matrix_text("R", 3, *c.rotation);
  if (c.translation_m) {
    const double t[] = {c.translation_m->x, c.translation_m->y, c.translation_m->z};
    text += matrix_text("T", 3, t) + "metres_per_unit: 1.\n";
  }
  return text;
}

}  // namespace palpable::sources
