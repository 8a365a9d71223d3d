// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// The input is one message of a rosbridge server. What is taken of it becomes depth and colours, or is
// refused.
#include "palpable/core/check.hpp"
#include "palpable/sources/live/frame_folder.hpp"
#include "palpable/sources/live/rosbridge_picture.hpp"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace palpable;
  const auto heard = sources::parse_rosbridge({reinterpret_cast<const char*>(data), size});
  const auto* message = heard ? std::get_if<sources::RosMessage>(&*heard) : nullptr;
  if (message == nullptr) return 0;
  const Pinhole camera{8.0, 8.0, 3.5, 3.5, 8, 8};
  if (const auto depth = sources::depth_of(message->body, camera, std::nullopt)) {
    PALPABLE_CHECK(depth->depth_m.count() > 0 && depth->depth_m.count() <= sources::kMostFramePixels);
    for (const float z : depth->depth_m.values())
      PALPABLE_CHECK(std::isnan(z) || (z > 0.0F && std::isfinite(z)));
  }
  if (const auto colour = sources::colour_of(message->body)) PALPABLE_CHECK(check(*colour).has_value());
  return 0;
}
