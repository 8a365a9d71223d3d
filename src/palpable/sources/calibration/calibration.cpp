// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sources/calibration/calibration.hpp"

#include "palpable/core/files/byte_reader.hpp"
#include "palpable/core/files/read_file.hpp"
#include "palpable/core/picture/image.hpp"
#include "palpable/sources/calibration/calibration_formats.hpp"
#include "palpable/sources/calibration/calibration_reply.hpp"
#include "palpable/sources/calibration/json_camera.hpp"

#include <algorithm>
#include <cmath>
#include <string_view>

#include <fmt/format.h>

namespace palpable::sources {
namespace {

constexpr std::uintmax_t kMaxCalibrationBytes = std::uintmax_t{4} << 20U;

bool all_finite(std::span<const double> values) {
  return std::all_of(values.begin(), values.end(), [](double v) { return std::isfinite(v); });
}

bool is_rotation(const std::array<double, 9>& r) {
  if (!all_finite(r)) return false;
  constexpr double kTolerance = 1e-3;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) {
      double product = 0.0;
      for (std::size_t k = 0; k < 3; ++k) product += r[3 * i + k] * r[3 * j + k];
      if (std::abs(product - (i == j ? 1.0 : 0.0)) > kTolerance) return false;
    }
  return true;
}

Result<void> check_camera(const CameraModel& camera, const char* which) {
  const auto& m = camera.matrix;
  if (!all_finite(m))
    return invalid_input(std::string("states numbers that are not finite for the ") + which + " camera");
  if (auto lens = check_lens(m[0], m[4], m[2], m[5]); !lens) return lens;
  constexpr std::array<std::size_t, 6> kCounts{0, 4, 5, 8, 12, 14};
  if (!all_finite(camera.distortion) ||
      std::find(kCounts.begin(), kCounts.end(), camera.distortion.size()) == kCounts.end())
    return invalid_input(std::string("states a distortion of the ") + which +
                         " camera that is not 4, 5, 8, 12 or 14 numbers");
  if (camera.width != 0 || camera.height != 0) return check_picture_size(camera.width, camera.height);
  return {};
}

Result<void> check(const Calibration& c) {
  if (auto left = check_camera(c.left, "left"); !left) return left;
  if (c.right)
    if (auto right = check_camera(*c.right, "right"); !right) return right;
  if (c.rotation && !is_rotation(*c.rotation))
    return invalid_input("states a matrix R that is not a rotation");
  if (c.translation_m && (!is_finite(*c.translation_m) || norm(*c.translation_m) == 0.0))
    return invalid_input("states two cameras at the same place");
  if (c.rig && !(c.rig->baseline_m > 0.0))
    return invalid_input("states a baseline that is not a positive length");
  // Beyond these ranges no depth can be computed from a disparity.
  constexpr double kLeastBaseline_m = 1e-6, kMostBaseline_m = 1e6, kMostOffset_px = 1e6;
  if (c.rig && !(c.rig->baseline_m >= kLeastBaseline_m && c.rig->baseline_m <= kMostBaseline_m))
    return invalid_input(fmt::format("states a baseline of {:g} m; it must be {:g} to {:.0f} m",
                                     c.rig->baseline_m, kLeastBaseline_m, kMostBaseline_m));
  if (c.rig && !(std::abs(c.rig->doffs_px) <= kMostOffset_px))
    return invalid_input("states an offset of the disparity that is not a number of pixels");
  return {};
}

/// Pixel centres are at integers, so the picture's corner is at -0.5.
double scaled_place(double place, double scale) { return (place + 0.5) * scale - 0.5; }

void scale_camera(CameraModel& camera, double sx, double sy) {
  auto& m = camera.matrix;
  m[0] *= sx;
  m[1] *= sx;
  m[2] = scaled_place(m[2], sx);
  m[4] *= sy;
  m[5] = scaled_place(m[5], sy);
}

}  // namespace

Result<Calibration> decode_calibration(std::span<const std::byte> file) {
  std::string_view text = as_text(file);
  text.remove_prefix(std::min(text.find_first_not_of(" \t\r\n"), text.size()));
  if (text.empty()) return invalid_input("is empty");
  auto calibration =
      text.starts_with('{')                                    ? calibration_from_json(text)
      : text.starts_with("%YAML") || text.starts_with("<?xml") ? isolated::calibration_from_opencv(text)
      : text.find("cam0=") != std::string_view::npos
          ? calibration_from_middlebury(text)
          : invalid_input("is not a calibration (OpenCV yml or xml, Middlebury calib.txt, or JSON)");
  if (!calibration) return calibration;
  if (auto valid = check(*calibration); !valid) return std::move(valid).error();
  constexpr double kOddBaseline_m = 5.0;
  if (calibration->translation_m && norm(*calibration->translation_m) > kOddBaseline_m)
    calibration->notes.push_back("The calibration puts the two cameras " +
                                 std::to_string(std::lround(norm(*calibration->translation_m))) +
                                 " m apart; if it is in millimetres, add metres_per_unit: 0.001 to it.");
  return calibration;
}

Result<Calibration> read_calibration(const std::filesystem::path& path) {
  const auto file = read_file(path, kMaxCalibrationBytes);
  if (!file) return file.error();
  auto calibration = decode_calibration(*file);
  if (!calibration) calibration.error().place = path.string();
  return calibration;
}

Result<Calibration> calibration_for(Calibration calibration, int width, int height) {
  CameraModel& left = calibration.left;
  const bool stated = left.width > 0;
  if (stated && (left.width != width || left.height != height)) {
    const double sx = static_cast<double>(width) / left.width;
    const double sy = static_cast<double>(height) / left.height;
    constexpr double kSameShape = 0.01;
    if (std::abs(sx / sy - 1.0) > kSameShape)
      return invalid_input("is for pictures of " + size_text(left.width, left.height) +
                           " pixels, but these have " + size_text(width, height));
    calibration.notes.push_back("The calibration is for " + size_text(left.width, left.height) +
                                " pixels; it was scaled to " + size_text(width, height) + ".");
    scale_camera(left, sx, sy);
    if (calibration.right) scale_camera(*calibration.right, sx, sy);
    if (calibration.rig) calibration.rig->doffs_px *= sx;
  }
  for (CameraModel* camera : {&left, calibration.right ? &*calibration.right : nullptr}) {
    if (camera == nullptr) continue;
    camera->width = width;
    camera->height = height;
    const auto& m = camera->matrix;
    if (m[2] < -0.5 || m[2] > width - 0.5 || m[5] < -0.5 || m[5] > height - 0.5)
      return invalid_input("has its optical axis outside the pictures of " + size_text(width, height) +
                           " pixels: it is for other pictures");
  }
  if (calibration.rig) calibration.rig->left = pinhole_of(left);
  return calibration;
}

}  // namespace palpable::sources
