// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/session/touch/device_hand.hpp"

#include "palpable/core/check.hpp"
#include "palpable/device/drivers/open.hpp"
#include "palpable/device/local_surface.hpp"
#include "palpable/device/url.hpp"
#include "palpable/haptics/servo/pacing.hpp"
#include "palpable/haptics/servo/start_touch.hpp"
#include "palpable/session/touch/recorded_touch.hpp"
#include "palpable/session/touch/recording_header.hpp"
#include "palpable/session/touch/sent_textures.hpp"
#include "palpable/session/touch/surface_strokes.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <utility>
#include <variant>

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

/// For a device at another computer: `tracing` gives the hand energy of its own, which that device does not
/// pass on, as it would come late. Contours have passive laws as well.
Result<PreparedScene> without_tracing(
    const models::Scene& scene, const TouchSettings& settings, const device::Traits& traits,
    const std::function<Result<PreparedScene>(const TouchSettings&)>& prepare) {
  const bool is_traced = settings.law.law == haptics::Law::tracing &&
                         std::holds_alternative<std::shared_ptr<const models::Contours>>(scene.model);
  if (!is_traced) return prepare(settings);
  constexpr auto kWhy = "A device at another computer does not render tracing, whose push would come late";
  if (settings.law_is_required)
    return Error{ErrorCode::usage, std::string(kWhy) + ", and no other law will do", {}};
  TouchSettings passive = settings;
  passive.law.law = traits.degrees_of_freedom < 3 ? haptics::Law::rolling : haptics::Law::groove;
  passive.law.damping_Ns_per_m.reset();
  auto prepared = prepare(passive);
  if (prepared)
    prepared->notices.push_back(std::string(kWhy) + ": the law is " +
                                std::string(haptics::name_of(passive.law.law)) + ".");
  return prepared;
}

using Opened = Result<std::unique_ptr<device::Device>>;

/// A device of another computer computes its forces there, and a recording's positions were moved already.
bool can_be_moved(const device::Device& device, const std::string& url) {
  return device.traits().pushes_back && !url.starts_with("replay:") &&
         dynamic_cast<const device::TakesLocalSurface*>(&device) == nullptr;
}

std::unique_ptr<device::Device> moved(std::unique_ptr<device::Device> device, const SessionOptions& options,
                                      const std::string& url,
                                      const std::shared_ptr<haptics::WorkspaceState>& state) {
  if (!can_be_moved(*device, url)) return device;
  return std::make_unique<haptics::MovedWorkspace>(std::move(device), options.workspace,
                                                   options.servo.rate_hz, state);
}

/// Empty if the device is not opened again.
haptics::ReopeningLoop::Open reopener_of(const std::string& url, const SessionOptions& options,
                                         const std::shared_ptr<haptics::WorkspaceState>& state) {
  const auto again = device::reopener(url, options.servo.rate_hz);
  if (!again) return {};
  return [again, options, url, state]() -> Opened {
    auto device = again();
    if (!device) return device;
    return moved(*std::move(device), options, url, state);
  };
}

Transform<SceneFrame, DeviceFrame> placed(const models::Scene& scene, const device::Traits& traits,
                                          const SessionOptions& options) {
  auto place = haptics::fit_workspace(scene, traits);
  place.scale /= options.workspace.magnification;
  return place;
}

/// How far a scene reaches from the middle of the device's workspace, m, at the device.
Vec3 reach_of(const models::Scene& scene, const Transform<SceneFrame, DeviceFrame>& scene_from_device) {
  const auto device_from_scene = scene_from_device.inverse();
  const Vec3 centre = models::centre_m(scene);
  const Vec3 half = 0.5 * models::size_m(scene);
  Vec3 reach;
  for (const double x : {-half.x, half.x})
    for (const double y : {-half.y, half.y})
      for (const double z : {-half.z, half.z}) {
        const Vec3 corner = (device_from_scene * Point<SceneFrame>{centre + Vec3{x, y, z}}).v;
        reach = {std::max(reach.x, std::abs(corner.x)), std::max(reach.y, std::abs(corner.y)),
                 std::max(reach.z, std::abs(corner.z))};
      }
  return reach;
}

Opened opened_device(const DeviceHand::Begin& begin, const SessionOptions& options,
                     const std::shared_ptr<haptics::WorkspaceState>& state) {
  device::OpenOptions open;
  open.seed = options.seed;
  open.rate_hz = options.servo.rate_hz;
  open.strokes = [&begin](const device::Traits& traits) {
    return strokes_along_solid(*begin.scene, haptics::fit_workspace(*begin.scene, traits));
  };
  open.check_header = [](const std::string& header) -> Result<void> {
    const auto session = parse_header(header);
    return session ? Result<void>{} : Result<void>(session.error());
  };
  open.pointer = begin.pointers.front();
  if (const auto words = device::hold_words(begin.url); !words.empty() && options.hold) options.hold(words);
  auto device = device::open_device(begin.url, open);
  if (!device) return device;
  if (begin.settings.limits == Limits::off && !device::is_virtual_device(begin.url) &&
      !((*device)->traits().max_force_N <= kMostUnlimited_N))
    return Error{ErrorCode::usage,
                 "the limits may be off on simulated devices and on those of at most 4 N only",
                 device::url_as_place(begin.url)};
  const auto& workspace = options.workspace;
  const bool is_moved = workspace.magnification > 1.0 || workspace.clutch_button || workspace.stop_button;
  if (is_moved && !can_be_moved(**device, begin.url))
    return Error{ErrorCode::usage,
                 "only a device with motors at this computer can magnify a scene, have a clutch or a button "
                 "that ends the force",
                 device::url_as_place(begin.url)};
  return moved(*std::move(device), options, begin.url, state);
}

}  // namespace

std::filesystem::path recording_of_hand(const std::filesystem::path& file, std::size_t hand) {
  if (file.empty() || hand == 0) return file;
  std::filesystem::path own = file;
  own.replace_filename(file.stem().string() + "-" + std::to_string(hand + 1) + file.extension().string());
  return own;
}

Result<std::unique_ptr<DeviceHand>> DeviceHand::open(const Begin& begin, SceneCaches& caches) {
  std::unique_ptr<DeviceHand> hand(new DeviceHand);
  hand->options_ = begin.options;
  hand->options_.seed += begin.number;
  hand->options_.recording = recording_of_hand(begin.options.recording, begin.number);
  hand->options_.servo.recording =
      begin.options.recording.empty() ? haptics::Recording::off : haptics::Recording::on;
  hand->url_ = device::public_url(begin.url);
  for (auto& sample : hand->latest_) sample.status = device::Status::not_ready;
  auto device = opened_device(begin, hand->options_, hand->workspace_);
  if (!device) return std::move(device).error();
  if (auto* takes = dynamic_cast<device::TakesLocalSurface*>(device->get()); takes != nullptr) {
    hand->sent_textures_ = takes->textures();
    hand->options_.servo.tick.ramp_loads = false;
  }
  const auto place = placed(*begin.scene, (*device)->traits(), hand->options_);
  auto prepared = hand->prepared_for((*device)->traits(), begin.scene, begin.settings, place, caches);
  if (!prepared) return std::move(prepared).error();
  hand->take_over(*prepared);
  hand->waiting_ = Waiting{*std::move(device), std::move(prepared->scene.scene)};
  hand->described_now_ = std::move(prepared->description);
  return hand;
}

Result<void> DeviceHand::start(const Begin& begin) {
  PALPABLE_CHECK(waiting_.has_value());
  auto [device, scene] = *std::exchange(waiting_, std::nullopt);
  const double rate_hz = options_.servo.rate_hz;
  const auto further = [pointers = begin.pointers, rate_hz] {
    std::vector<std::unique_ptr<device::Device>> devices;
    for (std::size_t probe = 1; probe < pointers.size(); ++probe)
      devices.push_back(std::make_unique<device::PointerDevice>(pointers[probe], rate_hz));
    return devices;
  };
  auto loop = haptics::ReopeningLoop::start(std::move(device), std::move(scene), options_.servo,
                                            reopener_of(begin.url, options_, workspace_), further);
  if (!loop) return std::move(loop).error();
  servo_begin_ns_ = haptics::monotonic_ns();
  loop_ = *std::move(loop);
  return options_.recording.empty() ? Result<void>{} : record();
}

DeviceHand::~DeviceHand() {
  if (loop_) loop_->stop();
  static_cast<void>(stop_recording());
}

device::RecordedScene DeviceHand::described(const PreparedScene& prepared,
                                            const std::shared_ptr<const models::Scene>& touched,
                                            const TouchSettings& asked, SceneCaches& caches) const {
  RecordedTouch touch = recorded_touch(prepared, asked);
  if (touched->guide != nullptr) touch.guide = *touched->guide;
  touch.hashes = caches.hashes.of(touched);
  touch.inputs = touched->source.inputs;
  touch.method = touched->source.method;
  return {prepared.scene.id, touch_json(touch)};
}

Result<DeviceHand::Prepared> DeviceHand::prepared_for(const device::Traits& traits,
                                                      const std::shared_ptr<const models::Scene>& to,
                                                      const TouchSettings& settings,
                                                      const Transform<SceneFrame, DeviceFrame>& place,
                                                      SceneCaches& caches) {
  const auto prepare = [&](const TouchSettings& used) {
    return prepare_scene(*to, used, traits, options_.servo.rate_hz, place, caches.kept, options_.work);
  };
  auto scene = sent_textures_ ? without_tracing(*to, settings, traits, prepare) : prepare(settings);
  if (!scene) return std::move(scene).error();
  scene->scene.id = last_scene_id_ + 1;
  auto description = described(*scene, to, settings, caches);
  return Prepared{*std::move(scene), std::move(description), place, reach_of(*to, place)};
}

Result<DeviceHand::Prepared> DeviceHand::prepare(const std::shared_ptr<const models::Scene>& scene,
                                                 const TouchSettings& settings,
                                                 const Transform<SceneFrame, DeviceFrame>& place,
                                                 SceneCaches& caches) {
  return prepared_for(loop_->device_traits(), scene, settings, place, caches);
}

void DeviceHand::take_over(const Prepared& prepared) {
  last_scene_id_ = prepared.scene.scene.id;
  law_in_use_ = prepared.scene.law.law;
  radius_in_use_m_ = prepared.scene.law.radius_m.value_or(0.0);
  used_contact_law_ = used_contact_law_ || haptics::description_of(law_in_use_).is_contact;
  scene_from_device_ = prepared.place;
  notices_ = prepared.scene.notices;
  if (sent_textures_) sent_textures_->put(sent_textures(prepared.scene.materials));
  workspace_->scene_m[0] = prepared.reach_m.x;
  workspace_->scene_m[1] = prepared.reach_m.y;
  workspace_->scene_m[2] = prepared.reach_m.z;
}

void DeviceHand::apply(Prepared prepared) {
  {
    // The recording must know the scene before its first tick.
    const std::lock_guard lock(state_);
    if (recorder_) recorder_->note(prepared.description);
  }
  // This reads every page of the model.
  loop_->change(std::move(prepared.scene.scene));
  const std::lock_guard lock(state_);
  described_now_ = std::move(prepared.description);
  take_over(prepared);
}

Transform<SceneFrame, DeviceFrame> DeviceHand::place() const {
  const std::lock_guard lock(state_);
  return scene_from_device_;
}

Transform<SceneFrame, DeviceFrame> DeviceHand::place_of_device() const {
  const auto& offset_m = workspace_->offset_m;
  auto own = place();
  own.translation_m = (own * Point<DeviceFrame>{Vec3{offset_m[0].load(std::memory_order_relaxed),
                                                     offset_m[1].load(std::memory_order_relaxed),
                                                     offset_m[2].load(std::memory_order_relaxed)}})
                          .v;
  return own;
}

Transform<SceneFrame, DeviceFrame> DeviceHand::fitted(const models::Scene& scene) const {
  return placed(scene, loop_->device_traits(), options_);
}

std::optional<Transform<SceneFrame, DeviceFrame>> DeviceHand::recentred(const models::Scene& scene) const {
  const Vec3 hand = latest(0).device_position.v;
  if (!is_finite(hand)) return std::nullopt;
  auto moved = place();
  const Vec3 turned = moved.scale * moved.rotate(hand);
  moved.translation_m = Vec3{0.0, 0.0, models::size_m(scene).z} - turned;
  return moved;
}

haptics::Law DeviceHand::law_in_use() const {
  const std::lock_guard lock(state_);
  return law_in_use_;
}

double DeviceHand::radius_in_use_m() const {
  const std::lock_guard lock(state_);
  return radius_in_use_m_;
}

std::vector<std::string> DeviceHand::notices() const {
  const std::lock_guard lock(state_);
  return notices_;
}

std::uint32_t DeviceHand::newest_scene_id() const {
  const std::lock_guard lock(state_);
  return described_now_.id;
}

haptics::TouchSample DeviceHand::latest(std::size_t probe) const {
  const std::lock_guard lock(state_);
  if (const auto newer = loop_->take_latest(probe)) latest_[probe] = *newer;
  return latest_[probe];
}

Result<void> DeviceHand::record() {
  RecordedSession session;
  session.made_by = options_.made_by;
  session.command = options_.command;
  session.seed = options_.seed;
  session.rate_hz = options_.servo.rate_hz;
  session.device_url = url_;
  session.traits = loop_->device_traits();
  session.tick = haptics::tick_options(options_.servo);
  session.as_published = options_.as_published;
  auto started = Recorder::start(*loop_, options_.recording, header_json(session), described_now_);
  if (!started) return std::move(started).error();
  const std::lock_guard lock(state_);
  recorder_ = std::move(*started);
  return {};
}

std::optional<Error> DeviceHand::take_recording_fault() {
  const std::lock_guard lock(state_);
  return recorder_ ? recorder_->take_fault() : std::nullopt;
}

Result<void> DeviceHand::stop_recording() {
  std::unique_ptr<Recorder> ended;
  {
    const std::lock_guard lock(state_);
    ended = std::exchange(recorder_, nullptr);
  }
  return ended ? ended->finish() : Result<void>();
}

std::string DeviceHand::take_guidance() {
  std::string guidance = loop_->device_guidance();
  const std::lock_guard lock(state_);
  if (guidance == guidance_) return {};
  return guidance_ = std::move(guidance);
}

TouchStatistics DeviceHand::statistics(std::int64_t begin_ns) const {
  TouchStatistics statistics;
  statistics.servo = loop_->statistics();
  {
    // The servo also counts the work of `tracing` without its bounds, which proves nothing.
    const std::lock_guard lock(state_);
    auto& touch = statistics.servo.touch;
    if (!used_contact_law_)
      touch.work_made_max_J = touch.work_since_zero_force_max_J = std::numeric_limits<double>::quiet_NaN();
  }
  statistics.seconds_to_scene = 1e-9 * static_cast<double>(servo_begin_ns_ - begin_ns);
  statistics.seconds_to_first_force = statistics.seconds_to_scene + statistics.servo.touch.first_force_t_s;
  statistics.device = loop_->device_traits().name;
  const auto real_time = loop_->real_time();
  statistics.realtime_priority = real_time.priority;
  statistics.memory_lock = real_time.memory;
  return statistics;
}

}  // namespace palpable::session
