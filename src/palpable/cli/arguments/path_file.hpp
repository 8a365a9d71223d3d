// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/text/number_table.hpp"
#include "palpable/haptics/servo/probe_path.hpp"

#include <filesystem>
#include <vector>

namespace palpable::cli {

/// Reads the columns `wanted` of a CSV file. Errors: as parse_number_table(), with the file's name.
Result<NumberTable> read_number_table(const std::filesystem::path& file,
                                      std::span<const std::string_view> wanted);

/// Reads a path of the probe from a CSV with t_s, x_m, y_m, z_m. Errors: invalid_input, naming the file, the
/// line and the fault; times must increase.
Result<std::vector<haptics::PathSample>> read_path(const std::filesystem::path& file);

}  // namespace palpable::cli
