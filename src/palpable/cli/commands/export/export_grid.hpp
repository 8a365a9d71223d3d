// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/cli/command.hpp"
#include "palpable/models/scene/scene.hpp"

#include <string>

namespace palpable::cli {

/// Writes an occupancy grid as an .npz. Errors: as write_file_atomically().
Result<Answer> export_grid(const models::Grid& grid, const std::string& output);

}  // namespace palpable::cli
