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

/// The most that all members of one archive may unpack to.
inline constexpr std::uint64_t kMaxUnpackedBytes = std::uint64_t{2} << 30U;
inline constexpr std::int64_t kMaxMembers = 4096;

using Bytes = std::vector<std::byte>;
/// Members by name.
using ZipMembers = std::map<std::string, Bytes>;

/// Unpacks a whole archive in memory. Every stated size is checked before memory is taken, and a member that
/// unpacks to another size than it states is damage: a zip bomb is refused by its own words. Errors:
/// invalid_input for damage, encryption, doubled names or more than the limits above.
Result<ZipMembers> unzip(std::span<const std::byte> file);

/// The members' names, without unpacking them. Errors as unzip().
Result<std::vector<std::string>> member_names(std::span<const std::byte> file);

/// Packs members: deflated, or stored as they are where they are compressed already (their name ends in one
/// of .zst .png .jpg). The same members give the same bytes. Errors: failed.
Result<Bytes> zip(const ZipMembers& members);

}  // namespace palpable::formats
