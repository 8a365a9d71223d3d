// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sources/sound/wave_file.hpp"

#include "palpable/core/files/byte_reader.hpp"
#include "palpable/core/files/read_file.hpp"
#include "palpable/core/text/plain_text.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>

#include <fmt/format.h>

namespace palpable::sources {
namespace {

enum class Coding : std::uint8_t { unsigned_8, signed_16, signed_24, signed_32, float_32, float_64 };

struct WaveFormat {
  Coding coding = Coding::signed_16;
  std::size_t channels = 0, sample_bytes = 0;
  double rate_hz = 0.0;
};

constexpr std::size_t kMostChannels = 64;

std::optional<Coding> coding_of(unsigned tag, unsigned bits) {
  constexpr unsigned kPcm = 1, kFloat = 3;
  if (tag == kPcm && bits == 8) return Coding::unsigned_8;
  if (tag == kPcm && bits == 16) return Coding::signed_16;
  if (tag == kPcm && bits == 24) return Coding::signed_24;
  if (tag == kPcm && bits == 32) return Coding::signed_32;
  if (tag == kFloat && bits == 32) return Coding::float_32;
  if (tag == kFloat && bits == 64) return Coding::float_64;
  return std::nullopt;
}

/// The chunk "fmt ".
Result<WaveFormat> format_from(std::span<const std::byte> chunk) {
  ByteReader reader(chunk);
  unsigned tag = reader.u16();
  WaveFormat format;
  format.channels = reader.u16();
  const std::uint32_t rate_hz = reader.u32();
  reader.skip(4);
  const std::size_t block_bytes = reader.u16();
  const unsigned bits = reader.u16();
  if (!reader.ok()) return invalid_input("has no whole format chunk");
  constexpr unsigned kExtensible = 0xFFFE;
  if (tag == kExtensible) {
    // The size, the valid bits and the places of the loudspeakers stand before the tag proper.
    reader.skip(8);
    tag = reader.u16();
    if (!reader.ok()) return invalid_input("has no whole format chunk");
  }
  const auto coding = coding_of(tag, bits);
  if (!coding)
    return invalid_input(fmt::format(
        "is coded in format {} with {} bits; PCM of 8, 16, 24 or 32 bits and floats of 32 or 64 are read",
        tag, bits));
  if (format.channels < 1 || format.channels > kMostChannels)
    return invalid_input(fmt::format("has {} channels; 1 to {} are read", format.channels, kMostChannels));
  constexpr std::uint32_t kMostRate_hz = 1'000'000;
  if (rate_hz < 1 || rate_hz > kMostRate_hz)
    return invalid_input(fmt::format("states {} samples a second", rate_hz));
  format.coding = *coding;
  format.sample_bytes = bits / 8;
  format.rate_hz = rate_hz;
  if (block_bytes != format.channels * format.sample_bytes)
    return invalid_input("states a size of its blocks that is not that of its channels");
  return format;
}

float sample_from(ByteReader& reader, Coding coding) {
  switch (coding) {
    case Coding::unsigned_8:
      return (static_cast<float>(reader.u8()) - 128.0F) / 128.0F;
    case Coding::signed_16:
      return static_cast<float>(static_cast<std::int16_t>(reader.u16())) / 32768.0F;
    case Coding::signed_24: {
      const std::uint32_t low = reader.u16(), high = reader.u8();
      return static_cast<float>(static_cast<std::int32_t>((high << 24U) | (low << 8U))) / 2147483648.0F;
    }
    case Coding::signed_32:
      return static_cast<float>(static_cast<std::int32_t>(reader.u32())) / 2147483648.0F;
    case Coding::float_32:
      return reader.f32();
    case Coding::float_64:
      break;
  }
  // Beyond what a float holds would be undefined.
  const double wide = reader.f64();
  return std::abs(wide) < 1e30 ? static_cast<float>(wide) : NAN;
}

Result<Sound> sound_from(const WaveFormat& format, std::span<const std::byte> data) {
  const std::size_t length = data.size() / (format.channels * format.sample_bytes);
  if (length == 0) return invalid_input("has no samples");
  Sound sound{format.rate_hz, {format.channels, std::vector<float>(length)}};
  ByteReader reader(data);
  bool is_finite = true;
  for (std::size_t i = 0; i < length; ++i)
    for (auto& channel : sound.channels) {
      channel[i] = sample_from(reader, format.coding);
      is_finite = is_finite && std::isfinite(channel[i]);
    }
  if (!is_finite) return invalid_input("has samples that are not finite");
  return sound;
}

}  // namespace

Result<Sound> decode_wave(std::span<const std::byte> file) {
  const bool is_long = has_magic(file, "RF64");
  if (!(has_magic(file, "RIFF") || is_long) || !has_magic(file, "WAVE", 8))
    return invalid_input("is no WAV file");
  ByteReader reader(file);
  reader.skip(12);
  std::optional<WaveFormat> format;
  while (reader.left() >= 8) {
    const std::string_view name = as_text(reader.bytes(4));
    const std::size_t size = reader.u32();
    // RF64 states the size of long data elsewhere, and a recorder that writes as it records does not know it:
    // they reach to the end of the file then.
    constexpr std::size_t kUnknownSize = 0x7FFFFF00;
    if (size > reader.left() && size < kUnknownSize)
      return invalid_input(fmt::format("ends too early: {} of {} bytes of its part \"{}\" are there",
                                       reader.left(), size, plain_name(name)));
    const auto chunk = reader.bytes(std::min(size, reader.left()));
    if (name == "fmt ") {
      auto read = format_from(chunk);
      if (!read) return std::move(read).error();
      format = *read;
    }
    if (name == "data")
      return format ? sound_from(*format, chunk)
                    : Result<Sound>(invalid_input("has no format before its data"));
    // Chunks begin at even places.
    if (size % 2 == 1 && reader.left() > 0) reader.skip(1);
  }
  return invalid_input("has no data");
}

Result<Sound> read_wave(const std::filesystem::path& path) {
  const auto file = read_file(path);
  if (!file) return file.error();
  auto sound = decode_wave(*file);
  if (!sound) sound.error().place = path.string();
  return sound;
}

}  // namespace palpable::sources
