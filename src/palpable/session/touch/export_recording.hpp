// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/result.hpp"
#include "palpable/core/work.hpp"

#include <cstdint>
#include <filesystem>

namespace palpable::session {

struct ExportedRecording {
  /// Ticks of the hand.
  std::uint64_t ticks = 0;
  std::uint64_t lost = 0;
  /// As Recording::complete.
  bool complete = false;
};

/// Writes a recording in the format of the output's suffix. .csv: one line per tick with named columns and
/// units, an empty field for a value that is not finite; for recordings of any size, in about ten megabytes
/// of memory. .npz: one array per column group, for recordings that fit in memory (docs/recording.md). A
/// truncated recording is exported up to its end; nothing is written of a damaged one. Errors: usage (another
/// suffix), as device::read_recording(), failed (cannot be written), interrupted.
Result<ExportedRecording> export_recording(const std::filesystem::path& recording,
                                           const std::filesystem::path& output, const Work& work);

}  // namespace palpable::session
