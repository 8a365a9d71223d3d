// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/sound/microphones.hpp"
#include "palpable/core/sound/sound.hpp"
#include "palpable/study/world/room_echo.hpp"

#include <cstdint>
#include <optional>
#include <vector>

namespace palpable::study {

enum class TestSound : std::uint8_t {
  /// Voiced syllables through three formants, with hisses between them.
  speech,
  /// Noise whose power falls by 3 dB an octave, for the whole time.
  noise,
  /// Three claps.
  claps
};

/// A sound of this length, 10 ms faded in and out; its root mean square is 1. The same seed gives the same
/// sound.
std::vector<float> test_sound(TestSound kind, double rate_hz, double length_s, std::uint64_t seed);

/// Four microphones on the corners of a regular tetrahedron.
Microphones tetrahedral_array(double radius_m);

enum class Background : std::uint8_t {
  /// White noise of each channel's own.
  of_channels,
  /// Noise from all directions alike: 64 far sources, -3 dB an octave.
  from_everywhere
};

struct SoundSceneOptions {
  Microphones microphones = square_array(0.1);
  double rate_hz = 16'000.0;
  /// 0: no room.
  double reverberation_s = 0.0;
  /// The sound with its reverberation, while it lasts, against the background.
  double snr_db = 10.0;
  Background background = Background::of_channels;
  /// false: the background alone.
  bool has_sound = true;
  double lead_s = 1.0, sound_s = 1.5, tail_s = 0.5;
};

/// A recording with its truth.
struct SoundScene {
  Sound sound;
  RoomEcho room;
  /// Of the direct way, from the array's middle: degrees, as hearing::Bearing; absent without a sound.
  std::optional<double> azimuth_deg, elevation_deg;
  double distance_m = 0.0;
  double begin_s = 0.0, end_s = 0.0;
};

/// A sound in a room of 4 to 8 by 3.5 to 6 by 2.4 to 3.2 m: speech, noise or claps, 0.3 to 1.9 m high and,
/// where the room lets it, 0.8 to 3.5 m from the array, which is 0.6 to 1.1 m high, at least 0.5 m from the
/// walls and turned at random. The same seed gives the same room and sound on every machine.
SoundScene make_sound_scene(std::uint64_t seed, const SoundSceneOptions& options = {});

}  // namespace palpable::study
