// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/frame.hpp"
#include "palpable/core/result.hpp"
#include "palpable/session/robot/near_depth.hpp"

#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <vector>

namespace palpable::session {

struct SweepOptions {
  /// How far the camera goes to either side of where it was first, m; 0.005 ... 0.1.
  double half_m = 0.03;
  /// Its greatest speed, m/s; 0.005 ... 0.1.
  double speed_m_per_s = 0.03;
  /// How fast commands grow; they fall at once.
  double growth_m_per_s2 = 0.1;
  /// Places at which it stands for a picture; 3 ... 9, odd.
  int places = 5;
  /// Beyond its way, or beside it, by more: it is stopped.
  double margin_m = 0.01;
  /// A pose that is older makes the command zero, s.
  double lost_s = 0.25;
};

/// Errors: usage for a value out of its range.
Result<void> check(const SweepOptions& options);

/// Moves a wrist camera sideways (along the y axis of the robot's frame) by velocity commands, lets it stand
/// for a picture at each of some places, and brings it back. It never leaves its way by more than a margin,
/// counted from where it was when it was first moved, and gives up when the arm does not do what it is told.
/// An arm that a lost connection left beyond that is only led back. Times are of any steady clock, in
/// seconds; stamps of the robot's clock. One thread; no clock, thread or connection of its own.
class WristSweep {
 public:
  explicit WristSweep(const SweepOptions& options) : options_(options) {}

  using Pose = Transform<WorldFrame, CameraFrame>;
  /// base_from_camera, as the arm measures it; nullopt: no stamp.
  void take_pose(double t_s, const Pose& pose, std::optional<double> stamp_s);
  void take_picture(double t_s, Image picture, std::optional<double> stamp_s);

  /// Begins a sweep. False without a pose that is new.
  bool begin(double t_s);
  /// Ends it where it is.
  void cancel() { stage_ = Stage::idle; }
  bool is_active() const { return stage_ != Stage::idle; }
  /// In a sweep, and for ten seconds after it: it is told to stand, and a failure says if it does not.
  bool is_watched(double t_s) const { return t_s < watched_until_s_; }
  /// The camera's speed to the left, m/s; call it at least ten times a second. `may_move`: a person wants it
  /// to, and nothing is lost; otherwise it waits, for ten seconds at most. 0 if there is no sweep.
  double command(double t_s, bool may_move);
  /// Once, all pictures of a sweep, from right to left: the camera may still be on its way back.
  std::optional<std::vector<WristPicture>> take_pictures();
  /// Once, why a sweep was given up: "The arm …".
  std::optional<std::string> take_failure();

 private:
  enum class Stage : std::uint8_t { idle, moving, standing, returning };
  struct Measured {
    double t_s;
    Pose pose;
    std::optional<double> stamp_s;
  };

  double left_m() const;
  double target_m() const;
  bool stands() const;
  Pose standing_pose() const;
  std::optional<std::string> fault(double t_s);
  bool moves_unasked(double t_s);
  void give_up(std::string sentence);
  double towards_target(double t_s);

  SweepOptions options_;
  Stage stage_ = Stage::idle;
  /// Of the last quarter of a second.
  std::deque<Measured> poses_;
  /// Where it was first; where it was last while it was watched.
  std::optional<Pose> home_, left_at_;
  /// How far from home sideways it may be.
  double farthest_m_ = 0.0;
  int place_ = 0;
  std::vector<WristPicture> taken_;
  std::optional<std::vector<WristPicture>> done_;
  std::optional<std::string> failure_;
  double command_m_per_s_ = 0.0, commanded_at_s_ = 0.0;
  /// Since when it was told to stand at a place, and the first pose of those since which it does.
  double standing_since_s_ = 0.0;
  std::optional<Measured> still_since_;
  /// When it was last allowed to move; when, and where, it last obeyed.
  double allowed_at_s_ = 0.0, obeyed_at_s_ = 0.0, obeyed_at_m_ = 0.0;
  /// When it was last told to move, and where it stood 1.5 s after that.
  double told_at_s_ = 0.0, stood_at_m_ = 0.0;
  double watched_until_s_ = 0.0;
  bool said_unasked_ = false;
};

}  // namespace palpable::session
