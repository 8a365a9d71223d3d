// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/result.hpp"
#include "palpable/core/work.hpp"

#include <cstdint>
#include <filesystem>

namespace palpable::session {

struct ExportedRecording {
  /// Of the hand.
  std::uint64_t ticks = 0;
  std::uint64_t lost = 0;
  /// As Recording::complete.
  bool complete = false;
};

/// Writes a recording as the output's ending says. .csv: one line a tick under named columns with their
/// units, an empty field where a number is not finite; of a recording of any size, in some ten megabytes of
/// memory. .npz: one array a column group, of recordings that fit in memory (docs/recording.md). Errors:
/// usage (another ending), as device::read_recording(), failed (cannot be written), interrupted.
Result<ExportedRecording> export_recording(const std::filesystem::path& recording,
                                           const std::filesystem::path& output, const Work& work);

}  // namespace palpable::session
