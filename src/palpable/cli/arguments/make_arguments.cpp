// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/cli/arguments/make_arguments.hpp"

#include "palpable/core/geometry/axis_direction.hpp"
#include "palpable/sculpt/relief/detail.hpp"

#include <iterator>

#include <fmt/format.h>

namespace palpable::cli {
namespace {

std::vector<std::string> up_names() {
  std::vector<std::string> names;
  for (const AxisDirection direction : kAxisDirections) names.emplace_back(name_of(direction));
  return names;
}

void add_input_options(Options& options, MakeArguments& arguments) {
  constexpr int kMostInputs = 4096;
  constexpr Range kDepthUnits{-1e6, 1e6};
  options.arguments(
      "INPUT", arguments.inputs, kMostInputs,
      "A pair (left first), a depth map, a mesh, points, shapes, a video, a map extract, or a scene; "
      "sample:map is the included street map");
  options.under("How the scene is made");
  options.choice(
      "--as", arguments.as, {"relief", "contours", "field", "grid", "map"},
      "Kind of scene; default: contours for a picture, a field for a solid or a video, a map for an "
      "OpenStreetMap extract, a relief for the rest; map = the streets of a map's picture");
  options.text("--kind", arguments.kind,
               fmt::format("Kind of input: {}; default: by content", fmt::join(input_kinds(), ", ")));
  options.text(
      "--size", arguments.size,
      "Largest size of the scene, WxHxD in mm; default: 100x100 and 15 high, and solids as they are or "
      "100x100x50");
  options.number("--depth-scale", arguments.depth_scale, {1e-9, 1e6},
                 "Metres for one step of a depth map; default: as its sidecar or kind says");
  options.choice("--depth-as", arguments.depth_as, {"depth", "distance", "disparity", "nearness", "zbuffer"},
                 "Meaning of the values of a depth map (docs/formats.md)");
  options.number("--near-plane", arguments.near_plane, {1e-6, 1e6}, "Near plane of a depth buffer, m");
  options.number("--far-plane", arguments.far_plane, {1e-6, 1e9},
                 "Far plane of a depth buffer, m; default: infinite");
  options.number("--near", arguments.near, kDepthUnits,
                 "Nearer depths are moved to this one (m; px of disparity without calibration)");
  options.number("--far", arguments.far, kDepthUnits, "Farther depths are moved to this one");
}

void add_relief_options(Options& options, MakeArguments& arguments) {
  options.number("--exaggerate", arguments.exaggerate, {0.1, 10.0}, "Multiplies the relief's height");
  std::vector<std::string> details;
  details.reserve(std::size(sculpt::kDetailOperators) + 1);
  for (const auto detail : sculpt::kDetailOperators) details.emplace_back(sculpt::name_of(detail));
  details.emplace_back(kCompareDetails);
  options.choice("--detail", arguments.detail, details,
                 "How depth becomes height (docs/relief.md); compare = all side by side, as a picture");
  options.number("--compression", arguments.compression, {1.5, 100.0},
                 "How many times higher the scene would be in true proportions");
  options.choice("--height-of", arguments.height_of, {"depth", "disparity"},
                 "What height stands for: depth where it is known, or a pair's disparity");
  options.number("--steepest", arguments.steepest_slope, {0.1, 100.0},
                 "No place of a relief becomes steeper (rise over run)");
  options.number("--smooth", arguments.smooth_mm, {0.0, 10.0},
                 "Detail narrower than this is smoothed away, mm: the resolution of your device");
  options.choice("--resample", arguments.resample, {"none", "bilinear", "bicubic"},
                 "How a relief's depths get --samples samples, before they are mapped");
  options.integer("--samples", arguments.samples, {2, 4096}, "On the longer side; needs --resample");
  options.flag("--engrave", arguments.engrave, "Near parts go down instead of up");
  options.text("--ground", arguments.ground, "Pair or depth map: keep, flatten or remove the ground");
  options.choice("--background", arguments.background, {"keep", "remove"},
                 "Pair or depth map: what to do with the background");
  options.choice("--texture", arguments.texture, {"left", "front", "none"},
                 "The picture on the relief; front = as seen from between the cameras of a pair");
}

void add_solid_options(Options& options, MakeArguments& arguments) {
  options.under("Meshes and other solids");
  options.choice("--up", arguments.up, up_names(),
                 "Which way is up in the file; default: z in STL, y in others");
  options.choice("--lay", arguments.lay, {"auto", "upright", "flat"},
                 "Seen from the front or from above; auto = from above what is low and wide, as a map");
  options.number("--sheet", arguments.sheet_mm, {0.0, 10.0}, "Open sheet: height above its base, mm");
}

void add_field_options(Options& options, MakeArguments& arguments) {
  options.under("Fields and grids");
  options.integer("--grid-points", arguments.grid_points, {8, 512}, "Grid: points along the longest side");
  options.choice("--grid-filling", arguments.grid_filling, {"relief", "camera"},
                 "Grid: under the relief, or in space behind what a pair's camera sees");
  options.integer("--resolution", arguments.resolution, {16, 4096},
                  "Number of finest cells along the longest side; default: 512");
  options.number("--max-error", arguments.max_error_mm, {1e-6, 1000.0},
                 "Greatest error of the distance near the surface, mm; default: 1/10000 of the longest side");
  options.text("--poses", arguments.poses,
               "Several depth maps: the poses of their cameras, CSV frame,qw,qx,qy,qz,tx,ty,tz; a video: "
               "written there");
  options.choice("--motion", arguments.motion, {"batch", "filter"},
                 "A video: the camera's path by bundle adjustment, or frame by frame by a Kalman filter");
  options.choice(
      "--surface", arguments.surface, {"fused", "superquadrics", "corrected"},
      "Field: the surface itself (a video: its depth maps fused), superquadrics fitted to it, or these "
      "corrected by it (Moustakas 2007)");
  options.text(
      "--length", arguments.length,
      "A video: a known length, as '120 mm between 210,240 and 330,250 of frame 40'; default: by a printed "
      "marker (palpable marker), else no true size");
  options.integer("--until", arguments.until, {1, 1e9}, "A video: frames after this one are not used");
  options.flag("--no-cache", arguments.no_cache,
               "Do not take a mesh's field from the cache, where it is kept after it was made "
               "(~/.cache/palpable)");
  options.flag("--dense", arguments.dense, "Field: distances at every point of a lattice, for comparison");
  options.flag("--paper", arguments.paper,
               "Field: dense, by fast marching, with stored forces (Moustakas 2007)");
}

void add_contours_options(Options& options, MakeArguments& arguments) {
  options.under("Contours of one picture");
  options.choice("--contour-method", arguments.contour_method, {"standard", "paper"},
                 "How boundaries are found; paper = graphic-haptic display 2006");
  options.choice("--quality", arguments.quality, {"live", "best"},
                 "best takes seconds and ignores speckle and grain");
  options.number("--threshold", arguments.threshold, {0.0, 1.0},
                 "Least strength of a boundary; default: by Otsu's method");
  options.number("--neighbourhood", arguments.neighbourhood_px, {1.0, 32.0},
                 "Radius over which directions are averaged, px");
  options.number("--groove", arguments.groove_mm, {0.5, 20.0}, "Width of the grooves of the law groove, mm");
}

}  // namespace

const std::vector<std::string>& input_kinds() {
  static const std::vector<std::string> kKinds{"picture", "stereo", "depth", "mesh", "level-set",
                                               "points",  "shapes", "video", "map",  "scene"};
  return kKinds;
}

void add_make_options(Options& options, MakeArguments& arguments) {
  add_input_options(options, arguments);
  add_relief_options(options, arguments);
  add_solid_options(options, arguments);
  add_field_options(options, arguments);
  add_contours_options(options, arguments);
  add_map_options(options, arguments.map);
  add_stereo_options(options, arguments.stereo);
  add_parameter_options(options, arguments.stereo);
  arguments.given = options.given();
}

}  // namespace palpable::cli
