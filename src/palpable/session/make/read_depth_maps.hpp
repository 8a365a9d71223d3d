// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/session/make/read_input.hpp"

#include <filesystem>
#include <vector>

namespace palpable::session {

/// Reads several depth maps of one scene and their poses. Errors: invalid_input, naming the file;
/// interrupted.
Result<ReadInput> read_depth_maps(const InputOptions& options, const Work& work);

/// The settings of a depth file, with the camera of options.calibration. Errors: as
/// sources::read_calibration().
Result<sources::DepthSettings> depth_settings(const InputOptions& options);

}  // namespace palpable::session
