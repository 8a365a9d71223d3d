// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/core/files/byte_reader.hpp"
#include "palpable/sources/sound/microphones_file.hpp"
#include "palpable/sources/sound/wave_file.hpp"

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <span>

// A recording that can be read has samples, all finite, as many in each channel; microphones have finite
// places.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto file = std::as_bytes(std::span(data, size));
  if (const auto sound = palpable::sources::decode_wave(file)) {
    if (sound->length() == 0 || !(sound->rate_hz > 0.0)) std::abort();
    for (const auto& channel : sound->channels) {
      if (channel.size() != sound->length()) std::abort();
      for (const float sample : channel)
        if (!std::isfinite(sample)) std::abort();
    }
  }
  if (const auto array = palpable::sources::decode_microphones(palpable::as_text(file)))
    for (const auto& place : array->positions_m)
      if (!is_finite(place.v)) std::abort();
  return 0;
}
