// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>

namespace palpable {

/// Where the system tells about memory (Linux); others for tests.
struct MemoryFiles {
  std::filesystem::path process = "/proc/self";
  std::filesystem::path system = "/proc/meminfo";
  std::filesystem::path control_groups = "/sys/fs/cgroup";
};

/// How much more memory this process may take before the system has none left, its control group (version 2,
/// as containers have) is full, or its address space (ulimit -v) ends: the least of what is told; nullopt if
/// nothing is. Reads small files; any thread.
std::optional<std::size_t> available_memory_bytes(const MemoryFiles& files = {});

}  // namespace palpable
