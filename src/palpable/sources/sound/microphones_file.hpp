// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/result.hpp"
#include "palpable/core/sound/microphones.hpp"

#include <filesystem>
#include <string_view>

namespace palpable::sources {

/// A JSON file of an array of microphones: `microphones_m`, a list of 1 to 64 places [x, y, z]; `frame`,
/// "camera" (the default: x right, y down, z ahead) or "robot" (x ahead, y left, z up, as in ROS);
/// `speed_of_sound_m_per_s`, 343.2 if absent. Errors, invalid_input without a place: text that is no such
/// file, numbers that are not finite. Whether the places tell directions apart is not asked here.
Result<Microphones> decode_microphones(std::string_view text);

/// Reads one. Errors as read_file() and decode_microphones(), with the file's name.
Result<Microphones> read_microphones(const std::filesystem::path& path);

}  // namespace palpable::sources
