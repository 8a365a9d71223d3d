// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sources/depth/depth_picture.hpp"

#include <cmath>
#include <cstdint>
#include <cstdlib>

// Any text gives settings with finite scales, or an error.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  const auto settings = palpable::sources::decode_depth_settings(text);
  if (!settings && settings.error().message.empty()) std::abort();
  if (settings && settings->metres_per_unit && !std::isfinite(*settings->metres_per_unit)) std::abort();
  return 0;
}
