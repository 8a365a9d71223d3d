// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/result.hpp"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace palpable {

/// No input file is read whole beyond this; recordings and videos are streamed instead.
inline constexpr std::uintmax_t kMaxFileBytes = std::uintmax_t{1} << 30U;

/// A pipe states no size, and may never end: less is read from it.
inline constexpr std::uintmax_t kMaxPipeBytes = std::uintmax_t{256} << 20U;

/// Of a text: a table, a list or a description, which takes several times its size in memory.
inline constexpr std::uintmax_t kMaxTextBytes = std::uintmax_t{256} << 20U;

/// The whole content of a regular file (or a pipe). Its size is checked before memory is taken. Errors:
/// invalid_input, with the system's reason: missing, a folder or a device, not permitted, larger than
/// max_bytes (a pipe: than kMaxPipeBytes too).
Result<std::vector<std::byte>> read_file(const std::filesystem::path& path,
                                         std::uintmax_t max_bytes = kMaxFileBytes);

/// The same as text.
Result<std::string> read_text_file(const std::filesystem::path& path,
                                   std::uintmax_t max_bytes = kMaxTextBytes);

/// Its first bytes, at most `count`: enough to recognise it by content. Errors as read_file().
Result<std::vector<std::byte>> read_file_start(const std::filesystem::path& path, std::size_t count);

}  // namespace palpable
