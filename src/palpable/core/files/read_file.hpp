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

/// Largest size of an input file that is read into memory; recordings and videos are streamed instead.
inline constexpr std::uintmax_t kMaxFileBytes = std::uintmax_t{1} << 30U;

/// Largest number of bytes that is read from a pipe, which has no size and may never end.
inline constexpr std::uintmax_t kMaxPipeBytes = std::uintmax_t{256} << 20U;

/// Largest size of a text (a table, a list or a description), which needs several times its size in memory.
inline constexpr std::uintmax_t kMaxTextBytes = std::uintmax_t{256} << 20U;

/// Reads a regular file or a pipe. The size is checked before memory is allocated. Errors (invalid_input,
/// with the system's reason): missing, a folder or a device, a pipe that nothing writes to within 3 s,
/// permission denied, larger than max_bytes (for a pipe also kMaxPipeBytes).
Result<std::vector<std::byte>> read_file(const std::filesystem::path& path,
                                         std::uintmax_t max_bytes = kMaxFileBytes);

/// Reads a regular file only, without ever waiting for another program: for files that are read again and
/// again while something else goes on. Errors (invalid_input) as read_file(), and a pipe.
Result<std::vector<std::byte>> read_regular_file(const std::filesystem::path& path, std::uintmax_t max_bytes);

/// The same as read_file(), as text.
Result<std::string> read_text_file(const std::filesystem::path& path,
                                   std::uintmax_t max_bytes = kMaxTextBytes);

/// Reads at most the first `count` bytes, to recognise the format before the file is read. Errors as
/// read_file(), and a pipe, which could not be read again.
Result<std::vector<std::byte>> read_file_start(const std::filesystem::path& path, std::size_t count);

}  // namespace palpable
