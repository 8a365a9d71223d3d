// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sources/picture/exif.hpp"

#include "palpable/core/files/byte_reader.hpp"

#include <algorithm>
#include <utility>

namespace palpable::sources {
namespace {

constexpr std::uint16_t kOrientationTag = 0x0112;
constexpr std::uint16_t kExifTag = 0x8769;
constexpr std::uint16_t kFocalLength35Tag = 0xA405;
constexpr std::uint16_t kShort = 3;

std::optional<std::endian> tiff_order(std::span<const std::byte> tiff) {
  if (has_magic(tiff, std::string_view("II*\0", 4))) return std::endian::little;
  if (has_magic(tiff, std::string_view("MM\0*", 4))) return std::endian::big;
  return std::nullopt;
}

std::span<const std::byte> exif_of_jpeg(std::span<const std::byte> jpeg) {
  std::span<const std::byte> found;
  visit_jpeg_segments(jpeg, [&found](int marker, std::span<const std::byte> content) {
    if (found.empty() && marker == 0xE1 && has_magic(content, std::string_view("Exif\0\0", 6)))
      found = content.subspan(6);
  });
  return found;
}

/// PNG: length, name, content, checksum; the block may come after the pixels.
std::span<const std::byte> exif_of_png(std::span<const std::byte> png) {
  ByteReader reader(png, std::endian::big);
  reader.skip(8);
  while (reader.ok() && reader.left() > 0) {
    const std::uint32_t length = reader.u32();
    const auto name = reader.bytes(4);
    const auto content = reader.bytes(length);
    reader.skip(4);
    if (reader.ok() && as_text(name) == "eXIf") return content;
  }
  return {};
}

/// WebP: RIFF chunks, name, length, content, padded to even.
std::span<const std::byte> exif_of_webp(std::span<const std::byte> webp) {
  ByteReader reader(webp);
  reader.skip(12);
  while (reader.ok() && reader.left() > 0) {
    const auto name = reader.bytes(4);
    const std::uint32_t length = reader.u32();
    auto content = reader.bytes(length);
    if (reader.ok() && as_text(name) == "EXIF") {
      if (has_magic(content, std::string_view("Exif\0\0", 6))) content = content.subspan(6);
      return content;
    }
    if (length % 2 == 1) reader.skip(1);
  }
  return {};
}

std::span<const std::byte> exif_of(std::span<const std::byte> file) {
  if (has_magic(file, "\xFF\xD8")) return exif_of_jpeg(file);
  if (has_magic(file, "\x89PNG")) return exif_of_png(file);
  if (has_magic(file, "RIFF")) return exif_of_webp(file);
  return file;
}

}  // namespace

std::uint32_t visit_first_ifd(std::span<const std::byte> tiff,
                              const std::function<void(const IfdEntry&)>& visit) {
  const auto order = tiff_order(tiff);
  if (!order) return 0;
  ByteReader reader(tiff, *order);
  reader.skip(4);
  const std::uint32_t first = reader.u32();
  return reader.ok() ? visit_ifd(tiff, first, visit) : 0;
}

std::uint32_t visit_ifd(std::span<const std::byte> tiff, std::uint32_t at,
                        const std::function<void(const IfdEntry&)>& visit) {
  const auto order = tiff_order(tiff);
  if (!order) return 0;
  ByteReader reader(tiff, *order);
  reader.seek(at);
  const std::uint16_t count = reader.u16();
  for (std::uint16_t i = 0; i < count && reader.ok(); ++i) {
    IfdEntry entry;
    entry.tag = reader.u16();
    entry.type = reader.u16();
    entry.count = reader.u32();
    if (entry.type == kShort && entry.count == 1) {
      entry.value = reader.u16();
      reader.skip(2);
    } else {
      entry.value = reader.u32();
    }
    if (reader.ok()) visit(entry);
  }
  const std::uint32_t next = reader.u32();
  return reader.ok() ? next : 0;
}

void visit_jpeg_segments(std::span<const std::byte> jpeg,
                         const std::function<void(int marker, std::span<const std::byte> content)>& visit) {
  ByteReader reader(jpeg, std::endian::big);
  if (reader.u16() != 0xFFD8) return;
  while (reader.ok()) {
    int marker = reader.u16();
    while (marker == 0xFFFF && reader.ok()) marker = 0xFF00 | reader.u8();
    constexpr int kStartOfScan = 0xFFDA;
    if (marker < 0xFF01 || marker == kStartOfScan) return;
    const std::uint16_t length = reader.u16();
    if (length < 2) return;
    const auto content = reader.bytes(length - 2U);
    if (reader.ok() && marker >= 0xFFE0 && marker <= 0xFFEF) visit(marker & 0xFF, content);
  }
}

int orientation_of(std::span<const std::byte> file) {
  int orientation = 1;
  visit_first_ifd(exif_of(file), [&orientation](const IfdEntry& entry) {
    if (entry.tag == kOrientationTag && entry.value >= 1 && entry.value <= 8)
      orientation = static_cast<int>(entry.value);
  });
  return orientation;
}

std::optional<double> focal_length_35mm(std::span<const std::byte> file) {
  const auto tiff = exif_of(file);
  std::uint32_t more = 0, focal_length = 0;
  visit_first_ifd(tiff, [&more](const IfdEntry& entry) {
    if (entry.tag == kExifTag) more = entry.value;
  });
  if (more != 0)
    visit_ifd(tiff, more, [&focal_length](const IfdEntry& entry) {
      if (entry.tag == kFocalLength35Tag && entry.type == kShort) focal_length = entry.value;
    });
  return focal_length > 0 ? std::optional<double>(focal_length) : std::nullopt;
}

Image upright(Image image, int orientation) {
  if (orientation < 2 || orientation > 8) return image;
  const bool turned = orientation >= 5;
  Image out;
  out.width = turned ? image.height : image.width;
  out.height = turned ? image.width : image.height;
  out.channels = image.channels;
  out.bits = image.bits;
  out.samples.resize(image.samples.size());
  // The orientation states the sides of the upright picture at which stored rows and columns begin (EXIF 2.3,
  // 4.6.4).
  const bool from_right = orientation == 2 || orientation == 3 || orientation == 6 || orientation == 7;
  const bool from_bottom = orientation == 3 || orientation == 4 || orientation == 7 || orientation == 8;
  float* to = out.samples.data();
  for (int y = 0; y < out.height; ++y) {
    for (int x = 0; x < out.width; ++x, to += out.channels) {
      const int across = from_right ? out.width - 1 - x : x;
      const int down = from_bottom ? out.height - 1 - y : y;
      const float* from = turned ? image.pixel(down, across) : image.pixel(across, down);
      std::copy_n(from, out.channels, to);
    }
  }
  return out;
}

}  // namespace palpable::sources
