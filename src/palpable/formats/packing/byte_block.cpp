// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/formats/packing/byte_block.hpp"

#include "palpable/formats/packing/zstd_frame.hpp"

#include <zstd.h>

namespace palpable::formats {

Result<std::vector<std::byte>> pack_bytes(std::span<const std::uint8_t> bytes) {
  // Of the large blocks of a scan's field, level 12 takes four times as long as level 8 and saves nothing,
  // and level 17 thirty times as long for 4 % less. Small ones take little time anyway.
  constexpr int kThorough = 17, kFast = 8;
  constexpr std::size_t kSmall = std::size_t{1} << 20U;
  return zstd_frame(std::as_bytes(bytes), bytes.size() <= kSmall ? kThorough : kFast);
}

Result<std::vector<std::uint8_t>> unpack_bytes(std::span<const std::byte> packed, std::size_t most) {
  const Error damaged = invalid_input("holds a block of bytes that is damaged or cut off");
  const unsigned long long size = ZSTD_getFrameContentSize(packed.data(), packed.size());
  if (size > most || !may_unpack(packed.size(), size)) return damaged;
  std::vector<std::uint8_t> out(size);
  const std::size_t got = ZSTD_decompress(out.data(), out.size(), packed.data(), packed.size());
  if (ZSTD_isError(got) != 0U || got != out.size()) return damaged;
  return out;
}

}  // namespace palpable::formats
