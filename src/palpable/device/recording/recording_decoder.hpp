// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/device/recording/recording.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace palpable::device {

/// A chunk of a recording: its kind and its content.
struct RecordingChunk {
  std::uint32_t kind = 0;
  std::span<const std::byte> payload;
};

/// Decodes the chunks after the header, in order, into ticks and scenes. Chunks that describe the following
/// ticks are kept for them.
class RecordingDecoder {
 public:
  /// Appends the content of `chunk` to `recording`. False if the chunk does not have the structure of its
  /// kind.
  bool take(const RecordingChunk& chunk, Recording& recording);

 private:
  struct Fade {
    std::uint64_t tick = 0;
    std::uint32_t coming_scene_id = 0;
  };
  bool take_ticks(const RecordingChunk& chunk, std::vector<TouchSample>& ticks);
  void add_fade(TouchSample& tick);

  std::vector<std::byte> turns_;
  std::vector<Fade> fades_;
  std::size_t next_fade_ = 0;
  std::uint32_t coming_scene_id_ = 0;
};

}  // namespace palpable::device
