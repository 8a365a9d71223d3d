// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/session/touch/touch_session.hpp"

#include "palpable/device/drivers/open.hpp"
#include "palpable/device/pointer/pointer.hpp"
#include "palpable/device/url.hpp"
#include "palpable/haptics/servo/pacing.hpp"
#include "palpable/haptics/servo/reopening_loop.hpp"
#include "palpable/haptics/servo/start_touch.hpp"
#include "palpable/session/touch/haptic_scene.hpp"
#include "palpable/session/touch/recorded_touch.hpp"
#include "palpable/session/touch/recorder.hpp"
#include "palpable/session/touch/recording_header.hpp"
#include "palpable/session/touch/scene_hash.hpp"
#include "palpable/session/touch/surface_strokes.hpp"

#include <array>
#include <mutex>
#include <optional>
#include <utility>

namespace palpable::session {
namespace {

/// Describes a prepared scene for a recording.
RecordedTouch recorded_touch(const PreparedScene& prepared, const TouchSettings& asked) {
  RecordedTouch touch;
  touch.law = prepared.law;
  touch.asked_for = asked.law;
  touch.height_factor = asked.height_factor;
  touch.transient = prepared.transient;
  touch.materials = prepared.materials;
  touch.scene_from_device = prepared.scene.scene_from_device;
  return touch;
}

}  // namespace

/// Two locks, always taken in this order. `changing`: while a scene is prepared, which may take a second.
/// `state`: needed by every caller, for example by the pointer ten times per second; so no code that reads a
/// whole model, writes a file or waits for a thread runs under it.
struct TouchSession::Impl {
  Result<void> change(std::shared_ptr<const models::Scene> to_scene, const TouchSettings& to_settings,
                      const Transform<SceneFrame, DeviceFrame>& to_place);
  /// Under `changing`.
  device::RecordedScene described(const PreparedScene& prepared,
                                  const std::shared_ptr<const models::Scene>& touched,
                                  const TouchSettings& asked);
  Result<void> record_into(const std::filesystem::path& file);

  SessionOptions options;
  std::string device_url;
  std::int64_t begin_ns = 0;
  std::int64_t servo_begin_ns = 0;
  /// Passes each probe's position from the page, the hand's first.
  std::vector<std::shared_ptr<device::PointerFeed>> pointers;
  std::unique_ptr<haptics::ReopeningLoop> loop;

  std::mutex changing;
  /// Read and written under `changing`.
  KeptSurfaces kept;
  SceneHashes hashes;
  mutable std::mutex state;
  std::shared_ptr<const models::Scene> scene;
  TouchSettings settings;
  haptics::Law law_in_use = haptics::Law::proxy;
  double radius_in_use_m = 0.0;
  Transform<SceneFrame, DeviceFrame> scene_from_device;
  /// Pose of the explorer, under `changing`; nullopt in the exocentric frame.
  std::optional<ExplorerPose> pose;
  std::vector<std::string> notices;
  device::RecordedScene described_now;
  std::uint32_t last_scene_id = 0;
  bool paused = false;
  /// The newest sample of each probe.
  std::array<haptics::TouchSample, haptics::kMaxLiveProbes> latest;
  std::unique_ptr<Recorder> recorder;
  /// The step that was told last.
  std::string guidance;
};

device::RecordedScene TouchSession::Impl::described(const PreparedScene& prepared,
                                                    const std::shared_ptr<const models::Scene>& touched,
                                                    const TouchSettings& asked) {
  RecordedTouch touch = recorded_touch(prepared, asked);
  if (touched->guide != nullptr) touch.guide = *touched->guide;
  touch.hashes = hashes.of(touched);
  touch.inputs = touched->source.inputs;
  touch.method = touched->source.method;
  return {prepared.scene.id, touch_json(touch)};
}

Result<void> TouchSession::Impl::change(std::shared_ptr<const models::Scene> to_scene,
                                        const TouchSettings& to_settings,
                                        const Transform<SceneFrame, DeviceFrame>& to_place) {
  auto prepared = prepare_scene(*to_scene, to_settings, loop->device_traits(), options.servo.rate_hz,
                                to_place, kept, options.work);
  if (!prepared) return std::move(prepared).error();
  prepared->scene.id = ++last_scene_id;
  auto description = described(*prepared, to_scene, to_settings);
  {
    // The recording must know the scene before its first tick.
    const std::lock_guard lock(state);
    if (recorder) recorder->note(description);
  }
  // This reads every page of the model.
  loop->change(std::move(prepared->scene));
  const std::lock_guard lock(state);
  described_now = std::move(description);
  scene = std::move(to_scene);
  settings = to_settings;
  law_in_use = prepared->law.law;
  radius_in_use_m = prepared->law.radius_m.value_or(0.0);
  scene_from_device = to_place;
  notices = std::move(prepared->notices);
  return {};
}

TouchSession::TouchSession(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
TouchSession::~TouchSession() { stop(); }

Result<std::unique_ptr<TouchSession>> TouchSession::open(std::shared_ptr<const models::Scene> scene,
                                                         const TouchSettings& settings,
                                                         const std::string& device_url,
                                                         const SessionOptions& options,
                                                         std::int64_t begin_ns) {
  PALPABLE_CHECK(scene != nullptr && options.further_probes < haptics::kMaxLiveProbes);
  auto impl = std::make_unique<Impl>();
  impl->options = options;
  impl->options.servo.recording =
      options.recording.empty() ? haptics::Recording::off : haptics::Recording::on;
  impl->device_url = device_url;
  impl->begin_ns = begin_ns != 0 ? begin_ns : haptics::monotonic_ns();
  for (auto& sample : impl->latest) sample.status = device::Status::not_ready;
  for (std::size_t probe = 0; probe <= options.further_probes; ++probe)
    impl->pointers.push_back(std::make_shared<device::PointerFeed>());
  device::OpenOptions device_options;
  device_options.seed = options.seed;
  device_options.rate_hz = options.servo.rate_hz;
  device_options.strokes = [&scene](const device::Traits& traits) {
    return strokes_along_solid(*scene, haptics::fit_workspace(*scene, traits));
  };
  device_options.check_header = [](const std::string& header) -> Result<void> {
    const auto session = parse_header(header);
    return session ? Result<void>{} : Result<void>(session.error());
  };
  device_options.pointer = impl->pointers.front();
  auto device = device::open_device(device_url, device_options);
  if (!device) return std::move(device).error();
  if (settings.limits == Limits::off && !device::is_virtual_device(device_url) &&
      !((*device)->traits().max_force_N <= kMostUnlimited_N))
    return Error{ErrorCode::usage,
                 "the limits may be off on simulated devices and on those of at most 4 N only",
                 device::public_url(device_url)};
  const auto place = haptics::fit_workspace(*scene, (*device)->traits());
  auto prepared = prepare_scene(*scene, settings, (*device)->traits(), options.servo.rate_hz, place,
                                impl->kept, options.work);
  if (!prepared) return std::move(prepared).error();
  prepared->scene.id = ++impl->last_scene_id;
  impl->described_now = impl->described(*prepared, scene, settings);
  impl->scene = std::move(scene);
  impl->settings = settings;
  impl->law_in_use = prepared->law.law;
  impl->radius_in_use_m = prepared->law.radius_m.value_or(0.0);
  impl->scene_from_device = place;
  impl->notices = std::move(prepared->notices);
  const auto further = [pointers = impl->pointers, rate_hz = options.servo.rate_hz] {
    std::vector<std::unique_ptr<device::Device>> devices;
    for (std::size_t probe = 1; probe < pointers.size(); ++probe)
      devices.push_back(std::make_unique<device::PointerDevice>(pointers[probe], rate_hz));
    return devices;
  };
  auto loop =
      haptics::ReopeningLoop::start(std::move(*device), std::move(prepared->scene), impl->options.servo,
                                    device::reopener(device_url, options.servo.rate_hz), further);
  if (!loop) return std::move(loop).error();
  impl->servo_begin_ns = haptics::monotonic_ns();
  impl->loop = std::move(*loop);
  if (!options.recording.empty())
    if (auto recording = impl->record_into(options.recording); !recording)
      return std::move(recording).error();
  return std::unique_ptr<TouchSession>(new TouchSession(std::move(impl)));
}

Result<void> TouchSession::change_scene(std::shared_ptr<const models::Scene> scene) {
  PALPABLE_CHECK(scene != nullptr);
  const std::lock_guard changing(impl_->changing);
  auto place = haptics::fit_workspace(*scene, impl_->loop->device_traits());
  if (impl_->pose) place = with_explorer(place, *impl_->pose);
  return impl_->change(std::move(scene), settings(), place);
}

Result<void> TouchSession::change_settings(const TouchSettings& settings) {
  const std::lock_guard changing(impl_->changing);
  return impl_->change(scene(), settings, impl_->scene_from_device);
}

Result<void> TouchSession::change_materials(std::vector<models::Material> materials,
                                            const TouchSettings& settings) {
  const std::lock_guard changing(impl_->changing);
  auto changed = with_materials(*scene(), std::move(materials));
  if (!changed) return changed.error();
  return impl_->change(std::make_shared<const models::Scene>(*std::move(changed)), settings,
                       impl_->scene_from_device);
}

std::shared_ptr<const models::Scene> TouchSession::scene() const {
  const std::lock_guard lock(impl_->state);
  return impl_->scene;
}

std::uint32_t TouchSession::newest_scene_id() const {
  const std::lock_guard lock(impl_->state);
  return impl_->described_now.id;
}

TouchSettings TouchSession::settings() const {
  const std::lock_guard lock(impl_->state);
  return impl_->settings;
}

haptics::Law TouchSession::law_in_use() const {
  const std::lock_guard lock(impl_->state);
  return impl_->law_in_use;
}

double TouchSession::radius_in_use_m() const {
  const std::lock_guard lock(impl_->state);
  return impl_->radius_in_use_m;
}

std::vector<std::string> TouchSession::notices() const {
  const std::lock_guard lock(impl_->state);
  return impl_->notices;
}

void TouchSession::pause() {
  const std::lock_guard lock(impl_->state);
  impl_->paused = true;
  impl_->loop->pause();
}

void TouchSession::resume() {
  const std::lock_guard lock(impl_->state);
  impl_->paused = false;
  impl_->loop->resume();
}

bool TouchSession::paused() const {
  const std::lock_guard lock(impl_->state);
  return impl_->paused;
}

void TouchSession::recentre() {
  const std::lock_guard changing(impl_->changing);
  const Vec3 hand = latest().device_position.v;
  if (!is_finite(hand)) return;
  auto place = impl_->scene_from_device;
  const Vec3 turned = place.scale * place.rotate(hand);
  place.translation_m = Vec3{0.0, 0.0, models::size_m(*scene()).z} - turned;
  // A change that differs only in the placement cannot fail.
  static_cast<void>(impl_->change(scene(), settings(), place));
}

Result<void> TouchSession::move_explorer(const ExplorerPose& pose) {
  const std::lock_guard changing(impl_->changing);
  auto moved = impl_->change(scene(), settings(), with_explorer(impl_->scene_from_device, pose));
  if (moved) impl_->pose = pose;
  return moved;
}

void TouchSession::stop() {
  static_cast<void>(stop_recording());
  impl_->loop->stop();
}

std::size_t TouchSession::probes() const { return impl_->pointers.size(); }

void TouchSession::move_pointer(Point<SceneFrame> position, std::size_t probe) {
  if (!is_finite(position) || probe >= probes()) return;
  const std::lock_guard lock(impl_->state);
  impl_->pointers[probe]->put(impl_->scene_from_device.inverse() * position);
}

void TouchSession::lift_pointer(std::size_t probe) {
  if (probe >= probes()) return;
  const std::lock_guard lock(impl_->state);
  impl_->pointers[probe]->put(std::nullopt);
}

haptics::TouchSample TouchSession::latest(std::size_t probe) const {
  PALPABLE_CHECK(probe < probes());
  const std::lock_guard lock(impl_->state);
  if (const auto newer = impl_->loop->take_latest(probe)) impl_->latest[probe] = *newer;
  return impl_->latest[probe];
}

std::vector<haptics::TouchEvent> TouchSession::take_events() {
  const std::lock_guard lock(impl_->state);
  std::vector<haptics::TouchEvent> events;
  while (const auto event = impl_->loop->take_event()) events.push_back(*event);
  return events;
}

std::vector<haptics::MissedDeadline> TouchSession::take_missed() {
  const std::lock_guard lock(impl_->state);
  std::vector<haptics::MissedDeadline> missed;
  while (const auto one = impl_->loop->take_missed()) missed.push_back(*one);
  return missed;
}

std::optional<Error> TouchSession::take_recording_fault() {
  const std::lock_guard lock(impl_->state);
  return impl_->recorder ? impl_->recorder->take_fault() : std::nullopt;
}

Result<void> TouchSession::Impl::record_into(const std::filesystem::path& file) {
  RecordedSession session;
  session.made_by = options.made_by;
  session.command = options.command;
  session.seed = options.seed;
  session.rate_hz = options.servo.rate_hz;
  session.device_url = device::public_url(device_url);
  session.traits = loop->device_traits();
  session.tick = haptics::tick_options(options.servo);
  session.as_published = options.as_published;
  auto started = Recorder::start(*loop, file, header_json(session), described_now);
  if (!started) return std::move(started).error();
  const std::lock_guard lock(state);
  recorder = std::move(*started);
  return {};
}

Result<void> TouchSession::stop_recording() {
  std::unique_ptr<Recorder> ended;
  {
    const std::lock_guard lock(impl_->state);
    ended = std::exchange(impl_->recorder, nullptr);
  }
  return ended ? ended->finish() : Result<void>();
}

TouchStatistics TouchSession::statistics() const {
  TouchStatistics statistics;
  statistics.servo = impl_->loop->statistics();
  statistics.seconds_to_scene = 1e-9 * static_cast<double>(impl_->servo_begin_ns - impl_->begin_ns);
  statistics.seconds_to_first_force = statistics.seconds_to_scene + statistics.servo.touch.first_force_t_s;
  statistics.device = impl_->loop->device_traits().name;
  const auto real_time = impl_->loop->real_time();
  statistics.realtime_priority = real_time.priority;
  statistics.memory_lock = real_time.memory;
  return statistics;
}

const device::Traits& TouchSession::device_traits() const { return impl_->loop->device_traits(); }
std::string TouchSession::device_fault() const { return impl_->loop->device_fault(); }

std::string TouchSession::take_guidance() {
  std::string guidance = impl_->loop->device_guidance();
  if (guidance == impl_->guidance) return {};
  return impl_->guidance = std::move(guidance);
}

}  // namespace palpable::session
