// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/result.hpp"
#include "palpable/core/work.hpp"
#include "palpable/vision/stereo/methods/stereo_options.hpp"
#include "palpable/vision/stereo/problem/stereo.hpp"
#include "palpable/vision/stereo/problem/stereo_method.hpp"

#include <optional>
#include <string_view>
#include <vector>

namespace palpable::vision {

/// The name on the command line ("graph-cut"); and back, nullopt for an unknown name.
std::string_view name_of(StereoMethod method);
std::optional<StereoMethod> stereo_method_from(std::string_view name);
/// All methods.
std::vector<StereoMethod> available_stereo_methods();

/// One sentence on how the method works.
std::string_view summary_of(StereoMethod method);
/// The papers that it is built on: "Shi & Pai 1997".
std::string_view paper_of(StereoMethod method);

/// Runs one method. Errors: invalid_input for sizes that differ or are too small, usage for options out of
/// their ranges, interrupted. Long-running: reports progress, polls for cancellation.
Result<StereoMatch> match(const StereoPair& pair, StereoMethod method, const StereoOptions& options,
                          const Work& work);

}  // namespace palpable::vision
