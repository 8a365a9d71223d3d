// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/frame.hpp"
#include "palpable/study/world/room.hpp"

#include <vector>

namespace palpable::study {

/// An empty room to a sound: a box whose walls, floor and ceiling all reflect this share of a sound's
/// pressure, the same at all frequencies. 0: no room at all.
struct RoomEcho {
  Vec3 size_m{5.0, 4.0, 2.5};
  double reflection = 0.0;
  double speed_of_sound_m_per_s = 343.2;
};

/// The sound's way from one place to another, with all reflections that arrive within `length_s`, by image
/// sources (Allen & Berkley 1979), each delayed to a fraction of a sample by a windowed sinc (Peterson 1986).
/// Begins kEchoLead samples before the sound leaves. 1 m of free way has the gain 1. The places are in the
/// room's world frame, at least 1 cm apart, and within the room.
std::vector<float> impulse_response(const RoomEcho& room, Point<WorldFrame> from, Point<WorldFrame> to,
                                    double rate_hz, double length_s);
inline constexpr int kEchoLead = 16;

/// The reflection with which the energy that is left of an impulse (Schroeder 1965) falls by 60 dB in this
/// time: of a line from -5 to -35 dB, between these places. 0 < reverberation_s <= 2.
double reflection_for(const RoomEcho& room, Point<WorldFrame> from, Point<WorldFrame> to,
                      double reverberation_s);

}  // namespace palpable::study
