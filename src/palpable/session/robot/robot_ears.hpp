// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/picture/camera.hpp"
#include "palpable/core/picture/image.hpp"
#include "palpable/core/result.hpp"
#include "palpable/core/sound/microphones.hpp"
#include "palpable/core/sound/sound.hpp"
#include "palpable/hearing/listener.hpp"
#include "palpable/hearing/sound_tracks.hpp"
#include "palpable/models/material/material.hpp"

#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace palpable::session {

/// How samples follow one another in a robot's sound.
struct SoundFormat {
  int channels = 0;
  double rate_hz = 16'000.0;
  /// "S16LE", "S32LE" or "F32LE".
  std::string samples = "S16LE";
};

/// Hears where sounds come from with a robot's microphones (Park & Howard's future work, by SRP-PHAT as
/// hearing::Listener), and remembers the newest one in the robot's surroundings while it turns. One thread.
class RobotEars {
 public:
  /// `microphones`: level, straight ahead of the robot is their z axis. Errors: hearing::geometry_of().
  static Result<RobotEars> create(Microphones microphones, SoundFormat format);

  /// What the robot states of its sound, if it does. Errors (invalid_input, without a place): another number
  /// of channels than there are microphones, a format that is not read.
  Result<void> take_format(const SoundFormat& format);
  /// How the robot stands now: `heading_rad` counter-clockwise from above. Called before take(), and whenever
  /// it may have turned: a direction belongs to when its sound came, half a window and more ago.
  void turn(double now_s, double heading_rad);
  /// The next part of the sound, whose last instant is now; it may end within an instant.
  void take(std::span<const std::byte> part, double now_s);
  /// Once for each sound that is new, or is in another direction from the robot than it was said to be: "A
  /// sound ahead, to the left." And once each for channels that cannot be of microphones of their own, and
  /// for values that are no numbers.
  std::optional<std::string> words();
  /// Where the newest sound comes from, if it was heard within the last kRemembered_s: radians, positive to
  /// the right of the robot as it stands now.
  std::optional<double> azimuth_rad(double now_s, double heading_rad) const;
  std::uint64_t sounds() const { return sounds_; }

  static constexpr double kRemembered_s = 4.0;

 private:
  RobotEars(Microphones microphones, SoundFormat format, hearing::Listener listener);
  void hear(const hearing::HeardWindow& window, double now_s);
  double heading_at(double time_s) const;
  bool is_checked(Sound& sound);

  Microphones microphones_;
  SoundFormat format_;
  hearing::Listener listener_;
  hearing::SoundTracks tracks_;
  /// Bytes of an instant that has not come to its end.
  std::vector<std::byte> rest_;
  /// Seconds that the listener was given.
  double taken_s_ = 0.0;
  struct Heading {
    double time_s, heading_rad;
  };
  std::deque<Heading> headings_;
  /// What came until the channels were checked.
  Sound first_;
  bool are_checked_ = false, are_faulty_ = false, said_numbers_ = false;
  /// Counter-clockwise from above, of odometry's frame.
  std::optional<double> direction_rad_;
  /// From the robot, when it was said.
  std::optional<double> said_rad_;
  double heard_s_ = 0.0, said_s_ = 0.0;
  std::optional<std::string> unsaid_;
  std::uint64_t sounds_ = 0;
};

/// Gives the pixels of a camera that looks in this direction this label: a band of 3 degrees to both sides,
/// since an array of level microphones does not tell how high a sound is. `azimuth_rad`: from straight ahead
/// of the robot, positive to the right; `down_rad`: how far below the horizontal the camera looks. Labels of
/// the camera's size.
void mark_direction(Raster<std::uint8_t>& labels, std::uint8_t label, const Pinhole& camera, double down_rad,
                    double azimuth_rad);

/// What is felt and said where mark_direction() marks.
models::Material sound_material();

}  // namespace palpable::session
