// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// Our own readers of photographs: EXIF orientation, depth inside a JPEG, and two pictures in one file. The
// first byte selects a layout.
#include "palpable/sources/picture/exif.hpp"
#include "palpable/sources/picture/photo_depth.hpp"
#include "palpable/sources/stereo/stereo_file.hpp"

#include <cstdint>
#include <cstdlib>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  namespace sources = palpable::sources;
  if (size == 0) return 0;
  const auto file = std::as_bytes(std::span(data + 1, size - 1));
  const int orientation = sources::orientation_of(file);
  if (orientation < 1 || orientation > 8) std::abort();
  static_cast<void>(sources::is_stereo_jpeg(file));
  static_cast<void>(sources::depth_in_jpeg(file));
  constexpr int kLayouts = static_cast<int>(sources::StereoLayout::over_under_crossed) + 1;
  const auto pair = sources::decode_stereo(file, static_cast<sources::StereoLayout>(data[0] % kLayouts));
  if (pair && pair->left.samples.size() != pair->right.samples.size()) std::abort();
  return 0;
}
