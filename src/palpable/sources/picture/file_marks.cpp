// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sources/picture/file_marks.hpp"

#include "palpable/core/files/byte_reader.hpp"

#include <algorithm>
#include <array>
#include <string_view>

namespace palpable::sources {

bool is_heif(std::span<const std::byte> file) {
  constexpr std::array<std::string_view, 8> kBrands{"heic", "heix", "hevc", "heim",
                                                    "heis", "mif1", "msf1", "avif"};
  return has_magic(file, "ftyp", 4) &&
         std::any_of(kBrands.begin(), kBrands.end(),
                     [&](std::string_view brand) { return has_magic(file, brand, 8); });
}

bool is_exr(std::span<const std::byte> file) { return has_magic(file, "\x76\x2F\x31\x01"); }

bool is_animated_png(std::span<const std::byte> file) {
  constexpr std::string_view kStart("\x89PNG\r\n\x1A\n");
  if (!has_magic(file, kStart)) return false;
  ByteReader reader(file, std::endian::big);
  reader.skip(kStart.size());
  while (reader.ok()) {
    const std::uint32_t length = reader.u32();
    const std::uint32_t kind = reader.u32();
    constexpr std::uint32_t kAnimation = 0x6163544C, kPictureData = 0x49444154;  // acTL, IDAT
    if (!reader.ok() || kind == kPictureData) return false;
    if (kind == kAnimation) return true;
    constexpr std::size_t kChecksumBytes = 4;
    reader.skip(length + kChecksumBytes);
  }
  return false;
}

}  // namespace palpable::sources
