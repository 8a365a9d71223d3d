// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/cli/arguments/map_options.hpp"
#include "palpable/cli/arguments/stereo_options.hpp"

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace palpable::cli {

/// The value of --detail that compares all operators side by side.
inline constexpr const char* kCompareDetails = "compare";

/// The input of a scene and how it is made, as given on the command line; shared by make and touch.
struct MakeArguments {
  std::vector<std::string> inputs;
  /// Returns the names of the options on the command line.
  std::function<std::vector<std::string>()> given;
  std::string kind, size, up;
  /// "relief", "contours", "field", "grid", "map"; empty: by the input.
  std::string as;
  std::string lay = "auto";
  double sheet_mm = 1.0;
  StereoArguments stereo;
  std::optional<double> depth_scale, near, far;
  std::string depth_as;
  /// A renderer's near and far planes, metres.
  std::optional<double> near_plane, far_plane;
  double exaggerate = 1.0;
  double compression = 10.0;
  double smooth_mm = 0.0;
  std::string resample = "none";
  int samples = 512;
  std::string detail = "relief";
  /// "depth", "disparity".
  std::string height_of = "depth";
  double steepest_slope = 3.0;
  bool engrave = false;
  std::string contour_method;
  std::string quality;
  std::optional<double> threshold;
  double neighbourhood_px = 3.0;
  double groove_mm = 4.0;
  std::string ground;
  std::optional<int> resolution;
  int grid_points = 160;
  /// "relief", "camera".
  std::string grid_filling = "relief";
  std::optional<double> max_error_mm;
  bool dense = false;
  bool no_cache = false;
  std::string poses;
  /// A length in a frame of a video (known_length.hpp).
  std::string length;
  /// The last frame of a video that is used.
  std::optional<int> until;
  /// "batch", "filter".
  std::string motion = "batch";
  /// "fused", "superquadrics".
  std::string surface = "fused";
  bool paper = false;
  MapArguments map;
  std::string background = "keep";
  std::string texture = "left";
};

/// Adds INPUT… and the options. `arguments` must outlive the parsing.
void add_make_options(Options& options, MakeArguments& arguments);

/// The kinds of input that a scene can be made from: the values of --kind.
const std::vector<std::string>& input_kinds();

}  // namespace palpable::cli
