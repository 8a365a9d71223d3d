// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/result.hpp"
#include "palpable/core/sound/sound.hpp"

#include <cstddef>
#include <filesystem>
#include <span>

namespace palpable::sources {

/// A WAV file (RIFF, or RF64 for long ones): PCM of 8, 16, 24 or 32 bits, or floats of 32 or 64 bits, 1 to 64
/// channels. A last sample that is not whole, and data that the file lacks, as a recorder leaves them that
/// was stopped, are left out. Errors, invalid_input without a place: another format, damage, no samples, a
/// rate outside of 1 to 1 000 000 Hz, samples that are not finite.
Result<Sound> decode_wave(std::span<const std::byte> file);

/// Reads one. Errors as read_file() and decode_wave(), with the file's name.
Result<Sound> read_wave(const std::filesystem::path& path);

}  // namespace palpable::sources
