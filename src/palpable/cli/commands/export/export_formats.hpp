// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/result.hpp"
#include "palpable/models/scene/scene.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace palpable::cli {

/// What `export` tells apart. A map is a relief with streets.
enum class Exported { relief, map, field, grid, contours, recording };

Exported exported_kind(const models::Scene& scene);

/// Every suffix of a file that something can be exported to, each once: ".stl", ….
std::vector<std::string> export_suffixes();

/// Checks, by one table of all formats, that this can be written to a file of this name, and that the format
/// reads every one of the `given` options (those of no format, as --json, pass).
/// Errors: usage, with the suffixes that would do, or with what the option is for.
Result<void> check_export(Exported what, const std::filesystem::path& output,
                          const std::vector<std::string>& given);

}  // namespace palpable::cli
