// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/cli/command.hpp"
#include "palpable/cli/options.hpp"
#include "palpable/session/make/stereo_input.hpp"
#include "palpable/vision/stereo/methods/stereo_options.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace palpable::cli {

/// A pair and how it is matched, as given on the command line.
struct StereoArguments {
  /// `right` is empty where one file holds both pictures. Commands that take other input too leave both
  /// empty.
  std::string left, right;
  /// How one file holds both; empty: as it states itself.
  std::string layout;
  /// Empty: the command chooses.
  std::string method;
  int max_disparity_px = 0;
  /// NAME=VALUE, as `palpable methods` lists them.
  std::vector<std::string> parameters;
  std::string calibration;
  std::string rectify = "auto";
  std::optional<double> moved_mm;
};

/// Adds LEFT and RIGHT, the second of which may be left out. `arguments` must outlive the parsing.
void add_pair_arguments(Options& options, StereoArguments& arguments);

/// Adds --method, --max-disparity, --calibration, --rectify, --moved and --layout.
void add_stereo_options(Options& options, StereoArguments& arguments);

/// Adds --set.
void add_parameter_options(Options& options, StereoArguments& arguments);

/// The same without --method, for commands that run every method or one of their own.
void add_pair_options(Options& options, StereoArguments& arguments);

/// The pair of LEFT and RIGHT, read as the arguments say. Errors: as session::read_stereo_pair(), and usage
/// if there is only LEFT, which is no stereo file, and no --layout says how it contains two pictures.
Result<session::ReadyPair> read_pair(const StereoArguments& arguments, const Work& work);
/// LEFT and RIGHT for an error's place or a picture's heading; by their names without folders for the latter.
std::string places_of(const StereoArguments& arguments);
std::string names_of(const StereoArguments& arguments);
/// --layout.
sources::StereoLayout layout_of(const StereoArguments& arguments);
/// --rectify.
session::Rectification rectification_of(const StereoArguments& arguments);
/// --moved in metres.
std::optional<double> moved_m_of(const StereoArguments& arguments);

/// How the pair was rectified: `by`, `residual_before_px`, `residual_px` (null where not measured),
/// `features`.
Json rectification_json(const session::ReadyPair& ready);

/// The method asked for, or recipes::default_method(). Errors: usage, for a method that there is not.
Result<vision::StereoMethod> stereo_method(const StereoArguments& arguments);

/// The options of this method as --max-disparity and --set say. Errors: usage, for an unknown name, a value
/// that is no number, or one out of its range.
Result<vision::StereoOptions> stereo_options(const StereoArguments& arguments, vision::StereoMethod method,
                                             std::vector<Parameter> more = {});

/// The options of every method: --max-disparity, and --set with the method's name before the parameter's:
/// "best.smoothness.largest_step=2". Errors: as stereo_options().
Result<vision::StereoOptions> stereo_options_of_all(const StereoArguments& arguments);

}  // namespace palpable::cli
