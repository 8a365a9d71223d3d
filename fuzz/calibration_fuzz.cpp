// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sources/calibration/calibration.hpp"

#include <cmath>
#include <cstdlib>

// Any text gives finite cameras with positive focal lengths, or an error.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto calibration = palpable::sources::decode_calibration(std::as_bytes(std::span(data, size)));
  if (!calibration) return 0;
  if (!std::isfinite(calibration->left.matrix[0]) || calibration->left.matrix[0] <= 0.0) std::abort();
  static_cast<void>(palpable::sources::calibration_for(*calibration, 640, 480));
  return 0;
}
