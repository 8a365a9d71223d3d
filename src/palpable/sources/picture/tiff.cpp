// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/core/files/byte_reader.hpp"
#include "palpable/sources/picture/decoders.hpp"

#include <algorithm>
#include <array>
#include <cstdarg>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <tiffio.h>

namespace palpable::sources {
namespace {

struct Source {
  std::span<const std::byte> file;
  std::size_t position = 0;
  std::array<char, 200> message{};
};

Source& source_of(thandle_t handle) { return *static_cast<Source*>(handle); }

tmsize_t read_some(thandle_t handle, void* out, tmsize_t count) {
  Source& source = source_of(handle);
  const std::size_t left = source.file.size() - std::min(source.position, source.file.size());
  const std::size_t n = std::min(left, static_cast<std::size_t>(std::max<tmsize_t>(count, 0)));
  if (n > 0) std::memcpy(out, source.file.data() + source.position, n);
  source.position += n;
  return static_cast<tmsize_t>(n);
}

tmsize_t write_none(thandle_t, void*, tmsize_t) { return -1; }

toff_t seek_to(thandle_t handle, toff_t offset, int whence) {
  Source& source = source_of(handle);
  const std::size_t from = whence == SEEK_CUR ? source.position : whence == SEEK_END ? source.file.size() : 0;
  source.position = from + static_cast<std::size_t>(offset);
  return source.position;
}

int close_nothing(thandle_t) { return 0; }
toff_t size_of(thandle_t handle) { return source_of(handle).file.size(); }

int keep_message(TIFF*, void* user, const char*, const char* format, va_list arguments) {
  auto* source = static_cast<Source*>(user);
  if (source->message[0] == '\0')
    std::vsnprintf(source->message.data(), source->message.size(), format, arguments);
  return 1;
}

int ignore_warning(TIFF*, void*, const char*, const char*, va_list) { return 1; }

struct Closer {
  void operator()(TIFF* tiff) const { TIFFClose(tiff); }
};
using Handle = std::unique_ptr<TIFF, Closer>;

Handle open(Source& source) {
  const std::unique_ptr<TIFFOpenOptions, void (*)(TIFFOpenOptions*)> options(TIFFOpenOptionsAlloc(),
                                                                             TIFFOpenOptionsFree);
  constexpr tmsize_t kMaxBlockBytes = tmsize_t{1} << 30;
  TIFFOpenOptionsSetMaxSingleMemAlloc(options.get(), kMaxBlockBytes);
  TIFFOpenOptionsSetErrorHandlerExtR(options.get(), keep_message, &source);
  TIFFOpenOptionsSetWarningHandlerExtR(options.get(), ignore_warning, &source);
  return Handle(TIFFClientOpenExt("picture", "rm", &source, read_some, write_none, seek_to, close_nothing,
                                  size_of, nullptr, nullptr, options.get()));
}

template <class T>
T field(TIFF* tiff, std::uint32_t tag, T otherwise) {
  T value{};
  return TIFFGetFieldDefaulted(tiff, tag, &value) == 1 ? value : otherwise;
}

struct Layout {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  int channels = 1;
  int bits = 8;
  bool floats = false;
  bool white_is_zero = false;
  bool planes_apart = false;
};

/// The layouts that are read sample by sample; nullopt for those left to libtiff's own RGBA conversion.
std::optional<Layout> plain_layout(TIFF* tiff) {
  Layout layout;
  layout.width = field<std::uint32_t>(tiff, TIFFTAG_IMAGEWIDTH, 0);
  layout.height = field<std::uint32_t>(tiff, TIFFTAG_IMAGELENGTH, 0);
  layout.channels = field<std::uint16_t>(tiff, TIFFTAG_SAMPLESPERPIXEL, 1);
  layout.bits = field<std::uint16_t>(tiff, TIFFTAG_BITSPERSAMPLE, 1);
  layout.planes_apart =
      field<std::uint16_t>(tiff, TIFFTAG_PLANARCONFIG, PLANARCONFIG_CONTIG) == PLANARCONFIG_SEPARATE;
  const auto kind = field<std::uint16_t>(tiff, TIFFTAG_SAMPLEFORMAT, SAMPLEFORMAT_UINT);
  const auto meaning = field<std::uint16_t>(tiff, TIFFTAG_PHOTOMETRIC, PHOTOMETRIC_MINISBLACK);
  layout.floats = kind == SAMPLEFORMAT_IEEEFP;
  layout.white_is_zero = meaning == PHOTOMETRIC_MINISWHITE;
  const bool grey = meaning == PHOTOMETRIC_MINISBLACK || layout.white_is_zero;
  const bool known_samples = layout.floats
                                 ? layout.bits == 32
                                 : kind == SAMPLEFORMAT_UINT && (layout.bits == 8 || layout.bits == 16);
  const bool known_channels = (grey && layout.channels >= 1 && layout.channels <= 2) ||
                              (meaning == PHOTOMETRIC_RGB && layout.channels >= 3 && layout.channels <= 4);
  if (!known_samples || !known_channels) return std::nullopt;
  return layout;
}

/// Turns samples of a picture whose zero is white into those of one whose zero is black.
template <class T>
void invert(std::span<std::byte> samples, T white) {
  for (std::size_t at = 0; at + sizeof(T) <= samples.size(); at += sizeof(T)) {
    T value{};
    std::memcpy(&value, samples.data() + at, sizeof value);
    value = static_cast<T>(white - value);
    std::memcpy(samples.data() + at, &value, sizeof value);
  }
}

void invert(const Layout& layout, std::span<std::byte> samples) {
  if (layout.floats)
    invert(samples, 1.0F);
  else if (layout.bits == 16)
    invert(samples, std::numeric_limits<std::uint16_t>::max());
  else
    invert(samples, std::numeric_limits<std::uint8_t>::max());
}

/// One strip or tile and its position in the picture.
struct Block {
  std::uint32_t left, top, width, height;
  int channel;
};

/// Copies a decoded block into the picture, without the part outside the picture (a tile's padding).
void place_block(std::span<const std::byte> raw, const Block& block, const Layout& layout,
                 StoredImage& image) {
  const auto sample_bytes = static_cast<std::size_t>(layout.bits / 8);
  const auto channels = static_cast<std::size_t>(layout.channels);
  const std::size_t step = layout.planes_apart ? 1 : channels;
  const std::uint32_t columns = std::min(block.width, layout.width - block.left);
  const std::uint32_t rows = std::min(block.height, layout.height - block.top);
  for (std::size_t y = 0; y < rows; ++y) {
    const std::byte* from = raw.data() + y * block.width * step * sample_bytes;
    const std::size_t first = ((block.top + y) * layout.width + block.left) * channels;
    if (!layout.planes_apart) {
      std::memcpy(image.samples.data() + first * sample_bytes, from, columns * step * sample_bytes);
      continue;
    }
    const std::size_t plane = first + static_cast<std::size_t>(block.channel);
    for (std::size_t x = 0; x < columns; ++x)
      std::memcpy(image.samples.data() + (plane + x * channels) * sample_bytes, from + x * sample_bytes,
                  sample_bytes);
  }
}

bool read_tiles(TIFF* tiff, const Layout& layout, StoredImage& image) {
  const auto width = field<std::uint32_t>(tiff, TIFFTAG_TILEWIDTH, 0);
  const auto height = field<std::uint32_t>(tiff, TIFFTAG_TILELENGTH, 0);
  const tmsize_t bytes = TIFFTileSize(tiff);
  const std::size_t step = layout.planes_apart ? 1 : static_cast<std::size_t>(layout.channels);
  const std::size_t needed = std::size_t{width} * height * step * static_cast<std::size_t>(layout.bits / 8);
  if (width == 0 || height == 0 || bytes <= 0 || static_cast<std::size_t>(bytes) < needed ||
      !check_picture_size(width, height))
    return false;
  std::vector<std::byte> raw(static_cast<std::size_t>(bytes));
  for (int channel = 0; channel < (layout.planes_apart ? layout.channels : 1); ++channel)
    for (std::uint32_t top = 0; top < layout.height; top += height)
      for (std::uint32_t left = 0; left < layout.width; left += width) {
        if (TIFFReadTile(tiff, raw.data(), left, top, 0, static_cast<std::uint16_t>(channel)) < 0)
          return false;
        place_block(raw, {left, top, width, height, channel}, layout, image);
      }
  return true;
}

/// Calls `use(channel, y, samples)` for each row of strips, until it returns false.
template <class Use>
bool for_each_row(TIFF* tiff, const Layout& layout, const Use& use) {
  const tmsize_t bytes = TIFFScanlineSize(tiff);
  const std::size_t step = layout.planes_apart ? 1 : static_cast<std::size_t>(layout.channels);
  const std::size_t needed = layout.width * step * static_cast<std::size_t>(layout.bits / 8);
  if (bytes <= 0 || static_cast<std::size_t>(bytes) < needed) return false;
  std::vector<std::byte> raw(static_cast<std::size_t>(bytes));
  for (int channel = 0; channel < (layout.planes_apart ? layout.channels : 1); ++channel)
    for (std::uint32_t y = 0; y < layout.height; ++y) {
      if (TIFFReadScanline(tiff, raw.data(), y, static_cast<std::uint16_t>(channel)) < 0) return false;
      if (!use(channel, y, std::span(raw).first(needed))) return false;
    }
  return true;
}

bool read_rows(TIFF* tiff, const Layout& layout, StoredImage& image) {
  return for_each_row(tiff, layout, [&](int channel, std::uint32_t y, std::span<const std::byte> row) {
    place_block(row, {0, y, layout.width, 1, channel}, layout, image);
    return true;
  });
}

/// Rows in their order need not be kept.
bool pass_rows(TIFF* tiff, const Layout& layout, SampleSink& sink) {
  return for_each_row(tiff, layout, [&](int, std::uint32_t, std::span<std::byte> row) {
    if (layout.white_is_zero) invert(layout, row);
    return sink.put(row);
  });
}

/// Reads all other layouts by libtiff's conversion to 8-bit RGBA.
bool read_converted(TIFF* tiff, StoredImage& image) {
  std::vector<std::uint32_t> rgba(static_cast<std::size_t>(image.width) *
                                  static_cast<std::size_t>(image.height));
  // The orientation is applied by the caller, as for every other format.
  TIFFSetField(tiff, TIFFTAG_ORIENTATION, ORIENTATION_TOPLEFT);
  constexpr int kStopOnError = 1;
  if (TIFFReadRGBAImageOriented(tiff, static_cast<std::uint32_t>(image.width),
                                static_cast<std::uint32_t>(image.height), rgba.data(), ORIENTATION_TOPLEFT,
                                kStopOnError) != 1)
    return false;
  image.channels = 4;
  image.bits = 8;
  image.samples.reserve(4 * rgba.size());
  for (const std::uint32_t p : rgba)
    for (const std::uint32_t v : {TIFFGetR(p), TIFFGetG(p), TIFFGetB(p), TIFFGetA(p)})
      image.samples.push_back(static_cast<std::byte>(v));
  return true;
}

bool read_plain(TIFF* tiff, const Layout& layout, StoredImage& image) {
  image.samples.resize(static_cast<std::size_t>(layout.width) * layout.height *
                       static_cast<std::size_t>(layout.channels * (layout.bits / 8)));
  const bool read = TIFFIsTiled(tiff) != 0 ? read_tiles(tiff, layout, image) : read_rows(tiff, layout, image);
  if (read && layout.white_is_zero) invert(layout, image.samples);
  return read;
}

/// Reads the picture into the sink; false if it is damaged, or not taken.
bool read_into(TIFF* tiff, StoredImage image, SampleSink& sink) {
  const auto layout = plain_layout(tiff);
  if (layout) {
    image.channels = layout->channels;
    image.bits = layout->bits;
    if (TIFFIsTiled(tiff) == 0 && !layout->planes_apart)
      return sink.begin(image) && pass_rows(tiff, *layout, sink);
  }
  if (!(layout ? read_plain(tiff, *layout, image) : read_converted(tiff, image))) return false;
  return sink.begin(image) && sink.put(image.samples);
}

}  // namespace

Result<void> decode_tiff(std::span<const std::byte> file, SampleSink& sink) {
  Source source{file, 0, {}};
  const auto damaged = [&source](std::string_view otherwise) {
    const std::string_view why = source.message.data();
    return invalid_input("is a TIFF picture that is damaged, cut off or of an unknown kind (" +
                         std::string(why.empty() ? otherwise : why) + ")");
  };
  const Handle tiff = open(source);
  if (!tiff) return damaged("it has no directory");
  const auto width = field<std::uint32_t>(tiff.get(), TIFFTAG_IMAGEWIDTH, 0);
  const auto height = field<std::uint32_t>(tiff.get(), TIFFTAG_IMAGELENGTH, 0);
  if (width == 0 || height == 0) return damaged("its directory states no width or no height");
  if (auto size = check_picture_size(width, height); !size) return std::move(size).error();
  if (!read_into(tiff.get(), {static_cast<int>(width), static_cast<int>(height), 1, 8, {}}, sink))
    return damaged("its rows or tiles are smaller than its size");
  return {};
}

}  // namespace palpable::sources
