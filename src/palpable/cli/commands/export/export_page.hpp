// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/cli/command.hpp"
#include "palpable/models/scene/scene.hpp"

#include <filesystem>

namespace palpable::cli {

/// Writes a scene as one page (.html) that touches it without any program. Errors: as onefile::encode_page()
/// and write_file_atomically().
Result<Answer> export_page(const models::Scene& scene, const std::filesystem::path& output);

}  // namespace palpable::cli
