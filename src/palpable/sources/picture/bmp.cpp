// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/core/files/byte_reader.hpp"
#include "palpable/sources/picture/decoders.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <vector>

namespace palpable::sources {
namespace {

constexpr std::uint32_t kPlain = 0;
constexpr std::uint32_t kWithMasks = 3;
constexpr std::uint32_t kWithAlphaMask = 6;

struct Header {
  std::uint32_t pixels_at = 0;
  std::uint32_t size = 0;
  std::int32_t width = 0;
  std::int32_t height = 0;
  int bits = 0;
  std::uint32_t coding = 0;
  std::uint32_t colours = 0;
  /// Red, green, blue, alpha.
  std::array<std::uint32_t, 4> masks{};
};

/// Reads the file header and the picture header, from BITMAPCOREHEADER (12 bytes) to BITMAPV5HEADER (124).
Header read_header(ByteReader& reader) {
  Header h;
  reader.seek(10);
  h.pixels_at = reader.u32();
  h.size = reader.u32();
  if (h.size == 12) {
    h.width = reader.u16();
    h.height = reader.u16();
    reader.skip(2);
    h.bits = reader.u16();
  } else {
    h.width = std::bit_cast<std::int32_t>(reader.u32());
    h.height = std::bit_cast<std::int32_t>(reader.u32());
    reader.skip(2);
    h.bits = reader.u16();
    h.coding = reader.u32();
    reader.skip(12);
    h.colours = reader.u32();
    reader.skip(4);
  }
  if (h.coding == kWithMasks || h.coding == kWithAlphaMask || h.size >= 56) {
    for (std::size_t i = 0; i < 4; ++i)
      if (i < 3 || h.size >= 56 || h.coding == kWithAlphaMask) h.masks[i] = reader.u32();
  }
  if (h.coding == kPlain && h.bits == 16) h.masks = {0x7C00, 0x03E0, 0x001F, 0};
  if (h.coding == kPlain && h.bits == 32) h.masks = {0xFF0000, 0xFF00, 0xFF, 0};
  return h;
}

float masked(std::uint32_t value, std::uint32_t mask) {
  if (mask == 0) return 0.0F;
  const int shift = std::countr_zero(mask);
  return static_cast<float>((value & mask) >> shift) / static_cast<float>(mask >> shift);
}

using Palette = std::vector<std::array<float, 3>>;

Palette read_palette(ByteReader& reader, const Header& h) {
  const std::size_t most = std::size_t{1} << static_cast<unsigned>(h.bits);
  const std::size_t count = h.colours == 0 || h.colours > most ? most : h.colours;
  reader.seek(14 + std::size_t{h.size});
  // A file may contain fewer palette entries than possible; the missing ones are black.
  Palette palette(most, {0.0F, 0.0F, 0.0F});
  for (std::size_t i = 0; i < count && reader.ok() && reader.position() < h.pixels_at; ++i) {
    for (const std::size_t c : {2U, 1U, 0U}) palette[i][c] = static_cast<float>(reader.u8()) / 255.0F;
    if (h.size != 12) reader.skip(1);
  }
  return palette;
}

void convert_row(std::span<const std::byte> row, const Header& h, const Palette& palette,
                 std::span<float> out) {
  ByteReader reader(row);
  const auto channels = out.size() / static_cast<std::size_t>(h.width);
  for (std::size_t x = 0; x < static_cast<std::size_t>(h.width); ++x) {
    float* p = out.data() + x * channels;
    if (h.bits <= 8) {
      const auto bits = static_cast<unsigned>(h.bits);
      const auto per_byte = 8 / bits;
      const unsigned byte = std::to_integer<unsigned>(row[x / per_byte]);
      const auto index = (byte >> (8 - bits * (x % per_byte + 1))) & ((1U << bits) - 1U);
      std::copy(palette[index].begin(), palette[index].end(), p);
    } else if (h.bits == 24) {
      for (const std::size_t c : {2U, 1U, 0U}) p[c] = static_cast<float>(reader.u8()) / 255.0F;
    } else {
      const std::uint32_t value = h.bits == 16 ? reader.u16() : reader.u32();
      for (std::size_t c = 0; c < channels; ++c) p[c] = masked(value, h.masks[c]);
    }
  }
}

}  // namespace

Result<Image> decode_bmp(std::span<const std::byte> file) {
  ByteReader reader(file);
  const Header h = read_header(reader);
  const bool known_bits =
      h.bits == 1 || h.bits == 4 || h.bits == 8 || h.bits == 16 || h.bits == 24 || h.bits == 32;
  if (!reader.ok() || h.size < 12 || !known_bits)
    return invalid_input("is a BMP picture with a damaged header");
  if (h.coding != kPlain && h.coding != kWithMasks && h.coding != kWithAlphaMask)
    return invalid_input("is a run-length coded BMP picture, which is not supported; save it as PNG");
  const bool top_first = h.height < 0;
  const std::int64_t height = std::llabs(h.height);
  if (auto size = check_picture_size(h.width, height); !size) return std::move(size).error();

  const std::size_t stride =
      (static_cast<std::size_t>(h.width) * static_cast<std::size_t>(h.bits) + 31) / 32 * 4;
  const Palette palette = h.bits <= 8 ? read_palette(reader, h) : Palette{};
  reader = ByteReader(file);
  reader.seek(h.pixels_at);
  const auto pixels = reader.bytes(stride * static_cast<std::size_t>(height));
  if (!reader.ok()) return invalid_input("is a BMP picture that is cut off: pixels are missing");

  Image image{h.width, static_cast<int>(height), h.bits >= 16 && h.masks[3] != 0 ? 4 : 3, 8, {}};
  const std::size_t row = static_cast<std::size_t>(h.width) * static_cast<std::size_t>(image.channels);
  image.samples.resize(row * static_cast<std::size_t>(height));
  for (std::size_t y = 0; y < static_cast<std::size_t>(height); ++y) {
    const std::size_t to = top_first ? y : static_cast<std::size_t>(height) - 1 - y;
    convert_row(pixels.subspan(y * stride, stride), h, palette,
                std::span(image.samples).subspan(to * row, row));
  }
  return image;
}

}  // namespace palpable::sources
