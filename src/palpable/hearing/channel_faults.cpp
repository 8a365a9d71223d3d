// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/hearing/channel_faults.hpp"

#include <algorithm>
#include <string>

namespace palpable::hearing {

Result<void> check_channels(const Sound& sound) {
  const auto is_silent = [](const std::vector<float>& channel) {
    return std::ranges::all_of(channel, [](float sample) { return sample == 0.0F; });
  };
  const auto& channels = sound.channels;
  if (std::ranges::all_of(channels, is_silent)) return {};
  for (std::size_t k = 0; k < channels.size(); ++k) {
    if (is_silent(channels[k])) return invalid_input("has no sound in channel " + std::to_string(k + 1));
    for (std::size_t other = 0; other < k; ++other)
      if (channels[other] == channels[k])
        return invalid_input("has the same sound in channels " + std::to_string(other + 1) + " and " +
                             std::to_string(k + 1) + ", which are then not of two microphones");
  }
  return {};
}

}  // namespace palpable::hearing
