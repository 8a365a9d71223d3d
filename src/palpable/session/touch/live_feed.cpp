// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/session/touch/live_feed.hpp"

#include "palpable/core/check.hpp"
#include "palpable/session/robot/robot_ears.hpp"
#include "palpable/session/touch/rising_surface.hpp"
#include "palpable/session/touch/touch_session.hpp"
#include "palpable/vision/depth_camera/clean_depth.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

namespace palpable::session {
namespace {

using Clock = std::chrono::steady_clock;
/// How long a source is waited for before the feed looks whether it shall end.
constexpr auto kPatience = std::chrono::milliseconds(50);

double seconds_between(Clock::time_point from, Clock::time_point to) {
  return std::chrono::duration<double>(to - from).count();
}

double share_unknown(const Raster<float>& depth_m) {
  const auto unknown = std::count_if(depth_m.values().begin(), depth_m.values().end(),
                                     [](float z) { return !std::isfinite(z); });
  return static_cast<double>(unknown) / static_cast<double>(depth_m.count());
}

/// Where the hands are that are present, and the further probes.
std::vector<Point<SceneFrame>> places_of_hands(const TouchSession& session) {
  std::vector<Point<SceneFrame>> places;
  for (std::size_t probe = 0; probe < session.probes(); ++probe)
    if (const auto sample = session.latest(probe); haptics::is_present(sample))
      places.push_back(sample.position);
  return places;
}

/// Waits until the servo has begun with this scene, or a later one; false if that lasts too long. It polls,
/// because a tick may wake nobody.
bool wait_until_felt(const TouchSession& session, std::uint32_t id, const std::atomic<bool>& ending) {
  constexpr auto kLook = std::chrono::microseconds(500);
  constexpr auto kTooLong = std::chrono::milliseconds(500);
  for (const auto end = Clock::now() + kTooLong; Clock::now() < end && !ending;) {
    const auto sample = session.latest();
    if (std::max(sample.scene_id, sample.coming_scene_id) >= id) return true;
    std::this_thread::sleep_for(kLook);
  }
  return false;
}

}  // namespace

Result<void> check(const LiveOptions& options) {
  const auto usage = [](const char* message) { return Error{ErrorCode::usage, message, {}}; };
  if (options.longest_side_px < 16 || options.longest_side_px > 2048)
    return usage("live frames have 16 to 2048 pixels on their longer side");
  if (!(options.fade_s >= 0.005 && options.fade_s <= 1.0))
    return usage("the change between two live frames takes 0.005 to 1 s");
  if (!(options.lost_s >= 0.1 && options.lost_s <= 60.0))
    return usage("a live source counts as lost after 0.1 to 60 s");
  if (!(options.first_s >= 0.1 && options.first_s <= 600.0))
    return usage("a first depth is waited for 0.1 to 600 s");
  return vision::check(options.steady);
}

LiveFeed::LiveFeed(std::unique_ptr<LiveSource> source, const LiveOptions& options)
    : source_(std::move(source)), options_(options), steady_(options.steady) {}

LiveFeed::~LiveFeed() { stop(); }

Result<std::unique_ptr<LiveFeed>> LiveFeed::open(std::unique_ptr<LiveSource> source,
                                                 const LiveOptions& options, const Work& work) {
  PALPABLE_CHECK(source != nullptr);
  if (auto valid = check(options); !valid) return std::move(valid).error();
  std::unique_ptr<LiveFeed> feed(new LiveFeed(std::move(source), options));
  if (auto begun = feed->begin_recording(); !begun) return std::move(begun).error();
  bool has_seen = false;
  for (const auto begin = Clock::now(); !work.cancelled();) {
    auto frame = feed->source_->take(Clock::now() + kPatience);
    if (!frame) return std::move(frame).error();
    if (*frame) {
      has_seen = true;
      feed->prepare(**frame);
      auto surface = feed->surface_of(**frame);
      if (!surface) return std::move(surface).error();
      feed->learn();
      feed->record(**frame);
      if (surface->relief) return feed->begin_with(*std::move(surface)), std::move(feed);
    }
    if (feed->source_->has_ended() || seconds_between(begin, Clock::now()) > options.first_s)
      return invalid_input(has_seen ? "no frame of the live source has a known depth"
                                    : "no readable picture has come");
  }
  return Work::interrupted();
}

/// Sets what depends on the source, from its first frame.
void LiveFeed::prepare(const LiveFrame& first) {
  first_arrival_ = last_arrival_ = first.arrival;
  options_.steady.noise = source_->noise();
  steady_ = vision::SteadyDepth(options_.steady);
  if (options_.memory == Memory::off) return;
  options_.remembered.camera.map.noise = options_.steady.noise;
  memory_ = std::make_unique<LiveMemory>(options_.remembered);
}

void LiveFeed::begin_with(Surface surface) {
  auto scene = std::make_shared<models::Scene>();
  scene->model = std::move(surface.relief);
  scene->labels = std::move(surface.labels);
  if (memory_) scene->materials = memory_materials();
  if (source_->marks_sounds()) {
    if (scene->materials.empty()) scene->materials.resize(1);
    scene->materials.push_back(sound_material());
  }
  scene->source.method = kLiveMethod;
  if (memory_) scene->source.method += ", with memory";
  scene->title = "Live pictures of a " + std::string(source_->kind());
  read_picture();
  refresh_texture(*scene);
  first_ = std::move(scene);
}

Result<LiveFeed::Surface> LiveFeed::surface_of(const LiveFrame& frame) {
  const double dt_s = std::max(0.0, seconds_between(last_arrival_, frame.arrival));
  const Raster<float>& raw = frame.depth.depth_m;
  const int longest = std::max(raw.width(), raw.height());
  const int k = std::max(1, (longest + options_.longest_side_px - 1) / options_.longest_side_px);
  const auto& noise = options_.steady.noise;
  Raster<float> seen_m = vision::clean_depth(vision::reduced_depth(raw, k, noise), noise);
  if (memory_) seen_m = memory_->live_view(frame, seen_m, k, seconds_between(first_arrival_, frame.arrival));
  const Raster<float>* depth_m = &steady_.add(seen_m, dt_s);
  Surface surface;
  if (memory_) {
    seen_m = *depth_m;
    surface.labels = memory_->fill(seen_m);
    depth_m = &seen_m;
  }
  auto range = options_.range;
  if (const auto followed = range_.add(*depth_m, dt_s); !range) range = followed;
  if (!range) return surface;
  auto relief = sculpt::relief_in_window(*depth_m, *range, options_.relief);
  if (!relief) return std::move(relief).error();
  std::optional<Pinhole> camera;
  if (frame.depth.camera) camera = vision::reduced_camera(*frame.depth.camera, k);
  if (auto other = source_->surface({*relief, *depth_m, memory_ ? std::nullopt : camera, options_.relief})) {
    surface = {std::move(other), {}};
    return surface;
  }
  surface.relief = std::make_shared<const models::Relief>(*std::move(relief));
  if (source_->marks_sounds() && camera) {
    if (surface.labels.count() == 0)
      surface.labels = Raster<std::uint8_t>(depth_m->width(), depth_m->height(), 0);
    const auto label = static_cast<std::uint8_t>(memory_ ? memory_materials().size() : 1);
    source_->mark_sound(surface.labels, label, *camera);
  }
  return surface;
}

/// Takes the last frame into the memory.
void LiveFeed::learn() {
  if (!memory_) return;
  memory_->learn();
  const std::lock_guard lock(mutex_);
  memory_statistics_ = MemoryStatistics{memory_->remembered_share(), memory_->map_mib(), memory_->lost()};
}

Result<void> LiveFeed::begin_recording() {
  if (options_.record_to.empty() || !source_->gives_depths()) return {};
  auto recorder = DepthRecorder::open(options_.record_to);
  if (!recorder) return std::move(recorder).error();
  recorder_ = *std::move(recorder);
  return {};
}

void LiveFeed::record(const LiveFrame& frame) {
  if (recorder_) recorder_->keep(frame, std::exchange(unrecorded_colour_, std::nullopt));
}

/// The colour picture is for the eye: it is read less often than the depth, and while nobody waits for a
/// surface. The next scene has it.
void LiveFeed::read_picture() {
  constexpr auto kPeriod = std::chrono::seconds(1);
  if (has_picture_ && last_arrival_ - last_picture_ < kPeriod) return;
  last_picture_ = last_arrival_;
  auto picture = source_->colour();
  if (!picture) return;
  has_picture_ = true;
  new_texture_ = rgb8(*picture);
  if (recorder_) unrecorded_colour_ = std::move(picture);
}

void LiveFeed::refresh_texture(models::Scene& scene) {
  if (new_texture_) scene.texture = *std::exchange(new_texture_, std::nullopt);
}

void LiveFeed::start(TouchSession& session, Say say) {
  PALPABLE_CHECK(!thread_.joinable());
  say_ = std::move(say);
  begin_ = newest_felt_ = Clock::now();
  source_->begin(session);
  thread_ = std::thread([this, &session] { run(session); });
  watcher_ = std::thread([this] { watch(); });
}

void LiveFeed::stop() {
  ending_ = true;
  if (thread_.joinable()) {
    source_->cancel();
    thread_.join();
  }
  if (watcher_.joinable()) watcher_.join();
  source_->end();
}

void LiveFeed::say(const std::string& sentence, LiveSubject subject) {
  const std::lock_guard lock(say_mutex_);
  say_(sentence, subject);
}

LiveStatistics LiveFeed::statistics() const {
  const std::lock_guard lock(mutex_);
  const auto now = Clock::now();
  LiveStatistics live;
  live.frames = arrived_;
  live.memory = memory_statistics_;
  live.latency = latencies_.summary();
  live.dropped = arrived_ - live.latency.count;
  if (const double lasted_s = seconds_between(begin_, now); lasted_s > 0.0)
    live.fps = static_cast<double>(live.latency.count) / lasted_s;
  if (live.latency.count > 0) live.stale_s = seconds_between(newest_felt_, now);
  if (const auto* robot = source_->robot()) live.robot = robot->statistics();
  return live;
}

void LiveFeed::run(TouchSession& session) {
  std::optional<std::uint64_t> number;
  bool said_unreadable = false;
  while (!ending_) {
    asked_ = Clock::now();
    auto frame = source_->take(Clock::now() + kPatience);
    asked_ = Clock::time_point{};
    if (const auto notice = source_->notice()) say(*notice);
    if (recorder_)
      if (const auto notice = recorder_->notice()) say(*notice);
    if (auto* robot = source_->robot())
      if (const auto notice = robot->state_notice()) say(*notice, LiveSubject::robot);
    if (!frame) {
      if (ending_ || frame.error().code == ErrorCode::interrupted) return;
      if (!std::exchange(said_unreadable, true))
        say(frame.error().sentence() + "; the touch goes on with the next picture.");
      continue;
    }
    if (!*frame) {
      if (const auto loss = source_->loss()) call_old(*loss, Old::lost);
      if (!source_->has_ended()) continue;
      ended_ = true;
      say("The live pictures have ended; the surface of the last one stays.");
      return;
    }
    {
      const std::lock_guard lock(mutex_);
      arrived_ += (*frame)->number - number.value_or((*frame)->number - 1);
    }
    number = (*frame)->number;
    feel(session, **frame);
    read_picture();
    learn();
    record(**frame);
    constexpr double kMuch = 0.3;
    if (!said_unknown_ && share_unknown((*frame)->depth.depth_m) > kMuch) {
      said_unknown_ = true;
      say("More than 30 % of the picture has no depth; there is no surface there.");
    }
  }
}

void LiveFeed::feel(TouchSession& session, const LiveFrame& frame) {
  auto surface = surface_of(frame);
  const double passed_s = seconds_between(last_arrival_, frame.arrival);
  last_arrival_ = frame.arrival;
  // A frame of another size than the first may be too small for a relief.
  if (!surface || !surface->relief) return;
  auto scene = std::make_shared<models::Scene>(*session.scene());
  scene->model = risen_surface(*models::relief_of(*scene), std::move(surface->relief),
                               places_of_hands(session), session.radius_in_use_m(), passed_s);
  if (memory_ || source_->marks_sounds()) scene->labels = std::move(surface->labels);
  refresh_texture(*scene);
  scene->guide = source_->guide(*scene);
  if (const auto changed = session.change_surface(std::move(scene)); !changed) return;
  if (!wait_until_felt(session, session.newest_scene_id(), ending_)) return;
  const auto now = Clock::now();
  const std::lock_guard lock(mutex_);
  newest_felt_ = frame.arrival;
  newest_latency_s_ = seconds_between(frame.arrival, now);
  latencies_.record_ns(1e9 * newest_latency_s_);
}

/// Says why the surface is old, until a picture that came later is felt.
void LiveFeed::call_old(const std::string& sentence, Old why) {
  {
    const std::lock_guard lock(mutex_);
    old_since_ = Clock::now();
    old_ = why;
  }
  say(sentence);
}

/// Ends that the surface is called old if it is so, and a picture that came since then is felt: after a loss
/// any, else one that is new. Returns why it was called old.
std::optional<LiveFeed::Old> LiveFeed::end_old(double current_s) {
  const std::lock_guard lock(mutex_);
  if (!old_since_ || newest_felt_ < *old_since_) return std::nullopt;
  if (old_ != Old::lost && seconds_between(newest_felt_, Clock::now()) > current_s) return std::nullopt;
  old_since_.reset();
  return old_;
}

bool LiveFeed::is_called_old() const {
  const std::lock_guard lock(mutex_);
  return old_since_.has_value();
}

double LiveFeed::age_s() const {
  const std::lock_guard lock(mutex_);
  return seconds_between(newest_felt_, Clock::now());
}

/// Whether pictures come, but are read or used too slowly.
bool LiveFeed::is_slow() const {
  // The source waits for a picture as long as kPatience, and has more to do if it takes several times that.
  constexpr auto kReading = 4 * kPatience;
  const auto asked = asked_.load();
  if (asked != Clock::time_point{} && Clock::now() - asked > kReading) return true;
  const std::lock_guard lock(mutex_);
  return newest_latency_s_ > 0.5 * options_.lost_s;
}

void LiveFeed::watch() {
  // Not at each picture of a source that hardly keeps up.
  const double current_s = 0.5 * options_.lost_s;
  for (; !ending_ && !ended_; std::this_thread::sleep_for(kPatience)) {
    const double age = age_s();
    if (const auto ended = end_old(current_s)) {
      say(*ended == Old::slow ? "The surface keeps up with the pictures again." : "The pictures come again.");
    } else if (!is_called_old() && age > options_.lost_s) {
      if (is_slow())
        call_old(fmt::format("The surface is {:.1f} s behind the pictures: they are read too slowly; "
                             "smaller ones would help.",
                             age),
                 Old::slow);
      else
        call_old(fmt::format("No readable picture has come for {:.1f} s; the surface of the last one stays.",
                             options_.lost_s),
                 Old::late);
    }
  }
}

}  // namespace palpable::session
