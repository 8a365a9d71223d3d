// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

namespace palpable {

/// Samples of several channels that were taken at the same instants. Full scale is -1 to 1.
struct Sound {
  /// Samples a second; > 0.
  double rate_hz = 16'000.0;
  /// All of one length.
  std::vector<std::vector<float>> channels;

  std::size_t length() const { return channels.empty() ? 0 : channels.front().size(); }
  double duration_s() const { return static_cast<double>(length()) / rate_hz; }
};

}  // namespace palpable
