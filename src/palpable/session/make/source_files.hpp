// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/result.hpp"
#include "palpable/core/work.hpp"
#include "palpable/models/scene/scene.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace palpable::session {

/// The SHA-256 (FIPS 180-4) of a regular file's content as 64 hexadecimal digits, as sha256sum prints it.
/// Errors: invalid_input if it cannot be read to its end; interrupted.
Result<std::string> sha256_of(const std::filesystem::path& file, const Work& work);

/// These files with their sizes and hashes. Errors: as sha256_of().
Result<std::vector<models::SourceFile>> source_files(const std::vector<std::filesystem::path>& files,
                                                     const Work& work);

/// Where each of a scene's source files is now, in their order: under its name, or beside `scene`, with the
/// same content. Errors (invalid_input, one sentence with the file's name): it is at neither place, or its
/// content is another one; as sha256_of().
Result<std::vector<std::filesystem::path>> find_source_files(const std::vector<models::SourceFile>& files,
                                                             const std::filesystem::path& scene,
                                                             const Work& work);

}  // namespace palpable::session
