// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sources/live/frame_size.hpp"

#include "palpable/core/picture/image.hpp"

#include <string>

namespace palpable::sources {

Error too_many_pixels(std::uint64_t pixels) {
  return invalid_input("has " + std::to_string(pixels) + " pixels; a frame of a live source has at most " +
                       std::to_string(kMostFramePixels));
}

Result<void> check_frame_size(int width, int height) {
  if (auto possible = check_picture_size(width, height); !possible) return possible;
  const auto pixels = static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height);
  if (pixels > kMostFramePixels) return too_many_pixels(pixels);
  return {};
}

}  // namespace palpable::sources
