// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/core/files/crc32.hpp"

#include <zlib.h>

namespace palpable {

std::uint32_t crc32(std::span<const std::byte> bytes, std::uint32_t before) {
  // zlib returns its initial value for a null pointer.
  if (bytes.empty()) return before;
  return static_cast<std::uint32_t>(
      ::crc32_z(before, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()));
}

}  // namespace palpable
