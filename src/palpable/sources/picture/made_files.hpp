// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

// For tests only: files as cameras write them, made according to their specifications.
namespace palpable::sources {

inline std::string big_endian(std::uint32_t value, int bytes) {
  std::string text;
  for (int i = bytes - 1; i >= 0; --i) text += static_cast<char>((value >> (8 * i)) & 0xFFU);
  return text;
}

/// A JPEG with a segment put behind its first marker.
inline std::string with_segment(const std::string& picture, char marker, const std::string& content) {
  return picture.substr(0, 2) + '\xFF' + marker +
         big_endian(static_cast<std::uint32_t>(content.size() + 2), 2) + content + picture.substr(2);
}

/// A multi-picture file as CIPA DC-007 lays it out: the index in the first picture, the second behind it.
inline std::string mpo(const std::string& first, const std::string& second, std::uint32_t kind) {
  const auto index = [&](std::uint32_t first_size, std::uint32_t second_at) {
    std::string block = std::string("MM\0*", 4) + big_endian(8, 4) + big_endian(3, 2);
    block += big_endian(0xB000, 2) + big_endian(7, 2) + big_endian(4, 4) + "0100";
    block += big_endian(0xB001, 2) + big_endian(4, 2) + big_endian(1, 4) + big_endian(2, 4);
    block += big_endian(0xB002, 2) + big_endian(7, 2) + big_endian(32, 4) + big_endian(50, 4);
    block += big_endian(0, 4);
    block += big_endian(kind, 4) + big_endian(first_size, 4) + big_endian(0, 4) + big_endian(0, 4);
    block += big_endian(kind, 4) + big_endian(static_cast<std::uint32_t>(second.size()), 4) +
             big_endian(second_at, 4) + big_endian(0, 4);
    return std::string("MPF\0", 4) + block;
  };
  const auto size = static_cast<std::uint32_t>(with_segment(first, '\xE2', index(0, 0)).size());
  // The block begins behind the picture's marker, the segment's marker, its length and its name: at 2 + 2 + 2
  // + 4.
  return with_segment(first, '\xE2', index(size, size - 10)) + second;
}

inline std::string jps(const std::string& picture, std::uint32_t descriptor) {
  return with_segment(picture, '\xE3', "_JPSJPS_" + big_endian(4, 2) + big_endian(descriptor, 4));
}

/// The kind of a multi-picture file's entries that are a stereo pair's.
inline constexpr std::uint32_t kDisparity = 0x020002;

inline std::string base64(const std::string& data) {
  constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < data.size(); i += 3) {
    std::uint32_t three = 0;
    for (std::size_t k = 0; k < 3; ++k)
      three = (three << 8U) | (i + k < data.size() ? static_cast<unsigned char>(data[i + k]) : 0U);
    for (std::size_t k = 0; k < 4; ++k)
      text += i + k > data.size() ? '=' : kDigits[(three >> (18 - 6 * k)) & 63U];
  }
  return text;
}

/// An APP1 segment.
inline std::string segment(const std::string& content) {
  const std::size_t length = content.size() + 2;
  return std::string("\xFF\xE1") + static_cast<char>(length >> 8U) + static_cast<char>(length & 0xFFU) +
         content;
}

inline const std::string kXmpName("http://ns.adobe.com/xap/1.0/\0", 29);
inline const std::string kExtendedName("http://ns.adobe.com/xmp/extension/\0", 35);

}  // namespace palpable::sources
