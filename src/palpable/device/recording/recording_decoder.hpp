// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/device/recording/recording.hpp"

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <vector>

namespace palpable::device {

/// A chunk of a recording: its kind and its content.
struct RecordingChunk {
  std::uint32_t kind = 0;
  std::span<const std::byte> payload;
};

/// Decodes the chunks after the header, in order, into ticks and scenes. Chunks that describe the following
/// ticks are kept for them. This is the one place that decides which times a recording may have: all times
/// and periods are finite, periods are not negative, and the hand's times increase.
class RecordingDecoder {
 public:
  /// Appends the content of `chunk` to `recording`. False if the chunk does not have the structure of its
  /// kind, or for times as above, which wrong_times() then describes.
  bool take(const RecordingChunk& chunk, Recording& recording);
  /// "times that do not increase at tick 70"; empty if the times are right.
  const std::string& wrong_times() const { return wrong_times_; }

 private:
  struct Fade {
    std::uint64_t tick = 0;
    std::uint32_t coming_scene_id = 0;
  };
  bool take_ticks(const RecordingChunk& chunk, std::vector<TouchSample>& ticks);
  void add_fade(TouchSample& tick);
  bool is_in_time(const TouchSample& tick, bool of_hand);

  std::vector<std::byte> turns_;
  std::vector<Fade> fades_;
  std::size_t next_fade_ = 0;
  std::uint32_t coming_scene_id_ = 0;
  /// Of the hand's last tick.
  double before_s_ = -std::numeric_limits<double>::infinity();
  std::string wrong_times_;
};

}  // namespace palpable::device
