// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/result.hpp"

#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

namespace palpable::formats {

/// Largest decompressed size of all members of one archive.
inline constexpr std::uint64_t kMaxUnpackedBytes = std::uint64_t{2} << 30U;
inline constexpr std::int64_t kMaxMembers = 4096;

using Bytes = std::vector<std::byte>;
/// Members by name.
using ZipMembers = std::map<std::string, Bytes>;

/// Unpacks a whole archive in memory. Every stated size is checked before memory is allocated, and a member
/// of another size than stated is refused; this stops zip bombs. `most_bytes`: all members together.
/// Errors: invalid_input for damage, encryption, duplicate names or sizes above the limits.
Result<ZipMembers> unzip(std::span<const std::byte> file, std::uint64_t most_bytes = kMaxUnpackedBytes);

/// The members' names, without unpacking them. Errors as unzip().
Result<std::vector<std::string>> member_names(std::span<const std::byte> file);

/// Packs members: deflated, or stored if they are compressed already (names that end in .zst, .png or .jpg).
/// The output is deterministic. Errors: failed.
Result<Bytes> zip(const ZipMembers& members);

}  // namespace palpable::formats
