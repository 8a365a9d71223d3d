// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace palpable::sources {

/// A picture with its samples as an external library decodes them: a quarter or half of the memory of an
/// Image, which the decoder process does not need to make.
struct StoredImage {
  int width = 0;
  int height = 0;
  /// 1 (grey), 2 (grey + alpha), 3 (RGB) or 4 (RGBA), interleaved.
  int channels = 0;
  /// 8 or 16: unsigned integers, of which the largest is 1; 32: floats.
  int bits = 8;
  /// In the byte order of this machine, row-major, origin at the top left.
  std::vector<std::byte> samples;
};

/// Receives a picture's samples in their order, as they are decoded, so that they are never kept as a whole.
class SampleSink {
 public:
  SampleSink() = default;
  virtual ~SampleSink() = default;
  SampleSink(const SampleSink&) = delete;
  SampleSink& operator=(const SampleSink&) = delete;

  /// Once, before the samples, with an image that has none yet. False: not taken, and the decoder ends.
  virtual bool begin(const StoredImage& head) = 0;
  /// The next samples. False: not taken, and the decoder ends.
  virtual bool put(std::span<const std::byte> samples) = 0;
};

}  // namespace palpable::sources
