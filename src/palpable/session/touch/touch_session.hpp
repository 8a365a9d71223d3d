// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/result.hpp"
#include "palpable/device/device.hpp"
#include "palpable/haptics/servo/servo_loop.hpp"
#include "palpable/models/scene/scene.hpp"
#include "palpable/session/touch/touch_settings.hpp"
#include "palpable/session/touch/touch_statistics.hpp"
#include "palpable/session/touch/walk.hpp"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace palpable::session {

struct SessionOptions {
  haptics::ServoOptions servo;
  /// Written into recordings, and given to a simulated hand that names none itself.
  std::uint64_t seed = 1;
  /// Written into recordings: "shi", "park", … when a paper's parameters were chosen.
  std::string as_published;
  /// Written into recordings: "palpable 0.1.0", and the command line as it was given.
  std::string made_by = "palpable";
  std::vector<std::string> command;
  /// Records from the first tick on; empty = start_recording() may begin one later.
  std::filesystem::path recording;
  /// Probes beside the hand, moved by move_pointer(); at most haptics::kMaxLiveProbes - 1.
  std::size_t further_probes = 0;
};

/// One touch: a scene, felt by one law, through one device. Any thread may call any method; none of them
/// makes the servo wait. Ending it, in any way, leaves the device at zero force.
class TouchSession {
 public:
  /// Opens the device (device/drivers/open.hpp) and starts the servo. `begin_ns` is CLOCK_MONOTONIC when the
  /// person asked for the touch: seconds_to_first_force counts from it; 0 = now. Errors: device (cannot be
  /// opened), usage (a law, parameter or URL that does not exist), failed (the recording cannot be created).
  static Result<std::unique_ptr<TouchSession>> open(std::shared_ptr<const models::Scene> scene,
                                                    const TouchSettings& settings,
                                                    const std::string& device_url,
                                                    const SessionOptions& options, std::int64_t begin_ns = 0);
  ~TouchSession();
  TouchSession(const TouchSession&) = delete;
  TouchSession& operator=(const TouchSession&) = delete;

  /// Swapped live, forces cross-faded; on an error everything stays as it was.
  Result<void> change_scene(std::shared_ptr<const models::Scene> scene);
  Result<void> change_settings(const TouchSettings& settings);
  /// Both at once; the scene's model stays, and so does its place under the hand. Errors: usage for materials
  /// that are out of range or not one for each label of the scene.
  Result<void> change_materials(std::vector<models::Material> materials, const TouchSettings& settings);
  std::shared_ptr<const models::Scene> scene() const;
  TouchSettings settings() const;
  /// Another than the settings' where the scene or the device has no such law.
  haptics::Law law_in_use() const;
  /// What was changed by the device's limits and why, one sentence each: "Stiffness 800 N/m was lowered to
  /// 412 N/m: …". Empty when nothing was.
  std::vector<std::string> notices() const;

  void pause();
  void resume();
  bool paused() const;
  /// Places the scene so that the hand is at its middle, level with its highest point.
  void recentre();
  /// The egocentric frame of reference: from now on the device's middle stands and turns with an explorer;
  /// its height and scale stay. So they do in a changed scene. Forces cross-fade; recordings note the new
  /// place. Errors: as change_settings().
  Result<void> stand(const Stance& stance);
  void stop();

  /// How many probes there can be at once, the hand's (probe 0) among them.
  std::size_t probes() const;
  /// Moves the hand where the device is `pointer:` (others ignore it), or a further probe whatever the device
  /// is. Scene frame, so that the page need not know the device's. Send at least ten a second, also while the
  /// pointer rests: silence for half a second counts as a lost source and ramps the force down. A probe that
  /// there is not is ignored.
  void move_pointer(Point<SceneFrame> position, std::size_t probe = 0);
  /// Takes a probe away until it is moved again; its force ramps to zero.
  void lift_pointer(std::size_t probe);

  /// The newest tick of a probe, less than probes(). Before the first, its status is not_ready.
  haptics::TouchSample latest(std::size_t probe = 0) const;
  /// Everything since the last call, in order. For one listener, which should call several times a second:
  /// the ring holds 1024, and what finds it full is lost.
  std::vector<haptics::TouchEvent> take_events();
  /// Deadlines missed since the last call, each with its cause; likewise.
  std::vector<haptics::MissedDeadline> take_missed();
  /// Why the recording under way cannot be written any further, once; the touch goes on.
  std::optional<Error> take_recording_fault();

  /// From here on: SessionOptions::recording records the touch's beginning too, so that all of it can be
  /// recomputed. Errors: the file cannot be written; recording already.
  Result<void> start_recording(const std::filesystem::path& file);
  /// Ends the file; errors met while writing come here.
  Result<void> stop_recording();
  bool recording() const;

  TouchStatistics statistics() const;
  const device::Traits& device_traits() const;
  /// Empty while the device works.
  std::string device_fault() const;

 private:
  struct Impl;
  explicit TouchSession(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace palpable::session
