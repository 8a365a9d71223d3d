// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/parameters.hpp"
#include "palpable/core/picture/image.hpp"
#include "palpable/core/result.hpp"
#include "palpable/core/work.hpp"
#include "palpable/vision/rectification/lens_camera.hpp"

#include <array>
#include <optional>
#include <string>
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
  std::vector<std::string> notes;
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

struct PlaneLineOptions {
  /// Shortest edge, share of the picture's diagonal. 0.001 … 0.5.
  double shortest_share = 0.025;
  /// An edge supports a vanishing point that its extension passes within this angle (its sine), as seen from
  /// the edge's middle. 0.001 … 0.5.
  double aim_sine = 0.035;
  /// Number of random pairs of edges (RANSAC). 10 … 100000.
  int trials = 1500;
  /// Vanishing points lie at least this far from the picture's centre, in half diagonals. 0 … 100.
  double least_distance = 1.2;
  /// The second direction makes at least an angle of this cosine with the first, as seen in the centre. 0
  /// … 1.
  double most_cosine = 0.64;
  /// Total length of the supporting edges, in half diagonals, and number of edges that a first direction
  /// needs (a second one needs half). 0 … 100; 2 … 1000.
  double least_support = 0.4;
  int least_edges = 8;
};
std::vector<Parameter> parameters_of(PlaneLineOptions& options);

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

/// The two dominant directions of the picture's straight edges, as lines of a plane. Errors: invalid_input if
/// there are no two roughly orthogonal ones.
Result<PlaneLines> find_plane_lines(const Image& picture, const Work& work,
                                    const PlaneLineOptions& options = {});

}  // namespace palpable::vision
