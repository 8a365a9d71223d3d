// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/rectification/chessboard_calibration.hpp"

#include "palpable/vision/image/opencv_image.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include <fmt/format.h>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>

namespace palpable::vision {
namespace {

using Corners = std::vector<cv::Point2f>;

/// The board's inner corners with sub-pixel accuracy; empty unless the whole board is visible.
Corners find_corners(const Image& image, const ChessboardOptions& options) {
  const cv::Mat grey = grey8_of(image);
  Corners corners;
  if (!cv::findChessboardCorners(grey, {options.columns, options.rows}, corners)) return {};
  cv::cornerSubPix(grey, corners, {options.corner_window_px, options.corner_window_px}, {-1, -1},
                   {cv::TermCriteria::EPS | cv::TermCriteria::COUNT, 40, 0.001});
  return corners;
}

LensCamera lens_of(const cv::Mat& matrix, const cv::Mat& distortion) {
  LensCamera out;
  std::copy_n(matrix.ptr<double>(), 9, out.matrix.begin());
  std::copy_n(distortion.ptr<double>(), distortion.total(), std::back_inserter(out.distortion));
  return out;
}

Error too_few(const ChessboardOptions& options, std::size_t found, std::size_t given, const char* what) {
  return invalid_input(
      fmt::format("a chessboard of {}x{} inner corners was found in {} of {} {}, but {} are needed",
                  options.columns, options.rows, found, given, what, options.least_boards));
}

/// The same flat board, once per picture.
std::vector<std::vector<cv::Point3f>> boards_of(const ChessboardOptions& options, std::size_t count) {
  std::vector<cv::Point3f> board;
  for (int r = 0; r < options.rows; ++r)
    for (int c = 0; c < options.columns; ++c)
      board.emplace_back(static_cast<float>(c * options.square_m), static_cast<float>(r * options.square_m),
                         0.0F);
  return std::vector(count, board);
}

}  // namespace

std::vector<Parameter> parameters_of(ChessboardOptions& o) {
  return {{"columns", &o.columns, {2, 100}, "", "inner corners along the board"},
          {"rows", &o.rows, {2, 100}, "", "inner corners across the board"},
          {"square_m", &o.square_m, {0.0001, 10}, "m", "side of a square"},
          {"corner_window_px", &o.corner_window_px, {1, 50}, "px", "half the window of corner refinement"},
          {"least_boards", &o.least_boards, {3, 1000}, "", "pictures that must show the whole board"}};
}

Result<CameraCalibration> calibrate_camera(const std::vector<Image>& pictures,
                                           const ChessboardOptions& options, const Work& work) {
  if (auto in_range = check_ranges(options); !in_range) return in_range.error();
  try {
    std::vector<Corners> seen;
    cv::Size size;
    for (std::size_t i = 0; i < pictures.size(); ++i) {
      if (work.cancelled()) return Work::interrupted();
      work.report(0.7 * static_cast<double>(i) / static_cast<double>(pictures.size()),
                  "looking for the chessboard");
      const cv::Size here(pictures[i].width, pictures[i].height);
      if (i > 0 && here != size)
        return invalid_input("pictures for a calibration must all have the same size");
      size = here;
      if (Corners corners = find_corners(pictures[i], options); !corners.empty())
        seen.push_back(std::move(corners));
    }
    if (static_cast<int>(seen.size()) < options.least_boards)
      return too_few(options, seen.size(), pictures.size(), "pictures");
    cv::Mat matrix;
    cv::Mat distortion;
    std::vector<cv::Mat> turns;
    std::vector<cv::Mat> shifts;
    work.report(0.8, "calibrating");
    CameraCalibration out;
    out.reprojection_px =
        cv::calibrateCamera(boards_of(options, seen.size()), seen, size, matrix, distortion, turns, shifts);
    out.pictures_used = static_cast<int>(seen.size());
    out.camera = lens_of(matrix, distortion);
    return out;
  } catch (const cv::Exception& e) {
    return Error{ErrorCode::failed, std::string("the camera could not be calibrated: ") + e.what(), {}};
  }
}

Result<ChessboardCalibration> calibrate_from_chessboards(const std::vector<StereoPair>& pairs,
                                                         const ChessboardOptions& options, const Work& work) {
  if (auto in_range = check_ranges(options); !in_range) return in_range.error();
  try {
    std::vector<Corners> left;
    std::vector<Corners> right;
    cv::Size size;
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      if (work.cancelled()) return Work::interrupted();
      work.report(0.7 * static_cast<double>(i) / static_cast<double>(pairs.size()),
                  "looking for the chessboard");
      const StereoPair& pair = pairs[i];
      const cv::Size here(pair.left.width, pair.left.height);
      if (here != cv::Size(pair.right.width, pair.right.height) || (i > 0 && here != size))
        return invalid_input("pictures for a calibration must all have the same size");
      size = here;
      Corners in_left = find_corners(pair.left, options);
      Corners in_right = find_corners(pair.right, options);
      if (in_left.empty() || in_right.empty()) continue;
      left.push_back(std::move(in_left));
      right.push_back(std::move(in_right));
    }
    if (static_cast<int>(left.size()) < options.least_boards)
      return too_few(options, left.size(), pairs.size(), "pairs");
    const auto boards = boards_of(options, left.size());
    cv::Mat m1;
    cv::Mat d1;
    cv::Mat m2;
    cv::Mat d2;
    std::vector<cv::Mat> turns;
    std::vector<cv::Mat> shifts;
    work.report(0.8, "calibrating");
    cv::calibrateCamera(boards, left, size, m1, d1, turns, shifts);
    cv::calibrateCamera(boards, right, size, m2, d2, turns, shifts);
    cv::Mat rotation;
    cv::Mat translation;
    cv::Mat essential;
    cv::Mat fundamental;
    ChessboardCalibration out;
    out.reprojection_px =
        cv::stereoCalibrate(boards, left, right, m1, d1, m2, d2, size, rotation, translation, essential,
                            fundamental, cv::CALIB_USE_INTRINSIC_GUESS);
    out.pairs_used = static_cast<int>(left.size());
    out.cameras.left = lens_of(m1, d1);
    out.cameras.right = lens_of(m2, d2);
    std::copy_n(rotation.ptr<double>(), 9, out.cameras.rotation.begin());
    out.cameras.translation_m = {translation.at<double>(0), translation.at<double>(1),
                                 translation.at<double>(2)};
    return out;
  } catch (const cv::Exception& e) {
    return Error{ErrorCode::failed, std::string("the cameras could not be calibrated: ") + e.what(), {}};
  }
}

}  // namespace palpable::vision
