// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/session/make/camera_poses.hpp"

#include <cmath>
#include <cstdint>
#include <cstdlib>

// Any text gives poses that are rotations and finite positions, or an error.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto poses = palpable::session::parse_camera_poses({reinterpret_cast<const char*>(data), size});
  if (!poses) {
    if (poses.error().message.empty()) std::abort();
    return 0;
  }
  if (poses->empty()) std::abort();
  for (const auto& [frame, pose] : *poses) {
    if (!is_finite(pose.translation_m)) std::abort();
    // Each column of a rotation has the length 1.
    for (std::size_t k = 0; k < 3; ++k) {
      const auto& r = pose.rotation;
      const double length = r[k] * r[k] + r[k + 3] * r[k + 3] + r[k + 6] * r[k + 6];
      if (!(std::abs(length - 1.0) < 1e-9)) std::abort();
    }
  }
  return 0;
}
