// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/hearing/listener.hpp"

#include <optional>
#include <vector>

namespace palpable::hearing {

/// A sound from one direction.
struct HeardSound {
  double begin_s = 0.0, end_s = 0.0;
  Bearing bearing;
  /// Of its clearest window.
  double confidence = 0.0;
  /// What the channels share after its delays, against all else in its windows: noise, echo, other sounds.
  /// -40 to 40 dB.
  double snr_db = 0.0;
};

struct SoundTrackOptions {
  /// Windows are of one sound if their directions are within this of its own,
  double same_deg = 20.0;
  /// and no more than this lies between them.
  double pause_s = 0.6;
};

/// Joins windows to sounds. Several sounds may go on at once. One thread.
class SoundTracks {
 public:
  explicit SoundTracks(ArrayShape shape, const SoundTrackOptions& options = {})
      : shape_(shape), options_(options) {}

  /// The next window. Returns its sound if it is the first of one.
  std::optional<HeardSound> take(const HeardWindow& window);
  /// The sounds that ended since the last call, in the order of their ends; `all`: also those that go on.
  std::vector<HeardSound> take_ended(bool all);

 private:
  struct Track {
    HeardSound sound;
    /// Sum of the directions, each times its confidence.
    Vec3 sum;
    double shared_power = 0.0, other_power = 0.0;
  };
  void add(Track& track, const HeardWindow& window, Vec3 direction) const;

  ArrayShape shape_;
  SoundTrackOptions options_;
  std::vector<Track> open_;
  std::vector<HeardSound> ended_;
};

}  // namespace palpable::hearing
