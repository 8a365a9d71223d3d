// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/result.hpp"
#include "palpable/sources/calibration/calibration.hpp"

#include <cstddef>
#include <span>
#include <string_view>
#include <vector>

// OpenCV's calibrations as the decoder process replies with them.
namespace palpable::sources::isolated {

/// Without `rig`, which no file of OpenCV's states.
std::vector<std::byte> reply_of(const Calibration& calibration);

/// What a reply says; decode_calibration() checks the values, as of every file. Errors: the reply's own;
/// invalid_input for one that is not what it should be.
Result<Calibration> calibration_in(std::span<const std::byte> reply);

/// sources::calibration_from_opencv(), run in the decoder process.
Result<Calibration> calibration_from_opencv(std::string_view text);

}  // namespace palpable::sources::isolated
