// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/note.hpp"
#include "palpable/core/parameters.hpp"
#include "palpable/core/picture/image.hpp"
#include "palpable/core/result.hpp"
#include "palpable/core/work.hpp"
#include "palpable/vision/rectification/lens_camera.hpp"
#include "palpable/vision/rectification/plane_tilt.hpp"

#include <array>
#include <optional>
#include <vector>

namespace palpable::vision {

/// A straight line of the picture by two of its points, pixels.
struct PictureLine {
  PicturePoint from;
  PicturePoint to;
};

/// Lines of the plane that a picture shows (a map on a table, a painting on a wall).
struct PlaneLines {
  /// Two lines that are parallel on the plane, and two more in another direction: they determine the
  /// vanishing line.
  std::array<PictureLine, 2> along;
  std::array<PictureLine, 2> across;
  /// Pairs of lines that are orthogonal on the plane. Two independent pairs determine the proportions. If
  /// there are fewer, `along` and `across` are assumed orthogonal, and the rest follows from a camera with
  /// its principal point in the picture's middle.
  std::vector<std::array<PictureLine, 2>> orthogonal;
};

/// A rectangle of the plane: its corners in the picture from the upper left clockwise, and the ratio of its
/// width to its height if known.
struct PlaneRectangle {
  std::array<PicturePoint, 4> corners;
  std::optional<double> aspect;
};

struct RectifiedPlane {
  /// The plane seen from directly above, white where the picture does not show it.
  Image picture;
  /// Row-major homography from a pixel of the input to a pixel of `picture`.
  Matrix3 picture_from_input = kIdentity3;
  std::vector<Note> notes;
};

struct PlaneRectificationOptions {
  /// The longer side of the rectified picture over that of the input, and its limit. 0.1 … 8; 64 … 32768 px.
  double enlargement = 1.5;
  double most_side_px = 8192.0;
  /// Farther parts of the plane are cut off: least inverse depth relative to that of the picture's centre.
  /// 0.01 … 1.
  double least_nearness = 0.3;
  /// Range of plausible focal lengths, in half diagonals of the picture. 0.1 … 100.
  double shortest_focal = 0.5;
  double longest_focal = 8.0;
};
std::vector<Parameter> parameters_of(PlaneRectificationOptions& options);

/// Metric rectification of a plane (Gomez 2012; Hartley & Zisserman 2004, 2.7). The vanishing line is mapped
/// to infinity, which gives an affine picture; then the conic dual to the circular points, from two
/// orthogonal pairs, restores angles and proportions. The `along` lines become horizontal. Errors:
/// invalid_input for lines that determine no plane (parallel pairs that are one line, orthogonal pairs that
/// are not independent); usage for options out of range.
Result<RectifiedPlane> rectify_plane(const Image& picture, const PlaneLines& lines,
                                     const PlaneRectificationOptions& options = {});
/// The same from a rectangle; the result is cropped to it.
Result<RectifiedPlane> rectify_rectangle(const Image& picture, const PlaneRectangle& rectangle,
                                         const PlaneRectificationOptions& options = {});
/// The same from the tilt.
Result<RectifiedPlane> rectify_tilt(const Image& picture, const PlaneTilt& tilt,
                                    const PlaneRectificationOptions& options = {});

}  // namespace palpable::vision
