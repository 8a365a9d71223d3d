// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/session/touch/touch_session.hpp"

#include "palpable/device/drivers/open.hpp"
#include "palpable/device/pointer/pointer.hpp"
#include "palpable/haptics/servo/pacing.hpp"
#include "palpable/session/touch/device_hand.hpp"

#include <functional>
#include <mutex>
#include <optional>
#include <utility>

#include <fmt/format.h>

namespace palpable::session {
namespace {

using Place = Transform<SceneFrame, DeviceFrame>;

}  // namespace

/// Two locks, always taken in this order. `changing`: while a scene is prepared, which may take a second.
/// `state`: needed by every caller, for example by the pointer ten times per second; so no code that reads a
/// whole model, writes a file or waits for a thread runs under it.
struct TouchSession::Impl {
  /// The placement of a hand.
  using PlaceOf = std::function<Place(const DeviceHand&)>;
  Result<void> change(std::shared_ptr<const models::Scene> to_scene, const TouchSettings& to_settings,
                      const PlaceOf& to_place,
                      haptics::Succession succession = haptics::Succession::replaces);
  /// Where a probe is computed: a hand, and the probe's number in its loop.
  struct Seat {
    std::size_t hand = 0;
    std::size_t probe = 0;
  };
  /// The loop of the first hand computes the probes without device.
  Seat seat_of(std::size_t probe) const {
    return probe < hands.size() ? Seat{probe, 0} : Seat{0, probe - hands.size() + 1};
  }
  std::size_t probe_of(Seat seat) const {
    return seat.probe == 0 ? seat.hand : hands.size() - 1 + seat.probe;
  }

  std::int64_t begin_ns = 0;
  std::optional<int> clutch_button;
  std::optional<int> stop_button;
  /// Passes the positions from the page of `pointer:` and of the probes without device.
  std::vector<std::shared_ptr<device::PointerFeed>> pointers;
  std::vector<std::unique_ptr<DeviceHand>> hands;

  std::mutex changing;
  /// Read and written under `changing`.
  SceneCaches caches;
  /// Pose of the explorer, under `changing`; nullopt in the exocentric frame.
  std::optional<ExplorerPose> pose;

  mutable std::mutex state;
  std::shared_ptr<const models::Scene> scene;
  TouchSettings settings;
  bool paused = false;
};

Result<void> TouchSession::Impl::change(std::shared_ptr<const models::Scene> to_scene,
                                        const TouchSettings& to_settings, const PlaceOf& to_place,
                                        haptics::Succession succession) {
  // First for all, so that an error leaves every hand as it was.
  std::vector<DeviceHand::Prepared> prepared;
  for (const auto& hand : hands) {
    auto one = hand->prepare(to_scene, to_settings, to_place(*hand), caches);
    if (!one) return std::move(one).error();
    one->scene.scene.succession = succession;
    prepared.push_back(*std::move(one));
  }
  for (std::size_t hand = 0; hand < hands.size(); ++hand) hands[hand]->apply(std::move(prepared[hand]));
  const std::lock_guard lock(state);
  scene = std::move(to_scene);
  settings = to_settings;
  return {};
}

TouchSession::TouchSession(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
TouchSession::~TouchSession() { static_cast<void>(stop()); }

Result<std::unique_ptr<TouchSession>> TouchSession::open(std::shared_ptr<const models::Scene> scene,
                                                         const TouchSettings& settings,
                                                         const std::string& device_url,
                                                         const SessionOptions& options,
                                                         std::int64_t begin_ns) {
  PALPABLE_CHECK(scene != nullptr &&
                 options.further_probes + options.further_devices.size() < haptics::kMaxLiveProbes);
  std::vector<std::string> urls{device_url};
  urls.insert(urls.end(), options.further_devices.begin(), options.further_devices.end());
  if (auto together = device::check_together(urls); !together) return std::move(together).error();
  if (auto valid = haptics::check(options.workspace); !valid) return std::move(valid).error();
  auto impl = std::make_unique<Impl>();
  impl->clutch_button = options.workspace.clutch_button;
  impl->stop_button = options.workspace.stop_button;
  impl->begin_ns = begin_ns != 0 ? begin_ns : haptics::monotonic_ns();
  for (std::size_t probe = 0; probe <= options.further_probes; ++probe)
    impl->pointers.push_back(std::make_shared<device::PointerFeed>());
  std::vector<DeviceHand::Begin> begins;
  for (std::size_t number = 0; number < urls.size(); ++number) {
    auto pointers = number == 0 ? impl->pointers : std::vector{std::make_shared<device::PointerFeed>()};
    begins.push_back({scene, settings, urls[number], options, number, std::move(pointers)});
    auto hand = DeviceHand::open(begins.back(), impl->caches);
    if (!hand) return std::move(hand).error();
    impl->hands.push_back(*std::move(hand));
  }
  for (std::size_t number = 0; number < urls.size(); ++number)
    if (auto started = impl->hands[number]->start(begins[number]); !started)
      return std::move(started).error();
  impl->scene = std::move(scene);
  impl->settings = settings;
  return std::unique_ptr<TouchSession>(new TouchSession(std::move(impl)));
}

Result<void> TouchSession::change_scene(std::shared_ptr<const models::Scene> scene) {
  PALPABLE_CHECK(scene != nullptr);
  const std::lock_guard changing(impl_->changing);
  const auto place = [&](const DeviceHand& hand) {
    const auto fitted = hand.fitted(*scene);
    return impl_->pose ? with_explorer(fitted, *impl_->pose) : fitted;
  };
  return impl_->change(scene, settings(), place);
}

Result<void> TouchSession::change_surface(std::shared_ptr<const models::Scene> scene) {
  PALPABLE_CHECK(scene != nullptr);
  const std::lock_guard changing(impl_->changing);
  return impl_->change(
      std::move(scene), settings(), [](const DeviceHand& hand) { return hand.place(); },
      haptics::Succession::moves);
}

Result<void> TouchSession::change_settings(const TouchSettings& settings) {
  const std::lock_guard changing(impl_->changing);
  return impl_->change(scene(), settings, [](const DeviceHand& hand) { return hand.place(); });
}

Result<void> TouchSession::change_materials(std::vector<models::Material> materials,
                                            const TouchSettings& settings) {
  const std::lock_guard changing(impl_->changing);
  auto changed = with_materials(*scene(), std::move(materials));
  if (!changed) return changed.error();
  return impl_->change(std::make_shared<const models::Scene>(*std::move(changed)), settings,
                       [](const DeviceHand& hand) { return hand.place(); });
}

Result<void> TouchSession::change_guide(std::shared_ptr<const models::RouteGuide> guide) {
  const std::lock_guard changing(impl_->changing);
  auto changed = std::make_shared<models::Scene>(*scene());
  changed->guide = std::move(guide);
  return impl_->change(std::move(changed), settings(), [](const DeviceHand& hand) { return hand.place(); });
}

std::shared_ptr<const models::Scene> TouchSession::scene() const {
  const std::lock_guard lock(impl_->state);
  return impl_->scene;
}

std::uint32_t TouchSession::newest_scene_id() const { return impl_->hands.front()->newest_scene_id(); }

TouchSettings TouchSession::settings() const {
  const std::lock_guard lock(impl_->state);
  return impl_->settings;
}

haptics::Law TouchSession::law_in_use() const { return impl_->hands.front()->law_in_use(); }
double TouchSession::radius_in_use_m() const { return impl_->hands.front()->radius_in_use_m(); }

std::vector<std::string> TouchSession::notices() const {
  std::vector<std::string> all;
  for (std::size_t hand = 0; hand < hands(); ++hand)
    for (const std::string& notice : impl_->hands[hand]->notices()) all.push_back(said_of(hand, notice));
  return all;
}

void TouchSession::pause() {
  const std::lock_guard lock(impl_->state);
  impl_->paused = true;
  for (const auto& hand : impl_->hands) hand->loop().pause();
}

void TouchSession::resume() {
  const std::lock_guard lock(impl_->state);
  impl_->paused = false;
  for (const auto& hand : impl_->hands) hand->loop().resume();
}

bool TouchSession::paused() const {
  const std::lock_guard lock(impl_->state);
  return impl_->paused;
}

void TouchSession::recentre() {
  const std::lock_guard changing(impl_->changing);
  const auto touched = scene();
  // A change that differs only in the placement cannot fail.
  static_cast<void>(impl_->change(touched, settings(), [&](const DeviceHand& hand) {
    return hand.recentred(*touched).value_or(hand.place());
  }));
}

Result<void> TouchSession::move_explorer(const ExplorerPose& pose) {
  const std::lock_guard changing(impl_->changing);
  auto moved = impl_->change(scene(), settings(),
                             [&](const DeviceHand& hand) { return with_explorer(hand.place(), pose); });
  if (moved) impl_->pose = pose;
  return moved;
}

std::size_t TouchSession::hands() const { return impl_->hands.size(); }
std::size_t TouchSession::probes() const { return hands() + impl_->pointers.size() - 1; }

void TouchSession::move_pointer(Point<SceneFrame> position, std::size_t probe) {
  if (!is_finite(position) || probe >= probes()) return;
  const auto seat = impl_->seat_of(probe);
  if (seat.hand == 0) impl_->pointers[seat.probe]->put(impl_->hands.front()->place().inverse() * position);
}

void TouchSession::lift_pointer(std::size_t probe) {
  if (probe >= probes()) return;
  const auto seat = impl_->seat_of(probe);
  if (seat.hand == 0) impl_->pointers[seat.probe]->put(std::nullopt);
}

haptics::TouchSample TouchSession::latest(std::size_t probe) const {
  PALPABLE_CHECK(probe < probes());
  const auto seat = impl_->seat_of(probe);
  auto sample = impl_->hands[seat.hand]->latest(seat.probe);
  sample.probe = static_cast<std::uint8_t>(probe);
  return sample;
}

std::vector<haptics::TouchEvent> TouchSession::take_events() {
  const std::lock_guard lock(impl_->state);
  std::vector<haptics::TouchEvent> events;
  for (std::size_t hand = 0; hand < hands(); ++hand)
    while (auto event = impl_->hands[hand]->loop().take_event()) {
      event->probe = static_cast<std::uint8_t>(impl_->probe_of({hand, event->probe}));
      events.push_back(*event);
    }
  return events;
}

std::vector<haptics::MissedDeadline> TouchSession::take_missed() {
  const std::lock_guard lock(impl_->state);
  std::vector<haptics::MissedDeadline> missed;
  for (const auto& hand : impl_->hands)
    while (const auto one = hand->loop().take_missed()) missed.push_back(*one);
  return missed;
}

std::optional<Error> TouchSession::take_recording_fault() {
  for (const auto& hand : impl_->hands)
    if (auto fault = hand->take_recording_fault()) return fault;
  return std::nullopt;
}

Result<void> TouchSession::stop() {
  for (const auto& hand : impl_->hands) hand->loop().stop();
  Result<void> outcome;
  for (const auto& hand : impl_->hands)
    if (auto stopped = hand->stop_recording(); outcome && !stopped) outcome = std::move(stopped);
  return outcome;
}

TouchStatistics TouchSession::statistics() const {
  TouchStatistics statistics = impl_->hands.front()->statistics(impl_->begin_ns);
  for (std::size_t hand = 1; hand < hands(); ++hand)
    statistics.further_hands.push_back(impl_->hands[hand]->statistics(impl_->begin_ns));
  return statistics;
}

const device::Traits& TouchSession::device_traits(std::size_t hand) const {
  return impl_->hands.at(hand)->loop().device_traits();
}

const std::string& TouchSession::device_url(std::size_t hand) const { return impl_->hands.at(hand)->url(); }

Transform<SceneFrame, DeviceFrame> TouchSession::scene_from_device(std::size_t hand) const {
  return impl_->hands.at(hand)->place_of_device();
}

std::string TouchSession::device_fault(std::size_t hand) const {
  return impl_->hands.at(hand)->loop().device_fault();
}

std::string TouchSession::said_of(std::size_t hand, const std::string& sentence) const {
  if (hands() == 1) return sentence;
  return fmt::format("Hand {} ({}): {}", hand + 1, device_traits(hand).name, sentence);
}

std::string TouchSession::event_words(const haptics::TouchEvent& event) const {
  using Kind = haptics::TouchEvent::Kind;
  if (event.kind == Kind::motors_warm && event.probe < hands())
    return said_of(event.probe,
                   "The motors are warm: the greatest force is reduced until less force has been used.");
  if (event.kind == Kind::motors_cool && event.probe < hands())
    return said_of(event.probe, "The motors have cooled down: the whole force is back.");
  const bool is_down = event.kind == Kind::button_down;
  if ((!is_down && event.kind != Kind::button_up) || event.probe >= hands()) return {};
  const auto is_of = [&](const std::optional<int>& button) {
    return button && event.value == static_cast<std::uint32_t>(*button);
  };
  if (is_of(impl_->clutch_button))
    return said_of(event.probe,
                   is_down ? "The scene moves with the hand, without force." : "The scene stays.");
  if (!is_of(impl_->stop_button) || !is_down) return {};
  return said_of(event.probe, impl_->hands[event.probe]->is_stopped()
                                  ? "The force is off until the button is pressed again."
                                  : "The force comes back.");
}

std::string TouchSession::take_guidance() {
  for (std::size_t hand = 0; hand < hands(); ++hand)
    if (const std::string step = impl_->hands[hand]->take_guidance(); !step.empty())
      return said_of(hand, step);
  return {};
}

}  // namespace palpable::session
