// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/core/files/byte_reader.hpp"
#include "palpable/sources/picture/decoders.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace palpable::sources {
namespace {

struct Header {
  int id_bytes = 0;
  int map_kind = 0;
  int type = 0;
  int map_first = 0;
  int map_count = 0;
  int map_bits = 0;
  int width = 0;
  int height = 0;
  int bits = 0;
  int descriptor = 0;

  bool run_length() const { return type >= 9; }
  /// 1 palette, 2 true colour, 3 grey.
  int colours() const { return type & 3; }
  int alpha_bits() const { return descriptor & 0x0F; }
  bool from_right() const { return (descriptor & 0x10) != 0; }
  bool from_top() const { return (descriptor & 0x20) != 0; }
};

Header read_header(ByteReader& reader) {
  Header h;
  h.id_bytes = reader.u8();
  h.map_kind = reader.u8();
  h.type = reader.u8();
  h.map_first = reader.u16();
  h.map_count = reader.u16();
  h.map_bits = reader.u8();
  reader.skip(4);
  h.width = reader.u16();
  h.height = reader.u16();
  h.bits = reader.u8();
  h.descriptor = reader.u8();
  return h;
}

bool makes_sense(const Header& h) {
  const bool known_type = (h.type >= 1 && h.type <= 3) || (h.type >= 9 && h.type <= 11);
  const bool true_bits = h.bits == 15 || h.bits == 16 || h.bits == 24 || h.bits == 32;
  const bool map_bits = h.map_bits == 15 || h.map_bits == 16 || h.map_bits == 24 || h.map_bits == 32;
  if (!known_type || h.width == 0 || h.height == 0 || h.map_kind > 1 || (h.descriptor & 0xC0) != 0)
    return false;
  if (h.colours() == 1) return h.map_kind == 1 && h.bits == 8 && map_bits && h.map_count > 0;
  if (h.map_kind == 0 && (h.map_first != 0 || h.map_count != 0)) return false;
  return h.colours() == 2 ? true_bits : h.bits == 8;
}

using Pixel = std::array<float, 4>;

Pixel read_colour(ByteReader& reader, int bits) {
  const auto unit = [](unsigned v, float most) { return static_cast<float>(v) / most; };
  if (bits <= 16) {
    const unsigned v = reader.u16();
    return {unit((v >> 10U) & 31U, 31.0F), unit((v >> 5U) & 31U, 31.0F), unit(v & 31U, 31.0F),
            unit(v >> 15U, 1.0F)};
  }
  const float b = unit(reader.u8(), 255.0F);
  const float g = unit(reader.u8(), 255.0F);
  const float r = unit(reader.u8(), 255.0F);
  return {r, g, b, bits == 32 ? unit(reader.u8(), 255.0F) : 1.0F};
}

Pixel read_pixel(ByteReader& reader, const Header& h, const std::vector<Pixel>& palette) {
  if (h.colours() == 2) return read_colour(reader, h.bits);
  const int value = reader.u8();
  if (h.colours() == 3) {
    const float grey = static_cast<float>(value) / 255.0F;
    return {grey, grey, grey, 1.0F};
  }
  const int index = value - h.map_first;
  return index >= 0 && index < h.map_count ? palette[static_cast<std::size_t>(index)] : Pixel{0, 0, 0, 1};
}

/// Reads pixels in file order and expands run-length coding. False if the file ends too early.
bool read_pixels(ByteReader& reader, const Header& h, const std::vector<Pixel>& palette, const auto& put) {
  const std::int64_t count = std::int64_t{h.width} * h.height;
  for (std::int64_t done = 0; done < count && reader.ok();) {
    const unsigned packet = h.run_length() ? reader.u8() : 0U;
    const std::int64_t length =
        h.run_length() ? std::min<std::int64_t>((packet & 0x7FU) + 1, count - done) : count;
    const bool repeated = (packet & 0x80U) != 0U;
    Pixel pixel{};
    for (std::int64_t i = 0; i < length && reader.ok(); ++i, ++done) {
      if (i == 0 || !repeated) pixel = read_pixel(reader, h, palette);
      put(done, pixel);
    }
  }
  return reader.ok();
}

}  // namespace

bool looks_like_tga(std::span<const std::byte> file) {
  ByteReader reader(file);
  const Header h = read_header(reader);
  return reader.ok() && makes_sense(h);
}

Result<Image> decode_tga(std::span<const std::byte> file) {
  ByteReader reader(file);
  const Header h = read_header(reader);
  if (!reader.ok() || !makes_sense(h)) return invalid_input("is a TGA picture with a damaged header");
  if (auto size = check_picture_size(h.width, h.height); !size) return std::move(size).error();
  reader.skip(static_cast<std::size_t>(h.id_bytes));
  std::vector<Pixel> palette;
  for (int i = 0; h.map_kind == 1 && i < h.map_count && reader.ok(); ++i)
    palette.push_back(read_colour(reader, h.map_bits));
  // A run packet gives at most 128 pixels for two bytes, so a header alone cannot cause a large allocation.
  const std::int64_t pixels = std::int64_t{h.width} * h.height;
  const std::string cut_off = "is a TGA picture that is cut off: pixels are missing";
  if (!reader.ok() || static_cast<std::int64_t>(reader.left()) < pixels / 64) return invalid_input(cut_off);

  Image image{h.width, h.height, h.colours() == 3 ? 1 : h.alpha_bits() > 0 ? 4 : 3, 8, {}};
  const auto channels = static_cast<std::size_t>(image.channels);
  image.samples.resize(static_cast<std::size_t>(pixels) * channels);
  const bool whole = read_pixels(reader, h, palette, [&](std::int64_t i, const Pixel& pixel) {
    const auto column = static_cast<int>(i % h.width);
    const auto row = static_cast<int>(i / h.width);
    const int x = h.from_right() ? h.width - 1 - column : column;
    const int y = h.from_top() ? row : h.height - 1 - row;
    const auto place =
        static_cast<std::size_t>(y) * static_cast<std::size_t>(h.width) + static_cast<std::size_t>(x);
    std::copy_n(pixel.begin(), channels,
                image.samples.begin() + static_cast<std::ptrdiff_t>(place * channels));
  });
  if (!whole) return invalid_input(cut_off);
  return image;
}

}  // namespace palpable::sources
