// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/session/robot/robot_ears.hpp"
#include "palpable/session/touch/notices.hpp"
#include "palpable/session/touch/sound_pull.hpp"
#include "palpable/sources/live/rosbridge_client.hpp"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

namespace palpable::session {

class TouchSession;

/// What a robot's ears hear, in the touched picture: a mark, and a faint pull to it. listen() by the robot's
/// thread, mark(), guide() and notice() by the feed's. Headings are counter-clockwise from above, in radians.
class RobotHearing {
 public:
  struct Options {
    bool marks = true;
    bool pulls = false;
    /// How far below the horizontal the camera looks whose picture is touched.
    double camera_down_rad = 0.0;
    /// Places of the topics in the client's list.
    std::size_t sound = 0, sound_format = 0;
  };
  /// `ears`: nullopt if there are no microphones; nothing is heard then.
  RobotHearing(std::optional<RobotEars> ears, const Options& options);

  bool marks() const { return marks_; }
  bool pulls() const { return pulls_; }
  /// Takes the sound that came.
  void listen(sources::RosbridgeClient& client, double t_s, double heading_rad);
  /// As LiveSource::mark_sound().
  void mark(Raster<std::uint8_t>& labels, std::uint8_t label, const Pinhole& camera, double t_s,
            double heading_rad) const;
  /// As LiveSource::guide(). `camera`: of the touched picture, in which the mark is; nullopt: there is none.
  std::shared_ptr<const models::RouteGuide> guide(const models::Scene& scene, const TouchSession& session,
                                                  const std::optional<Pinhole>& camera, double t_s,
                                                  double heading_rad);
  std::optional<std::string> notice();
  std::uint64_t sounds() const;

 private:
  std::optional<double> azimuth_rad(double t_s, double heading_rad) const;

  Options options_;
  bool marks_, pulls_;
  /// The feed's thread's own.
  SoundPull pull_;
  Notices notices_;
  mutable std::mutex mutex_;
  std::optional<RobotEars> ears_;
  std::uint64_t sounds_ = 0;
};

}  // namespace palpable::session
