// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/result.hpp"
#include "palpable/models/scene/scene.hpp"

#include <array>
#include <span>
#include <string_view>
#include <vector>

namespace palpable::onefile {

/// Time and place of a probe: t_s, x_m, y_m, z_m.
using ProbeRow = std::array<double, 4>;
/// The law's force there, and 1 in contact, else 0: fx_N, fy_N, fz_N, contact.
using ForceRow = std::array<double, 4>;

/// What `palpable probe` writes for the same path. `options`: a JSON object of `law` (a name; else the
/// scene's default) and numbers named as the options of the command line without dashes, lengths in mm. A
/// number that the law does not have is ignored, as it is there. Errors: usage for options that are no such
/// object, a law that the scene does not have, and those of haptics::make_touchable(); invalid_input for rows
/// that are not finite or not later than the one before.
Result<std::vector<ForceRow>> probe_rows(const models::Scene& scene, std::string_view options,
                                         std::span<const ProbeRow> rows);

}  // namespace palpable::onefile
