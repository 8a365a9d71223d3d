// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/image.hpp"
#include "palpable/core/result.hpp"
#include "palpable/core/work.hpp"

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace palpable::vision {

struct PicturePoint {
  double x = 0.0;
  double y = 0.0;
};

/// A straight line of the picture by two of its points, pixels.
struct PictureLine {
  PicturePoint from;
  PicturePoint to;
};

/// What is known of the plane that a picture shows (a map on a table, a painting on a wall).
struct PlaneLines {
  /// Two lines that are parallel on the plane, and two more of another direction: they give the vanishing
  /// line.
  std::array<PictureLine, 2> along;
  std::array<PictureLine, 2> across;
  /// Pairs of lines that are at right angles on the plane. Two independent pairs fix the proportions; where
  /// there are fewer, `along` and `across` are taken to be at right angles, and the rest follows from a
  /// camera whose axis meets the picture's middle.
  std::vector<std::array<PictureLine, 2>> orthogonal;
};

/// A rectangle of the plane: its corners in the picture from the upper left clockwise, and the ratio of its
/// width to its height where that is known.
struct PlaneRectangle {
  std::array<PicturePoint, 4> corners;
  std::optional<double> aspect;
};

struct RectifiedPlane {
  /// The plane as seen from straight above, white where the picture does not show it.
  Image picture;
  /// Row-major; takes a pixel of the input to a pixel of `picture` (divide by the third).
  std::array<double, 9> picture_from_input{1, 0, 0, 0, 1, 0, 0, 0, 1};
  std::vector<std::string> notes;
};

/// Metric rectification of a plane (Gomez 2012; Hartley & Zisserman 2004, 2.7): the vanishing line goes to
/// infinity, which leaves an affine picture; then the conic dual to the circular points, from two orthogonal
/// pairs, gives angles and proportions back. The `along` lines come out level. Errors: invalid_input for
/// lines that fix no plane (parallel pairs that are one line, orthogonal pairs that are not independent).
Result<RectifiedPlane> rectify_plane(const Image& picture, const PlaneLines& lines);
/// The same by a rectangle, and cut to it.
Result<RectifiedPlane> rectify_rectangle(const Image& picture, const PlaneRectangle& rectangle);

/// The two directions that most straight edges of the picture follow, as lines of a plane. Errors:
/// invalid_input where there are none at about right angles.
Result<PlaneLines> find_plane_lines(const Image& picture, const Work& work);

}  // namespace palpable::vision
