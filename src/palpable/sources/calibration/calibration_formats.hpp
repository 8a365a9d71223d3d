// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/sources/calibration/calibration.hpp"

#include <string_view>

namespace palpable::sources {

// One function per kind of file, for decode_calibration(), which checks the values. Errors: invalid_input,
// without a place, for content that cannot be parsed or is incomplete.

Result<Calibration> calibration_from_json(std::string_view text);
Result<Calibration> calibration_from_middlebury(std::string_view text);
Result<Calibration> calibration_from_opencv(std::string_view text);

}  // namespace palpable::sources
