// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>

namespace palpable {

/// Folders in which Linux reports memory use and limits; tests use their own.
struct MemoryFiles {
  std::filesystem::path process = "/proc/self";
  std::filesystem::path system = "/proc/meminfo";
  std::filesystem::path control_groups = "/sys/fs/cgroup";
};

/// How much more memory this process may use: the least of the system's available memory, the remainder of
/// its control group (version 2, as in containers) and of its address space (ulimit -v). nullopt if none of
/// these is known. Reads small files; any thread.
std::optional<std::size_t> available_memory_bytes(const MemoryFiles& files = {});

/// The limit of this process's address space (ulimit -v); nullopt if there is none.
std::optional<std::uint64_t> address_space_limit_bytes();

}  // namespace palpable
