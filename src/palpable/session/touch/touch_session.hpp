// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/result.hpp"
#include "palpable/device/device.hpp"
#include "palpable/haptics/servo/servo_loop.hpp"
#include "palpable/models/scene/scene.hpp"
#include "palpable/session/touch/session_options.hpp"
#include "palpable/session/touch/touch_settings.hpp"
#include "palpable/session/touch/touch_statistics.hpp"
#include "palpable/session/touch/walk.hpp"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace palpable::session {

/// One touch: a scene, a law and a device, or several for several hands (device_hand.hpp), each at the whole
/// scene. Any thread may call any method; no method makes a servo wait. However it ends, the devices are left
/// at zero force.
class TouchSession {
 public:
  /// Opens the device (device/drivers/open.hpp) and those of further hands, and starts their servos.
  /// `begin_ns` is CLOCK_MONOTONIC at the user's request, from which seconds_to_first_force counts; 0 = now.
  /// Errors: device (cannot be opened), usage (an unknown law, parameter or URL, devices that exclude each
  /// other), failed (a recording cannot be created).
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
  /// As change_scene(), for another surface of the same place, as the next picture of a camera shows it: the
  /// scene stays where it is for each hand, whatever the new surface's highest point, so that proxy and
  /// friction go on, and the surface moves (haptics::Succession).
  Result<void> change_surface(std::shared_ptr<const models::Scene> scene);
  Result<void> change_settings(const TouchSettings& settings);
  /// Changes materials and settings together; the model and its placement stay. Errors: usage for materials
  /// that are out of range, or not one for each label of the scene.
  Result<void> change_materials(std::vector<models::Material> materials, const TouchSettings& settings);
  /// Changes the way along which the hands are pulled; null: none. The model, its placement and the settings
  /// stay. Errors: usage for a guide that is out of range.
  Result<void> change_guide(std::shared_ptr<const models::RouteGuide> guide);
  std::shared_ptr<const models::Scene> scene() const;
  /// The id that samples have of the scene that was handed over last.
  std::uint32_t newest_scene_id() const;
  TouchSettings settings() const;
  /// The first hand's. Differs from the settings if the scene or the device does not support that law.
  haptics::Law law_in_use() const;
  /// The first hand's radius of the touching ball, metres: lower than in the settings if the scene has no
  /// room for that.
  double radius_in_use_m() const;
  /// What the device's limits changed and why, one sentence each: "Stiffness 800 N/m was lowered to 412 N/m:
  /// …". Empty if nothing was changed. With several hands each begins with the hand's number and device.
  std::vector<std::string> notices() const;

  void pause();
  void resume();
  bool paused() const;
  /// Moves the scene for each hand so that this hand is at its centre, at the height of its highest point.
  void recentre();
  /// The egocentric frame of reference: from now on the centre of the device's workspace moves and turns with
  /// an explorer; its height and scale do not change. This also holds for later scenes. Forces are
  /// cross-faded, and recordings contain the new placement. Errors: as change_settings().
  Result<void> move_explorer(const ExplorerPose& pose);
  /// Ends the touch, and then the recordings: the last recorded tick is the last tick. Errors of any earlier
  /// write are returned here.
  Result<void> stop();

  /// Number of hands, each at a device: probes 0 to hands() - 1.
  std::size_t hands() const;
  /// Greatest number of simultaneous probes, including the hands.
  std::size_t probes() const;
  /// Moves a hand if its device is `pointer:` (other devices ignore it), or a further probe with any device.
  /// The position is in the scene frame, so that the page need not know the device frame. Call it at least
  /// ten times a second, also while the pointer rests: after half a second without a call the source counts
  /// as lost, and the force ramps to zero. Unknown probes are ignored.
  void move_pointer(Point<SceneFrame> position, std::size_t probe = 0);
  /// Removes a probe until it is moved again; its force ramps to zero.
  void lift_pointer(std::size_t probe);

  /// The newest tick of a probe, which must be less than probes(). Before the first tick its status is
  /// not_ready.
  haptics::TouchSample latest(std::size_t probe = 0) const;
  /// All events since the last call, those of a hand in order. For one reader, which should call it several
  /// times a second: the ring holds 1024 events, and further ones are lost.
  std::vector<haptics::TouchEvent> take_events();
  /// Deadlines missed since the last call, each with its cause; also for one reader.
  std::vector<haptics::MissedDeadline> take_missed();
  /// The reason why a recording cannot be continued, returned once; the touch continues.
  std::optional<Error> take_recording_fault();

  /// Those of the first hand; the others' are in TouchStatistics::further_hands.
  TouchStatistics statistics() const;
  /// Of a hand, which must be less than hands().
  const device::Traits& device_traits(std::size_t hand = 0) const;
  const std::string& device_url(std::size_t hand = 0) const;
  /// Where a hand's device is in the scene: its own positions, before clutch and border move them.
  Transform<SceneFrame, DeviceFrame> scene_from_device(std::size_t hand = 0) const;
  /// Empty while the hand's device works.
  std::string device_fault(std::size_t hand = 0) const;
  /// A sentence as it is said of one hand: with several hands it begins with "Hand 2 (Haply 2DIY): ".
  std::string said_of(std::size_t hand, const std::string& sentence) const;
  /// What a hand's user hears of its clutch, of the button that ends the force and of warm motors; empty for
  /// other events.
  std::string event_words(const haptics::TouchEvent& event) const;
  /// What the person does next so that a device becomes ready, once for each such step; empty if nothing is
  /// new. For one reader.
  std::string take_guidance();

 private:
  struct Impl;
  explicit TouchSession(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace palpable::session
