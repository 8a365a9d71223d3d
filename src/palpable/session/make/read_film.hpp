// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/result.hpp"
#include "palpable/core/work.hpp"
#include "palpable/session/make/read_input.hpp"
#include "palpable/sources/input/input.hpp"

namespace palpable::session {

/// The frames of a film or of a folder's pictures, and their camera: as the calibration says, else with a
/// focal length of the right order, which the recipe refines; with a note. Errors: as sources::read_video()
/// and read_calibration(); invalid_input for a calibration of pictures of other proportions.
Result<ReadInput> read_film(const sources::Input& input, const InputOptions& options, const Work& work);

}  // namespace palpable::session
