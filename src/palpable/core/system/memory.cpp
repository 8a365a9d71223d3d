// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/core/system/memory.hpp"

#include <algorithm>
#include <cstdint>
#include <exception>
#include <fstream>
#include <string>
#include <string_view>

#include <sys/resource.h>
#include <unistd.h>

namespace palpable {
namespace {

using Bytes = std::optional<std::uint64_t>;

/// The number after a name in a file of lines "name number …".
Bytes named_number(const std::filesystem::path& file, std::string_view name) {
  std::ifstream in(file);
  std::string line;
  while (std::getline(in, line)) {
    if (!line.starts_with(name)) continue;
    try {
      return std::stoull(line.substr(name.size()));
    } catch (const std::exception&) {
      return std::nullopt;
    }
  }
  return std::nullopt;
}

std::uint64_t left(std::uint64_t most, std::uint64_t taken) { return most > taken ? most - taken : 0; }

/// Memory left in one control group; the group's file cache can be reclaimed.
Bytes left_in_group(const std::filesystem::path& group) {
  const Bytes most = named_number(group / "memory.max", "");
  const Bytes taken = named_number(group / "memory.current", "");
  if (!most || !taken) return std::nullopt;
  const Bytes kept_files = named_number(group / "memory.stat", "inactive_file ");
  return left(*most, left(*taken, kept_files.value_or(0)));
}

/// The least of the process's control group and all groups above it.
Bytes left_in_groups(const MemoryFiles& files) {
  std::ifstream in(files.process / "cgroup");
  std::string line;
  constexpr std::string_view kVersion2 = "0::/";
  while (std::getline(in, line) && !line.starts_with(kVersion2)) {
  }
  if (!line.starts_with(kVersion2)) return std::nullopt;
  Bytes least;
  std::filesystem::path group = line.substr(kVersion2.size());
  while (true) {
    const Bytes here = left_in_group(files.control_groups / group);
    if (here && (!least || *here < *least)) least = here;
    if (group.empty()) return least;
    group = group.parent_path();
  }
}

Bytes left_in_address_space(const MemoryFiles& files) {
  const Bytes limit = address_space_limit_bytes();
  if (!limit) return std::nullopt;
  const Bytes pages = named_number(files.process / "statm", "");
  const auto page_bytes = static_cast<std::uint64_t>(std::max(sysconf(_SC_PAGESIZE), 1L));
  return left(*limit, pages.value_or(0) * page_bytes);
}

}  // namespace

std::optional<std::uint64_t> address_space_limit_bytes() {
  rlimit limit{};
  if (getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return std::nullopt;
  return limit.rlim_cur;
}

std::optional<std::size_t> available_memory_bytes(const MemoryFiles& files) {
  constexpr std::uint64_t kKibi = 1024;
  Bytes least = named_number(files.system, "MemAvailable:");
  if (least) least = *least * kKibi;
  for (const Bytes other : {left_in_groups(files), left_in_address_space(files)})
    if (other && (!least || *other < *least)) least = other;
  if (!least) return std::nullopt;
  return static_cast<std::size_t>(*least);
}

}  // namespace palpable
