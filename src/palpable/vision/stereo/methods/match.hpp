// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/result.hpp"
#include "palpable/core/work.hpp"
#include "palpable/vision/stereo/problem/stereo.hpp"

#include <optional>
#include <string_view>
#include <vector>

namespace palpable::vision {

/// The name on the command line ("graph-cut"); and back, nullopt for an unknown name.
std::string_view name_of(StereoMethod method);
std::optional<StereoMethod> stereo_method_from(std::string_view name);
/// The methods that this program holds.
std::vector<StereoMethod> available_stereo_methods();

/// Runs one method with the same parameters for every picture. Errors: invalid_input for sizes that differ or
/// are too small, interrupted. Long work: reports progress, polls cancel.
Result<StereoMatch> match(const StereoPair& pair, StereoMethod method, const StereoOptions& options,
                          const Work& work);

}  // namespace palpable::vision
