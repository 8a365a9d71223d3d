// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace palpable {

/// The CRC-32 of zip, PNG and Ethernet (ISO 3309, reflected polynomial EDB88320), computed by zlib. `before`
/// is the CRC of the preceding bytes. Any thread.
std::uint32_t crc32(std::span<const std::byte> bytes, std::uint32_t before = 0);

}  // namespace palpable
