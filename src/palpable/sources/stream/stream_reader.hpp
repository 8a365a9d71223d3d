// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/result.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

namespace palpable::sources::stream {

/// A picture of a stream; the rows are valid during the call.
struct StreamPicture {
  int width = 0, height = 0;
  std::uint64_t number = 0;
  std::int64_t arrival_ns = 0;
  /// RGB, one byte each, without gaps.
  std::span<const std::byte> rows;
};

/// Who reads a stream.
class StreamTaker {
 public:
  StreamTaker() = default;
  virtual ~StreamTaker() = default;
  StreamTaker(const StreamTaker&) = delete;
  StreamTaker& operator=(const StreamTaker&) = delete;

  virtual void take(const StreamPicture& picture) = 0;
  /// False: the stream is to be closed. Asked several times a second.
  virtual bool is_there() = 0;
};

/// Connects to a network camera and decodes its video with FFmpeg until it ends; returns why it did, as the
/// end of a sentence about the camera. `url`: rtsp://, rtsps:// or https://. A hostile camera may crash it or
/// take it over: only for the process of its own.
std::string read_stream(const std::string& url, bool takes_any_certificate, StreamTaker& taker);

}  // namespace palpable::sources::stream
