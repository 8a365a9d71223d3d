// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sources/depth/depth_file.hpp"
#include "palpable/sources/picture/picture.hpp"

#include <cstdlib>

// Any bytes give a picture of the stated size, or an error.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto file = std::as_bytes(std::span(data, size));
  const auto image = palpable::sources::decode_picture(file);
  if (image) {
    const std::size_t samples = static_cast<std::size_t>(image->width) *
                                static_cast<std::size_t>(image->height) *
                                static_cast<std::size_t>(image->channels);
    if (image->samples.size() != samples || image->channels < 1 || image->channels > 4) std::abort();
  } else if (image.error().message.empty()) {
    std::abort();
  }
  static_cast<void>(palpable::sources::decode_raster(file));
  return 0;
}
