// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sources/calibration/calibration_formats.hpp"

#include "palpable/sources/calibration/json_camera.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <map>

#include <nlohmann/json.hpp>
#include <opencv2/core/persistence.hpp>

namespace palpable::sources {
namespace {

// Larger sides are invalid; this limit keeps the conversion to int defined. check_picture_size() checks the
// exact limit.
constexpr double kMaxSide = 1e9;

int side_of(double value) {
  const bool is_whole = std::isfinite(value) && value == std::floor(value);
  return is_whole && std::abs(value) < kMaxSide ? static_cast<int>(value) : -1;
}

/// The numbers of "[f 0 cx; 0 f cy; 0 0 1]" or a single number.
std::vector<double> numbers_in(std::string_view text) {
  std::vector<double> numbers;
  const auto is_gap = [](char c) {
    return c == ' ' || c == '[' || c == ']' || c == ';' || c == ',' || c == '\t';
  };
  while (true) {
    while (!text.empty() && is_gap(text.front())) text.remove_prefix(1);
    double value = 0.0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc()) return numbers;
    numbers.push_back(value);
    text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  }
}

std::map<std::string, std::vector<double>, std::less<>> assignments_in(std::string_view text) {
  std::map<std::string, std::vector<double>, std::less<>> found;
  while (!text.empty()) {
    const std::string_view line = text.substr(0, text.find('\n'));
    text.remove_prefix(std::min(line.size() + 1, text.size()));
    if (const std::size_t equals = line.find('='); equals != std::string_view::npos)
      found.emplace(std::string(line.substr(0, equals)), numbers_in(line.substr(equals + 1)));
  }
  return found;
}

void set_rectified(Calibration& c, double baseline_m, double doffs_px) {
  c.rotation = std::array<double, 9>{1, 0, 0, 0, 1, 0, 0, 0, 1};
  c.translation_m = Vec3{-baseline_m, 0.0, 0.0};
  c.rig = StereoRig{pinhole_of(c.left), baseline_m, doffs_px};
}

using Names = std::initializer_list<const char*>;

cv::FileNode first_of(const cv::FileStorage& file, Names names) {
  for (const char* name : names)
    if (cv::FileNode node = file[name]; !node.empty()) return node;
  return {};
}

/// The numbers of a one-channel matrix or a plain list, row by row; empty for anything else. A matrix is read
/// as a list, since OpenCV would first allocate memory for whatever size the file states.
std::vector<double> numbers_of(const cv::FileNode& node) {
  std::vector<double> numbers;
  if (node.empty()) return numbers;
  const cv::FileNode list = node.isMap() ? node["data"] : node;
  if (list.isSeq() || list.isReal() || list.isInt())
    for (const cv::FileNode& n : list)
      if (n.isReal() || n.isInt()) numbers.push_back(n.real());
  if (node.isMap()) {
    const cv::FileNode rows = node["rows"];
    const cv::FileNode columns = node["cols"];
    if (!rows.isInt() || !columns.isInt() ||
        rows.real() * columns.real() != static_cast<double>(numbers.size()))
      numbers.clear();
  }
  return numbers;
}

Result<CameraModel> camera_in(const cv::FileStorage& file, Names matrix, Names distortion) {
  CameraModel camera;
  const auto values = numbers_of(first_of(file, matrix));
  if (values.size() != camera.matrix.size())
    return invalid_input(std::string("has no 3 x 3 camera matrix ") + *matrix.begin());
  std::copy(values.begin(), values.end(), camera.matrix.begin());
  camera.distortion = numbers_of(first_of(file, distortion));
  const auto size = numbers_of(first_of(file, {"imageSize", "image_size", "size"}));
  const auto width = numbers_of(first_of(file, {"image_width", "width", "image_Width"}));
  const auto height = numbers_of(first_of(file, {"image_height", "height", "image_Height"}));
  if (size.size() == 2) {
    camera.width = side_of(size[0]);
    camera.height = side_of(size[1]);
  } else if (width.size() == 1 && height.size() == 1) {
    camera.width = side_of(width[0]);
    camera.height = side_of(height[0]);
  }
  return camera;
}

Result<Calibration> opencv_content(const cv::FileStorage& file) {
  Calibration out;
  const Names left_matrix{"M1", "K1", "cameraMatrix1", "camera_matrix_1"};
  const Names right_matrix{"M2", "K2", "cameraMatrix2", "camera_matrix_2"};
  if (first_of(file, left_matrix).empty()) {
    auto single = camera_in(file, {"camera_matrix", "cameraMatrix", "K"},
                            {"distortion_coefficients", "distCoeffs", "D"});
    if (!single) return std::move(single).error();
    out.left = *std::move(single);
    return out;
  }
  auto left = camera_in(file, left_matrix, {"D1", "distCoeffs1", "dist_coeffs_1"});
  if (!left) return std::move(left).error();
  auto right = camera_in(file, right_matrix, {"D2", "distCoeffs2", "dist_coeffs_2"});
  if (!right) return std::move(right).error();
  out.left = *std::move(left);
  out.right = *std::move(right);

  const auto rotation = numbers_of(first_of(file, {"R", "rotation"}));
  const auto translation = numbers_of(first_of(file, {"T", "translation"}));
  if (rotation.size() == 9 && translation.size() == 3) {
    const auto unit = numbers_of(first_of(file, {"metres_per_unit"}));
    const double metres = unit.size() == 1 ? unit[0] : 1.0;
    out.rotation.emplace();
    std::copy(rotation.begin(), rotation.end(), out.rotation->begin());
    out.translation_m = metres * Vec3{translation[0], translation[1], translation[2]};
  } else {
    out.notes.emplace_back("The calibration describes each camera but not their relative pose (R and T).");
  }
  return out;
}

}  // namespace

Result<Calibration> calibration_from_middlebury(std::string_view text) {
  const auto found = assignments_in(text);
  const auto numbers = [&found](std::string_view key) {
    const auto at = found.find(key);
    return at == found.end() ? std::vector<double>() : at->second;
  };
  const auto single = [&numbers](std::string_view key) {
    const auto values = numbers(key);
    return values.size() == 1 ? values[0] : std::numeric_limits<double>::quiet_NaN();
  };
  Calibration c;
  c.right.emplace();
  for (const auto& [key, camera] : {std::pair{"cam0", &c.left}, std::pair{"cam1", &*c.right}}) {
    const auto values = numbers(key);
    if (values.size() != 9) return invalid_input(std::string("has no 3 x 3 camera matrix ") + key);
    std::copy(values.begin(), values.end(), camera->matrix.begin());
    camera->width = side_of(single("width"));
    camera->height = side_of(single("height"));
  }
  const double doffs = numbers("doffs").empty() ? c.right->matrix[2] - c.left.matrix[2] : single("doffs");
  constexpr double kMetresPerMillimetre = 1e-3;
  set_rectified(c, kMetresPerMillimetre * single("baseline"), doffs);
  return c;
}

Result<Calibration> calibration_from_json(std::string_view text) {
  const auto json = nlohmann::json::parse(text, nullptr, false);
  if (!json.is_object()) return invalid_input("is not valid JSON");
  const auto camera = pinhole_from(json);
  if (!camera) return camera.error();
  Calibration c;
  c.left.matrix = {camera->fx, 0, camera->cx, 0, camera->fy, camera->cy, 0, 0, 1};
  c.left.width = camera->width;
  c.left.height = camera->height;
  if (!json.contains("baseline_m")) return c;
  const double doffs = number_in(json, "doffs").value_or(0.0);
  c.right = c.left;
  c.right->matrix[2] += doffs;
  set_rectified(c, number_in(json, "baseline_m").value_or(0.0), doffs);
  return c;
}

Result<Calibration> calibration_from_opencv(std::string_view text) {
  try {
    const cv::FileStorage file(std::string(text), cv::FileStorage::READ | cv::FileStorage::MEMORY);
    if (!file.isOpened()) return invalid_input("is not a file that OpenCV wrote");
    return opencv_content(file);
  } catch (const std::exception&) {  // cv::Exception carries OpenCV's own file and line, which tell a person
                                     // nothing
    return invalid_input("is a damaged OpenCV file");
  }
}

}  // namespace palpable::sources
