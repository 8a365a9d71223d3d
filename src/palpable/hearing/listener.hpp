// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/sound/sound.hpp"
#include "palpable/hearing/array_shape.hpp"
#include "palpable/hearing/sound_weights.hpp"

#include <memory>
#include <optional>
#include <vector>

namespace palpable::hearing {

struct ListenerOptions {
  /// One spectrum; rounded to a power of two of samples. Each overlaps half of the one before.
  double frame_s = 0.032;
  /// A direction is found in this time, and anew after each half of it.
  double window_s = 0.5;
  /// The band that is listened to; its upper end is at most 0.45 of the rate.
  double low_hz = 300.0;
  double high_hz = 7'000.0;
  /// Below this confidence there is no direction.
  double least_confidence = 0.12;
  /// Nor below this level in the band, dB of full scale (a sine of full scale is -3).
  double least_level_db = -80.0;
  SoundWeightOptions weights;
};

/// What was heard in one window.
struct HeardWindow {
  double begin_s = 0.0, end_s = 0.0;
  /// Towards the sound; absent for silence, noise without a direction, and, with an array in a level plane, a
  /// sound from above or below.
  std::optional<Vector<CameraFrame>> direction;
  /// How much more alike the channels are after the delays of this direction than after those of a mean one:
  /// 0 to 1. 1 is a single source without noise or echo.
  double confidence = 0.0;
  double level_db = 0.0;
  /// Power in the band that all channels share after these delays, and that they do not share (noise, echo).
  double shared_power = 0.0, other_power = 0.0;
};

/// The direction of sounds by SRP-PHAT (DiBiase 2000): cross spectra of the pairs of microphones, of unit
/// magnitude in each bin (the phase transform of Knapp & Carter 1976) but for its weight (SoundWeights),
/// summed over a window, and the direction of the greatest steered response (SteeredResponse). One thread.
class Listener {
 public:
  /// Errors: invalid_input, as geometry_of(); a rate outside of 8 to 192 kHz.
  static Result<Listener> create(const Microphones& microphones, double rate_hz,
                                 const ListenerOptions& options = {});
  Listener(Listener&&) noexcept;
  Listener& operator=(Listener&&) noexcept;
  ~Listener();

  const ArrayGeometry& geometry() const;
  /// The next samples, one channel for each microphone; returns the windows that ended. Samples that are not
  /// finite count as zero.
  std::vector<HeardWindow> take(const Sound& next);
  /// The end of the recording: the window that it cuts off, if there is one, which may be shorter than half.
  std::optional<HeardWindow> finish();

 private:
  struct Impl;
  explicit Listener(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace palpable::hearing
