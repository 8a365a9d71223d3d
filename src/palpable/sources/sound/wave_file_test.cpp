// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sources/sound/wave_file.hpp"

#include "palpable/core/files/byte_writer.hpp"
#include "palpable/sources/sound/microphones_file.hpp"

#include <bit>
#include <limits>

#include <gtest/gtest.h>

namespace palpable::sources {
namespace {

struct WavePart {
  unsigned tag = 1, channels = 2, bits = 16;
  std::uint32_t rate_hz = 16'000;
  /// Of the data, if it is not what follows.
  std::uint32_t stated_size = 0;
  bool is_extensible = false;
};

std::vector<std::byte> wave_of(const WavePart& part, const ByteWriter& data) {
  ByteWriter file;
  file.text("RIFF");
  file.u32(0);
  file.text("WAVE");
  // A chunk of an odd size, which is skipped.
  file.text("note");
  file.u32(3);
  file.text("abc");
  file.u8(0);
  file.text("fmt ");
  file.u32(part.is_extensible ? 40 : 16);
  file.u16(static_cast<std::uint16_t>(part.is_extensible ? 0xFFFE : part.tag));
  file.u16(static_cast<std::uint16_t>(part.channels));
  file.u32(part.rate_hz);
  file.u32(0);
  file.u16(static_cast<std::uint16_t>(part.channels * part.bits / 8));
  file.u16(static_cast<std::uint16_t>(part.bits));
  if (part.is_extensible) {
    file.u64(0);
    file.u16(static_cast<std::uint16_t>(part.tag));
    for (int n = 0; n < 14; ++n) file.u8(0);
  }
  file.text("data");
  file.u32(part.stated_size > 0 ? part.stated_size : static_cast<std::uint32_t>(data.bytes().size()));
  std::vector<std::byte> out(file.bytes().begin(), file.bytes().end());
  out.insert(out.end(), data.bytes().begin(), data.bytes().end());
  return out;
}

TEST(WaveFile, SixteenBitsAreReadChannelByChannel) {
  ByteWriter data;
  for (const int value : {0, 16384, -32768, 32767, 1, -1}) data.u16(static_cast<std::uint16_t>(value));
  const auto sound = decode_wave(wave_of({}, data));
  ASSERT_TRUE(sound) << sound.error().message;
  EXPECT_EQ(sound->rate_hz, 16'000.0);
  EXPECT_EQ(sound->channels[0], (std::vector<float>{0.0F, -1.0F, 1.0F / 32768.0F}));
  EXPECT_EQ(sound->channels[1], (std::vector<float>{0.5F, 32767.0F / 32768.0F, -1.0F / 32768.0F}));
}

TEST(WaveFile, OtherCodingsGiveTheSameValues) {
  for (const bool is_extensible : {false, true}) {
    ByteWriter bytes, three, four, floats, doubles;
    bytes.u8(192), bytes.u8(64);
    for (const int high : {0x40, 0xC0}) three.u16(0), three.u8(static_cast<std::uint8_t>(high));
    four.u32(0x40000000), four.u32(0xC0000000);
    floats.u32(std::bit_cast<std::uint32_t>(0.5F)), floats.u32(std::bit_cast<std::uint32_t>(-0.5F));
    doubles.f64(0.5), doubles.f64(-0.5);
    const std::pair<WavePart, const ByteWriter&> codings[] = {{{1, 1, 8}, bytes},
                                                              {{1, 1, 24}, three},
                                                              {{1, 1, 32}, four},
                                                              {{3, 1, 32}, floats},
                                                              {{3, 1, 64}, doubles}};
    for (auto [part, data] : codings) {
      part.is_extensible = is_extensible;
      const auto sound = decode_wave(wave_of(part, data));
      ASSERT_TRUE(sound) << part.tag << ", " << part.bits;
      EXPECT_EQ(sound->channels[0], (std::vector<float>{0.5F, -0.5F})) << part.tag << ", " << part.bits;
    }
  }
}

TEST(WaveFile, WhatARecorderLeftUnfinishedIsRead) {
  ByteWriter data;
  for (int n = 0; n < 7; ++n) data.u16(16384);
  EXPECT_EQ(decode_wave(wave_of({.stated_size = 0xFFFFFFFF}, data))->length(), 3U);
}

TEST(WaveFile, DamageIsRefused) {
  ByteWriter data, endless;
  data.u32(0);
  endless.u32(std::bit_cast<std::uint32_t>(std::numeric_limits<float>::infinity()));
  const auto good = wave_of({}, data);
  EXPECT_TRUE(decode_wave(good));
  EXPECT_FALSE(decode_wave(std::span(good).first(good.size() - 1)));
  for (std::size_t size = 0; size < good.size() - 3; ++size)
    EXPECT_FALSE(decode_wave(std::span(good).first(size))) << size;
  EXPECT_FALSE(decode_wave(wave_of({.channels = 0}, data)));
  EXPECT_FALSE(decode_wave(wave_of({.channels = 65}, data)));
  EXPECT_FALSE(decode_wave(wave_of({.bits = 12}, data)));
  EXPECT_FALSE(decode_wave(wave_of({.tag = 2}, data)));
  EXPECT_FALSE(decode_wave(wave_of({.rate_hz = 0}, data)));
  EXPECT_FALSE(decode_wave(wave_of({.tag = 3, .channels = 1, .bits = 32}, endless)));
}

TEST(MicrophonesFile, GivesPlacesInTheCamerasAxes) {
  const auto array = decode_microphones(
      R"({"microphones_m": [[0.1, 0.2, 0.3]], "frame": "robot", "speed_of_sound_m_per_s": 340})");
  ASSERT_TRUE(array);
  EXPECT_EQ(array->positions_m[0].v, (Vec3{-0.2, -0.3, 0.1})) << "left is -x, up is -y, ahead is z";
  EXPECT_EQ(array->speed_of_sound_m_per_s, 340.0);
  EXPECT_EQ(decode_microphones(R"({"microphones_m": [[0.1, 0.2, 0.3]]})")->positions_m[0].v,
            (Vec3{0.1, 0.2, 0.3}));
  for (const char* wrong : {"", "[]", "{}", R"({"microphones_m": []})", R"({"microphones_m": [[1, 2]]})",
                            R"({"microphones_m": [[1, 2, "3"]]})", R"({"microphones_m": [[1, 2, 1e999]]})",
                            R"({"microphones_m": [[1, 2, 3]], "frame": "world"})",
                            R"({"microphones_m": [[1, 2, 3]], "frame": 7})",
                            R"({"microphones_m": [[1, 2, 3]], "speed_of_sound_m_per_s": "fast"})"})
    EXPECT_FALSE(decode_microphones(wrong)) << wrong;
}

}  // namespace
}  // namespace palpable::sources
