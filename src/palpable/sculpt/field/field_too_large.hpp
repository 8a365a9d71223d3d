// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/result.hpp"

#include <cmath>
#include <cstddef>
#include <string>
#include <string_view>

namespace palpable::sculpt {

/// Refuses a field that would take more memory than is allowed; with its size, and how many cells would fit.
/// `kind` is what it would be, "a field".
inline Error field_too_large(std::string_view kind, double needed_bytes, std::size_t most_bytes,
                             int resolution, int fits) {
  constexpr double kMebi = 1024.0 * 1024.0;
  return {ErrorCode::failed,
          "would take about " + std::to_string(std::lround(needed_bytes / kMebi)) + " MiB as " +
              std::string(kind) + " of " + std::to_string(resolution) + " cells, more than the " +
              std::to_string(most_bytes >> 20U) + " MiB that are allowed; " + std::to_string(fits) +
              " cells would fit",
          {}};
}

}  // namespace palpable::sculpt
