// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/result.hpp"
#include "palpable/sources/calibration/calibration.hpp"

#include <cstddef>
#include <span>
#include <string_view>
#include <vector>

// OpenCV calibrations in replies of the decoder process.
namespace palpable::sources::isolated {

/// `rig` is omitted: OpenCV files do not state one.
std::vector<std::byte> reply_of(const Calibration& calibration);

/// Decodes a reply; decode_calibration() checks the values, as for every file. Errors: those in the reply;
/// invalid_input for an invalid reply.
Result<Calibration> calibration_in(std::span<const std::byte> reply);

/// Runs sources::calibration_from_opencv() in the decoder process.
Result<Calibration> calibration_from_opencv(std::string_view text);

}  // namespace palpable::sources::isolated
