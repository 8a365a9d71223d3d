// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/result.hpp"
#include "palpable/device/recording/recording.hpp"

#include <filesystem>
#include <string>

namespace palpable::session {

/// One line a tick under named columns with their units; an empty field where a number is not finite.
std::string recording_csv(const device::Recording& recording);

/// Writes a recording as the file's ending says: .csv, or .npz with one array a column group
/// (docs/recording.md). Errors: usage (another ending), failed (cannot be written).
Result<void> export_recording(const device::Recording& recording, const std::filesystem::path& file);

}  // namespace palpable::session
