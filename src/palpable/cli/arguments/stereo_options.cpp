// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/cli/arguments/stereo_options.hpp"

#include "palpable/cli/arguments/parameter_groups.hpp"
#include "palpable/cli/suggest.hpp"
#include "palpable/recipes/relief/relief_recipe.hpp"
#include "palpable/sources/input/input.hpp"
#include "palpable/vision/stereo/methods/match.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include <fmt/format.h>

namespace palpable::cli {

void add_pair_arguments(Options& options, StereoArguments& arguments) {
  options.argument("LEFT", arguments.left, "Left picture, or one file that holds both (MPO, JPS, --layout)");
  options.optional_argument("RIGHT", arguments.right, "Right picture");
}

void add_stereo_options(Options& options, StereoArguments& arguments) {
  options.under("Stereo pairs");
  options.text(
      "--method", arguments.method,
      "How the pair is matched: scanline, graph-cut, segments, pyramid, fast or best; default: best, and "
      "touch begins with fast");
  add_pair_options(options, arguments);
}

void add_parameter_options(Options& options, StereoArguments& arguments) {
  options.under("Stereo pairs");
  options.texts("--set", arguments.parameters,
                "NAME=VALUE: a parameter that palpable methods lists; may be repeated");
}

void add_pair_options(Options& options, StereoArguments& arguments) {
  options.under("Stereo pairs");
  options.integer("--max-disparity", arguments.max_disparity_px, {0, 4096},
                  "Greatest disparity searched, px; 0 = estimated");
  options.text("--calibration", arguments.calibration,
               "The cameras: OpenCV yml or xml, Middlebury calib.txt, or JSON");
  options.choice("--rectify", arguments.rectify, {"auto", "off"},
                 "Warp the pictures so that matching points lie on the same row");
  options.number("--moved", arguments.moved_mm, {0.1, 1e6},
                 "Distance that one camera was moved sideways between the pictures, mm");
  options.number("--megapixels", arguments.megapixels, {0.01, 1000.0},
                 "Larger pictures are reduced to so many million pixels before they are matched");
  options.choice("--layout", arguments.layout,
                 {"side-by-side", "side-by-side-crossed", "over-under", "over-under-crossed"},
                 "How one picture holds a pair; crossed = the right eye's first");
}

Json rectification_json(const session::ReadyPair& ready) {
  const auto figure = [](double px) { return std::isfinite(px) ? Json(px) : Json(nullptr); };
  return {{"by", session::name_of(ready.rectified_by)},
          {"residual_before_px", figure(ready.residual_before_px)},
          {"residual_px", figure(ready.residual_px)},
          {"features", ready.features}};
}

session::Rectification rectification_of(const StereoArguments& arguments) {
  return arguments.rectify == "off" ? session::Rectification::never : session::Rectification::automatic;
}

std::optional<double> moved_m_of(const StereoArguments& arguments) {
  if (!arguments.moved_mm) return std::nullopt;
  return *arguments.moved_mm / 1000.0;
}

std::size_t most_pixels_of(const StereoArguments& arguments) {
  return static_cast<std::size_t>(1e6 * arguments.megapixels);
}

sources::StereoLayout layout_of(const StereoArguments& arguments) {
  using Layout = sources::StereoLayout;
  if (arguments.layout == "side-by-side") return Layout::side_by_side;
  if (arguments.layout == "side-by-side-crossed") return Layout::side_by_side_crossed;
  if (arguments.layout == "over-under") return Layout::over_under;
  if (arguments.layout == "over-under-crossed") return Layout::over_under_crossed;
  return Layout::automatic;
}

Result<session::ReadyPair> read_pair(const StereoArguments& arguments, const Work& work) {
  session::StereoInput input;
  input.pictures.emplace_back(arguments.left);
  if (!arguments.right.empty()) input.pictures.emplace_back(arguments.right);
  if (arguments.right.empty() && arguments.layout.empty()) {
    const auto kind = sources::kind_of_file(arguments.left);
    if (!kind) return kind.error();
    if (*kind != sources::InputKind::stereo)
      return Error{ErrorCode::usage,
                   "is a single picture: give the right picture too, or say how this one holds both "
                   "(--layout)",
                   arguments.left};
  }
  input.calibration = arguments.calibration;
  input.layout = layout_of(arguments);
  input.rectification = rectification_of(arguments);
  input.moved_m = moved_m_of(arguments);
  input.most_pixels = most_pixels_of(arguments);
  return session::read_stereo_pair(input, work);
}

std::string places_of(const StereoArguments& arguments) {
  return arguments.right.empty() ? arguments.left : arguments.left + " and " + arguments.right;
}

std::string names_of(const StereoArguments& arguments) {
  const auto name = [](const std::string& file) { return std::filesystem::path(file).filename().string(); };
  return arguments.right.empty() ? name(arguments.left)
                                 : name(arguments.left) + " and " + name(arguments.right);
}

Result<vision::StereoMethod> stereo_method(const StereoArguments& arguments) {
  if (arguments.method.empty()) return recipes::default_method();
  if (const auto method = vision::stereo_method_from(arguments.method)) return *method;
  std::vector<std::string> names;
  for (const auto method : vision::available_stereo_methods()) names.emplace_back(vision::name_of(method));
  const auto meant = suggestion(arguments.method, names);
  return Error{ErrorCode::usage,
               fmt::format("there is no method {}{}; there are {}", arguments.method,
                           meant ? ", did you mean " + *meant + "?" : "", fmt::join(names, ", ")),
               "--method"};
}

Result<vision::StereoOptions> stereo_options(const StereoArguments& arguments, vision::StereoMethod method,
                                             std::vector<Parameter> more) {
  vision::StereoOptions options;
  options.max_disparity_px = arguments.max_disparity_px;
  std::vector<Parameter> known = vision::parameters_of(options, method);
  std::move(more.begin(), more.end(), std::back_inserter(known));
  if (const auto set = set_parameters(arguments.parameters, known, vision::name_of(method)); !set)
    return set.error();
  if (const auto ok = vision::check(options, method); !ok)
    return Error{ErrorCode::usage, ok.error().sentence(), "--set"};
  return options;
}

Result<vision::StereoOptions> stereo_options_of_all(const StereoArguments& arguments) {
  vision::StereoOptions options;
  options.max_disparity_px = arguments.max_disparity_px;
  std::vector<Parameter> known;
  for (const auto method : vision::available_stereo_methods())
    append_parameters(known, vision::name_of(method), vision::parameters_of(options, method));
  if (const auto set = set_parameters(arguments.parameters, known, "METHOD"); !set) return set.error();
  return options;
}

}  // namespace palpable::cli
