// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/describe/sound_words.hpp"

#include <array>
#include <cmath>

namespace palpable::describe {

std::string sound_words(double azimuth_deg, std::optional<double> elevation_deg) {
  constexpr std::array kEighths{"ahead",  "ahead, to the right", "to the right", "behind, to the right",
                                "behind", "behind, to the left", "to the left",  "ahead, to the left"};
  constexpr double kSteep_deg = 30.0, kOverhead_deg = 75.0;
  if (elevation_deg && std::abs(*elevation_deg) > kOverhead_deg)
    return *elevation_deg > 0.0 ? "above" : "below";
  const long eighth = std::lround(azimuth_deg / 45.0);
  std::string words = kEighths[static_cast<std::size_t>((eighth % 8 + 8) % 8)];
  if (elevation_deg && std::abs(*elevation_deg) > kSteep_deg)
    words += *elevation_deg > 0.0 ? " and above" : " and below";
  return words;
}

}  // namespace palpable::describe
