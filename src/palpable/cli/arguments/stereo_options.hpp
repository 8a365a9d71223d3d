// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/cli/command.hpp"
#include "palpable/cli/options.hpp"
#include "palpable/session/make/stereo_input.hpp"
#include "palpable/vision/stereo/methods/stereo_options.hpp"

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace palpable::cli {

/// A stereo pair and how it is matched, as given on the command line.
struct StereoArguments {
  /// `right` is empty if one file contains both pictures. Both are empty in commands with other input.
  std::string left, right;
  /// How one file contains both pictures; empty: as stated in the file.
  std::string layout;
  /// Empty: the command chooses.
  std::string method;
  int max_disparity_px = 0;
  /// NAME=VALUE; `palpable methods` lists the names.
  std::vector<std::string> parameters;
  std::string calibration;
  std::string rectify = "auto";
  std::optional<double> moved_mm;
  /// Millions of pixels above which the pictures are reduced.
  double megapixels = 1e-6 * static_cast<double>(session::kMostPairPixels);
};

/// Adds LEFT and the optional RIGHT. `arguments` must outlive the parsing.
void add_pair_arguments(Options& options, StereoArguments& arguments);

/// Adds --method, --max-disparity, --calibration, --rectify, --moved, --megapixels and --layout.
void add_stereo_options(Options& options, StereoArguments& arguments);

/// Adds --set.
void add_parameter_options(Options& options, StereoArguments& arguments);

/// The same without --method, for commands that run every method or one of their own.
void add_pair_options(Options& options, StereoArguments& arguments);

/// Reads the pair. Errors: as session::read_stereo_pair(); usage if there is only LEFT, it is not a stereo
/// file, and --layout is missing.
Result<session::ReadyPair> read_pair(const StereoArguments& arguments, const Work& work);
/// The pair's file names: with folders for the place of an error, without them for headings.
std::string places_of(const StereoArguments& arguments);
std::string names_of(const StereoArguments& arguments);
/// The value of --layout.
sources::StereoLayout layout_of(const StereoArguments& arguments);
/// The value of --rectify.
session::Rectification rectification_of(const StereoArguments& arguments);
/// The value of --moved, in metres.
std::optional<double> moved_m_of(const StereoArguments& arguments);
/// The value of --megapixels, in pixels.
std::size_t most_pixels_of(const StereoArguments& arguments);

/// How the pair was rectified: `by`, `residual_before_px`, `residual_px` (null where not measured),
/// `features`.
Json rectification_json(const session::ReadyPair& ready);

/// The chosen method, or recipes::default_method(). Errors: usage, for an unknown method.
Result<vision::StereoMethod> stereo_method(const StereoArguments& arguments);

/// The options of this method from --max-disparity and --set. Errors: usage, for an unknown name, a value
/// that is not a number, or one out of range.
Result<vision::StereoOptions> stereo_options(const StereoArguments& arguments, vision::StereoMethod method,
                                             std::vector<Parameter> more = {});

/// The options of every method: --max-disparity, and --set with the method's name before the parameter's:
/// "best.smoothness.largest_step=2". Errors: as stereo_options().
Result<vision::StereoOptions> stereo_options_of_all(const StereoArguments& arguments);

}  // namespace palpable::cli
