// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
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

}  // namespace palpable::sources
