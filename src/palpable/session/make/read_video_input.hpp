// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/result.hpp"
#include "palpable/core/work.hpp"
#include "palpable/session/make/read_input.hpp"
#include "palpable/sources/input/input.hpp"

namespace palpable::session {

/// Reads the frames of a video or of a folder of pictures, and their camera: from the calibration, else with
/// an approximate focal length that the recipe refines; then there is a note. Errors: as
/// sources::read_video() and read_calibration(); invalid_input for a calibration with another aspect ratio.
Result<ReadInput> read_video_input(const sources::Input& input, const InputOptions& options,
                                   const Work& work);

}  // namespace palpable::session
