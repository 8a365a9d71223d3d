// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/result.hpp"
#include "palpable/models/scene/scene.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace palpable::cli {

/// What `export` tells apart. A map is a relief with streets.
enum class Exported { relief, map, field, grid, contours, recording };

Exported exported_kind(const models::Scene& scene);

/// Every suffix of a file that something can be exported to, each once: ".stl", ….
std::vector<std::string> export_suffixes();

/// Checks, by one table of all formats, that this can be written to a file of this name. Errors: usage, with
/// the suffixes that would do.
Result<void> check_export(Exported what, const std::filesystem::path& output);

/// Which of the `given` options the format does not read, and what they are for; nullopt if it reads all.
/// Those of no format, as --json, are not looked at.
std::optional<std::string> note_on_unread(Exported what, const std::filesystem::path& output,
                                          const std::vector<std::string>& given);

}  // namespace palpable::cli
