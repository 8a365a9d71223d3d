// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

// The protocol between Palpable and palpable-stream-decoder, whose only argument is the version. Both
// programs are from the same build, so numbers are as in memory.
namespace palpable::sources::stream {

/// Must change with every change of what is below.
inline constexpr std::string_view kProtocolVersion = "1";

/// A pipe with the request, to its end: '1' if any certificate is taken, else '0', then the address.
inline constexpr int kRequestDescriptor = 3;
/// A pipe for parts, each a header and its bytes. The process ends when nobody reads them.
inline constexpr int kPartsDescriptor = 4;

inline constexpr std::size_t kLongestAddress = 4096;
inline constexpr std::uint64_t kLongestReason = 400;

enum class PartKind : std::uint32_t {
  /// The process has restricted itself; no bytes.
  begun = 1,
  /// A picture: rows of RGB, one byte each, without gaps.
  picture,
  /// Why the stream ended, as the end of a sentence about the camera; the last part.
  ended
};

struct PartHeader {
  PartKind kind = PartKind::begun;
  /// Pixels, of a picture.
  std::int32_t width = 0, height = 0;
  std::uint32_t reserved = 0;
  /// Of a picture, counted from 0 with every picture that was decoded.
  std::uint64_t number = 0;
  /// When its last data came; ns of the monotonic clock.
  std::int64_t arrival_ns = 0;
  std::uint64_t bytes = 0;
};

}  // namespace palpable::sources::stream
