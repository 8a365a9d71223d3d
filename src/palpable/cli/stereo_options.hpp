// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/cli/options.hpp"
#include "palpable/vision/stereo.hpp"

#include <string>

namespace palpable::cli {

/// How a pair is matched, as given on the command line.
struct StereoArguments {
  /// Empty: the command chooses.
  std::string method;
  int max_disparity_px = 0;
  std::string calibration;
};

/// Adds --method, --max-disparity and --calibration. `arguments` must outlive the parsing.
void add_stereo_options(Options& options, StereoArguments& arguments);

/// The method asked for, or session::default_method(). Errors: usage, for a method that there is not.
Result<vision::StereoMethod> stereo_method(const StereoArguments& arguments);

}  // namespace palpable::cli
