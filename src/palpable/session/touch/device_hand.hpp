// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/result.hpp"
#include "palpable/device/local_textures.hpp"
#include "palpable/device/pointer/pointer.hpp"
#include "palpable/device/recording/recording.hpp"
#include "palpable/haptics/servo/reopening_loop.hpp"
#include "palpable/models/scene/scene.hpp"
#include "palpable/session/touch/haptic_scene.hpp"
#include "palpable/session/touch/recorder.hpp"
#include "palpable/session/touch/scene_hash.hpp"
#include "palpable/session/touch/session_options.hpp"
#include "palpable/session/touch/touch_settings.hpp"
#include "palpable/session/touch/touch_statistics.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

namespace palpable::session {

/// What the hands of a touch share when a scene is prepared for them, one after the other.
struct SceneCaches {
  KeptSurfaces kept;
  SceneHashes hashes;
};

/// One hand of a touch: its device with a servo loop of its own, so that no hand waits for another's device.
/// It has its own placement of the scene, limits, watchdog, guardian, reopening and recording. Any thread may
/// call any method but those that say otherwise; none makes the servo wait.
class DeviceHand {
 public:
  struct Begin {
    std::shared_ptr<const models::Scene> scene;
    TouchSettings settings;
    std::string url;
    SessionOptions options;
    /// 0 for the first hand.
    std::size_t number = 0;
    /// The position of `pointer:`, then those of the further probes of this hand's loop.
    std::vector<std::shared_ptr<device::PointerFeed>> pointers;
  };
  /// Opens the device and prepares the scene, without a force. Errors: as TouchSession::open().
  static Result<std::unique_ptr<DeviceHand>> open(const Begin& begin, SceneCaches& caches);
  /// Begins the touch, and its recording, with what open() was called with; once, and before all other
  /// methods. So the hands of a touch begin together, however long each device takes to open. Errors: as
  /// TouchSession::open().
  Result<void> start(const Begin& begin);
  ~DeviceHand();
  DeviceHand(const DeviceHand&) = delete;
  DeviceHand& operator=(const DeviceHand&) = delete;

  /// A scene that is ready to be touched by this hand.
  struct Prepared {
    PreparedScene scene;
    device::RecordedScene description;
    Transform<SceneFrame, DeviceFrame> place;
    /// How far the scene reaches from the middle of the workspace, m, at the device.
    Vec3 reach_m;
  };
  /// Errors: as prepare_scene(). prepare() and apply() are called by one thread at a time.
  Result<Prepared> prepare(const std::shared_ptr<const models::Scene>& scene, const TouchSettings& settings,
                           const Transform<SceneFrame, DeviceFrame>& place, SceneCaches& caches);
  /// Cross-fades to it.
  void apply(Prepared prepared);

  /// The current placement, and that of a new scene.
  Transform<SceneFrame, DeviceFrame> place() const;
  /// The current placement of the device's own positions: clutch and border have moved them in `place()`.
  Transform<SceneFrame, DeviceFrame> place_of_device() const;
  Transform<SceneFrame, DeviceFrame> fitted(const models::Scene& scene) const;
  /// The current placement, moved so that the hand is in the middle of the scene at the height of its highest
  /// point; nullopt if the hand's place is not known.
  std::optional<Transform<SceneFrame, DeviceFrame>> recentred(const models::Scene& scene) const;

  haptics::Law law_in_use() const;
  double radius_in_use_m() const;
  std::vector<std::string> notices() const;
  std::uint32_t newest_scene_id() const;

  haptics::ReopeningLoop& loop() { return *loop_; }
  const haptics::ReopeningLoop& loop() const { return *loop_; }
  const std::string& url() const { return url_; }
  /// The newest tick of a probe of this hand's loop; the hand's own is 0.
  haptics::TouchSample latest(std::size_t probe) const;

  /// Its stop button has ended the force.
  bool is_stopped() const { return workspace_->stopped.load(); }

  /// See TouchSession; stop_recording() after the loop has stopped, else its last ticks are not recorded.
  std::optional<Error> take_recording_fault();
  Result<void> stop_recording();
  std::string take_guidance();
  /// `begin_ns`: CLOCK_MONOTONIC at the user's request.
  TouchStatistics statistics(std::int64_t begin_ns) const;

 private:
  DeviceHand() = default;
  device::RecordedScene described(const PreparedScene& prepared,
                                  const std::shared_ptr<const models::Scene>& touched,
                                  const TouchSettings& asked, SceneCaches& caches) const;
  Result<Prepared> prepared_for(const device::Traits& traits, const std::shared_ptr<const models::Scene>& to,
                                const TouchSettings& settings,
                                const Transform<SceneFrame, DeviceFrame>& place, SceneCaches& caches);
  void take_over(const Prepared& prepared);
  Result<void> record();

  /// What open() keeps for start().
  struct Waiting {
    std::unique_ptr<device::Device> device;
    haptics::HapticScene scene;
  };
  std::optional<Waiting> waiting_;
  SessionOptions options_;
  std::string url_;
  std::int64_t servo_begin_ns_ = 0;
  /// Of a device that renders surfaces itself; else null.
  std::shared_ptr<device::LocalTextures> sent_textures_;
  std::shared_ptr<haptics::WorkspaceState> workspace_ = std::make_shared<haptics::WorkspaceState>();
  std::unique_ptr<haptics::ReopeningLoop> loop_;
  std::uint32_t last_scene_id_ = 0;

  /// Guards what follows.
  mutable std::mutex state_;
  haptics::Law law_in_use_ = haptics::Law::proxy;
  /// Whether any law so far was one with contact.
  bool used_contact_law_ = false;
  double radius_in_use_m_ = 0.0;
  Transform<SceneFrame, DeviceFrame> scene_from_device_;
  std::vector<std::string> notices_;
  device::RecordedScene described_now_;
  mutable std::array<haptics::TouchSample, haptics::kMaxLiveProbes> latest_;
  std::unique_ptr<Recorder> recorder_;
  /// The step that was told last.
  std::string guidance_;
};

}  // namespace palpable::session
