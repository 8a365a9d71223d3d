// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/result.hpp"
#include "palpable/core/work.hpp"
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
  /// Written to recordings, and used for a simulated hand whose URL has no seed.
  std::uint64_t seed = 1;
  /// Written to recordings: "shi", "park", ... if the parameters of a paper were chosen.
  std::string as_published;
  /// Written to recordings: "palpable 0.1.0", and the command line as given.
  std::string made_by = "palpable";
  std::vector<std::string> command;
  /// File in which the touch is recorded from the first tick; empty = none.
  std::filesystem::path recording;
  /// Preparing a scene (haptic_scene.hpp) takes seconds for a large relief and a ball.
  Work work;
  /// Number of probes besides the hand, moved by move_pointer(); at most haptics::kMaxLiveProbes - 1.
  std::size_t further_probes = 0;
};

/// One touch: a scene, a law and a device. Any thread may call any method; no method makes the servo wait.
/// However it ends, the device is left at zero force.
class TouchSession {
 public:
  /// Opens the device (device/drivers/open.hpp) and starts the servo. `begin_ns` is CLOCK_MONOTONIC at the
  /// user's request, from which seconds_to_first_force counts; 0 = now. Errors: device (cannot be opened),
  /// usage (an unknown law, parameter or URL), failed (the recording cannot be created).
  static Result<std::unique_ptr<TouchSession>> open(std::shared_ptr<const models::Scene> scene,
                                                    const TouchSettings& settings,
                                                    const std::string& device_url,
                                                    const SessionOptions& options, std::int64_t begin_ns = 0);
  ~TouchSession();
  TouchSession(const TouchSession&) = delete;
  TouchSession& operator=(const TouchSession&) = delete;

  /// Changes the scene, or the settings, during the touch; the forces are cross-faded. After an error nothing
  /// has changed.
  Result<void> change_scene(std::shared_ptr<const models::Scene> scene);
  Result<void> change_settings(const TouchSettings& settings);
  /// Changes materials and settings together; the model and its placement stay. Errors: usage for materials
  /// that are out of range, or not one for each label of the scene.
  Result<void> change_materials(std::vector<models::Material> materials, const TouchSettings& settings);
  std::shared_ptr<const models::Scene> scene() const;
  /// The id that samples have of the scene that was handed over last.
  std::uint32_t newest_scene_id() const;
  TouchSettings settings() const;
  /// Differs from the settings if the scene or the device does not support that law.
  haptics::Law law_in_use() const;
  /// Radius of the touching ball in use, metres: lower than in the settings if the scene has no room for
  /// that.
  double radius_in_use_m() const;
  /// What the device's limits changed and why, one sentence each: "Stiffness 800 N/m was lowered to 412 N/m:
  /// …". Empty if nothing was changed.
  std::vector<std::string> notices() const;

  void pause();
  void resume();
  bool paused() const;
  /// Moves the scene so that the hand is at its centre, at the height of its highest point.
  void recentre();
  /// The egocentric frame of reference: from now on the centre of the device's workspace moves and turns with
  /// an explorer; its height and scale do not change. This also holds for later scenes. Forces are
  /// cross-faded, and recordings contain the new placement. Errors: as change_settings().
  Result<void> move_explorer(const ExplorerPose& pose);
  void stop();

  /// Greatest number of simultaneous probes, including the hand (probe 0).
  std::size_t probes() const;
  /// Moves the hand if the device is `pointer:` (other devices ignore it), or a further probe with any
  /// device. The position is in the scene frame, so that the page need not know the device frame. Call it at
  /// least ten times a second, also while the pointer rests: after half a second without a call the source
  /// counts as lost, and the force ramps to zero. Unknown probes are ignored.
  void move_pointer(Point<SceneFrame> position, std::size_t probe = 0);
  /// Removes a probe until it is moved again; its force ramps to zero.
  void lift_pointer(std::size_t probe);

  /// The newest tick of a probe, which must be less than probes(). Before the first tick its status is
  /// not_ready.
  haptics::TouchSample latest(std::size_t probe = 0) const;
  /// All events since the last call, in order. For one reader, which should call it several times a second:
  /// the ring holds 1024 events, and further ones are lost.
  std::vector<haptics::TouchEvent> take_events();
  /// Deadlines missed since the last call, each with its cause; also for one reader.
  std::vector<haptics::MissedDeadline> take_missed();
  /// The reason why the current recording cannot be continued, returned once; the touch continues.
  std::optional<Error> take_recording_fault();

  /// Ends the recording; errors of any earlier write are returned here.
  Result<void> stop_recording();

  TouchStatistics statistics() const;
  const device::Traits& device_traits() const;
  /// Empty while the device works.
  std::string device_fault() const;
  /// What the person does next so that the device becomes ready, once for each such step; empty if nothing is
  /// new. For one reader.
  std::string take_guidance();

 private:
  struct Impl;
  explicit TouchSession(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace palpable::session
