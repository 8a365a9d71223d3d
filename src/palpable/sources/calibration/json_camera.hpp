// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/picture/camera.hpp"
#include "palpable/core/result.hpp"

#include <optional>

#include <nlohmann/json_fwd.hpp>

namespace palpable::sources {

/// The number under `key`; nullopt if there is none. `object` must be an object.
std::optional<double> number_in(const nlohmann::json& object, const char* key);

/// Checks that focal lengths and principal point are plausible: 0.1 to a million pixels, and at most a
/// million pixels away. Errors: invalid_input.
Result<void> check_lens(double fx_px, double fy_px, double cx_px, double cy_px);

/// Reads a camera from fx, fy, cx, cy, width, height. Errors: invalid_input naming what is missing or
/// impossible.
Result<Pinhole> pinhole_from(const nlohmann::json& object);

}  // namespace palpable::sources
