// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/haptics/servo/servo_loop.hpp"

#include "palpable/core/system/allocations.hpp"
#include "palpable/core/system/hand_off.hpp"
#include "palpable/haptics/safety/guardian.hpp"
#include "palpable/haptics/safety/zero_force.hpp"
#include "palpable/haptics/servo/kept_scenes.hpp"
#include "palpable/haptics/servo/latency_recorder.hpp"
#include "palpable/haptics/servo/pacing.hpp"
#include "palpable/haptics/servo/watchdog.hpp"
#include "palpable/haptics/tick/rest.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

namespace palpable::haptics {
namespace {

constexpr std::size_t kEvents = 1024;
constexpr std::size_t kTimings = 8192;
constexpr std::size_t kRetired = 16;
constexpr auto kMaintenancePeriod = std::chrono::milliseconds(50);

/// Duration of one tick, and time since the start of the previous one.
struct Timing {
  std::int64_t period_ns = 0;
  std::int64_t compute_ns = 0;
};

/// Counters of the loop in addition to those of the tick.
struct LoopCounts {
  TickCounts touch;
  std::uint64_t missed = 0;
  std::array<std::uint64_t, 4> missed_by_cause{};
  std::uint64_t allocations = 0;
  double ran_s = 0.0;
  double rested_s = 0.0;
  std::uint64_t rest_ticks = 0;
};

Percentiles in_us(const LatencySummary& summary) {
  return {1e-3 * summary.p50_ns, 1e-3 * summary.p99_ns, 1e-3 * summary.p99_9_ns, 1e-3 * summary.max_ns};
}

}  // namespace

/// One of several probes besides the hand.
struct FurtherProbe {
  FurtherProbe(std::unique_ptr<device::Device> opened, const HapticScene& first, const TickOptions& options,
               Ring<TouchEvent>& events, std::uint8_t number)
      : device(std::move(opened)), tick(*device, first, options, events, number) {}

  std::unique_ptr<device::Device> device;
  TickPipeline tick;
  RestDetector rest;
  LatestValue<TouchSample> latest;
};

/// Shared by three threads: the servo, the maintenance thread (normal priority; frees memory and summarises
/// statistics) and the callers.
struct ServoLoop::Impl {
  Impl(std::unique_ptr<device::Device> opened, HapticScene first, const ServoOptions& wanted,
       std::vector<std::unique_ptr<device::Device>> more)
      : options(for_rate(wanted)),
        device(std::move(opened)),
        recorded(wanted.recording_capacity),
        tick(*device, scenes.keep(std::move(first)), options.tick, events) {
    recording = wanted.recording == Recording::on;
    for (auto& next : more)
      further.push_back(std::make_unique<FurtherProbe>(std::move(next), scenes.first(), options.tick, events,
                                                       static_cast<std::uint8_t>(further.size() + 1)));
  }

  Result<void> start_guardian();
  void start_threads();
  void serve();
  void tick_once(const Pacer::Wake& wake, double dt_s);
  /// TickPipeline::rehearse() of every probe.
  void rehearse(double dt_s);
  void tick_further(double dt_s);
  void note_missed(const Pacer::Wake& wake);
  /// Whether the hand or a further probe is between two scenes.
  bool any_fades() const;
  bool may_rest() const;
  bool is_complete() const { return options.most_ticks > 0 && counts.touch.ticks >= options.most_ticks; }
  void swap_scenes();
  void run_maintenance();
  /// Takes what the servo handed over, under the mutex. The caller frees the old scenes without it: their
  /// models may be large.
  [[nodiscard]] KeptScenes::Released sweep();

  const ServoOptions options;
  std::unique_ptr<device::Device> device;
  /// Destroyed before the device is closed.
  std::unique_ptr<Guardian> guardian;
  /// For devices with motors.
  std::optional<Watchdog> watchdog;

  // From the servo to other threads.
  LatestValue<TouchSample> latest;
  LatestValue<LoopCounts> counts_out;
  std::atomic<device::Status> status{device::Status::not_ready};
  Ring<TouchEvent> events{kEvents};
  Ring<MissedDeadline> missed{kEvents};
  Ring<TouchSample> recorded;
  Ring<Timing> timings{kTimings};
  Ring<const HapticScene*> retired{kRetired};

  // From other threads to the servo.
  std::atomic<const HapticScene*> waiting{nullptr};
  std::atomic<bool> ending{false};
  std::atomic<bool> paused{false};
  std::atomic<bool> recording{false};
  /// Its guardian was lost, and none can be started.
  std::atomic<bool> unguarded{false};

  // Used by the maintenance thread and the callers, under the mutex.
  mutable std::mutex mutex;
  KeptScenes scenes;
  std::condition_variable maintenance_wake;
  bool maintenance_ending = false;
  LatencyRecorder periods;
  LatencyRecorder computes;
  LoopCounts seen;
  RealTimeOutcome real_time;

  // Used only by the servo thread.
  TickPipeline tick;
  RestDetector rest;
  std::vector<std::unique_ptr<FurtherProbe>> further;
  /// The scene that the hand has left, as long as a further probe fades from it.
  const HapticScene* leaving = nullptr;
  LoopCounts counts;
  std::int64_t begin_ns = 0;

  std::thread servo;
  std::thread maintenance;
};

Result<void> ServoLoop::Impl::start_guardian() {
  const auto* guardable = dynamic_cast<const device::Guardable*>(device.get());
  const auto zero = guardable != nullptr ? guardable->zero_write() : std::nullopt;
  if (!zero) return {};
  auto started = Guardian::start(*zero);
  if (!started)
    return Error{ErrorCode::device, "its force cannot be guarded: " + started.error().message,
                 device->traits().name};
  guardian = *std::move(started);
  return {};
}

void ServoLoop::Impl::start_threads() {
  if (device->traits().pushes_back && !options.time_by_ticks) {
    watchdog.emplace(*device, 1.0 / options.rate_hz, options.realtime_priority);
    tick.watch_cuts(watchdog->cut_flag());
  }
  maintenance = std::thread([this] { run_maintenance(); });
  servo = std::thread([this] { serve(); });
}

void ServoLoop::Impl::serve() {
  const RunningServo self(*device);
  const double nominal_s = 1.0 / options.rate_hz;
  const bool has_motors = device->traits().pushes_back;
  {
    std::string priority = request_priority(options.realtime_priority);
    const std::lock_guard lock(mutex);
    real_time.priority = std::move(priority);
  }
  flush_denormals();
  touch_stack();
  Pacer pacer(options.rate_hz, has_motors ? options.watch_s : 0.0);
  pacer.begin();
  begin_ns = monotonic_ns();
  std::int64_t before_ns = begin_ns;
  // From here to the end of the loop nothing may allocate; allocations are counted per tick and reported.
  while (!ending.load(std::memory_order_relaxed) && !self.must_end() && !is_complete()) {
    const bool resting = may_rest();
    if (!resting && pacer.sleep()) rehearse(nominal_s);
    const Pacer::Wake wake = resting ? pacer.rest(options.rest_period_s) : pacer.wait();
    const AllocationScope allocations;
    const std::int64_t period_ns = wake.now_ns - before_ns;
    before_ns = wake.now_ns;
    if (wake.periods > 1) note_missed(wake);
    swap_scenes();
    const double dt_s = options.time_by_ticks ? nominal_s : 1e-9 * static_cast<double>(period_ns);
    counts.rested_s += resting ? dt_s : 0.0;
    counts.rest_ticks += resting ? 1 : 0;
    // Nothing moved during a rest: its tick continues the previous one.
    tick_once(wake, resting ? nominal_s : dt_s);
    counts.allocations += allocations.count();
    counts_out.put(counts);
    const std::int64_t done_ns = monotonic_ns();
    if (watchdog) watchdog->note_write(done_ns);
    if (guardian) guardian->beat();
    if (!resting) timings.put({period_ns, done_ns - wake.now_ns});
  }
  if (watchdog) watchdog->stop();
  device->write({});
  device->stop();
}

void ServoLoop::Impl::tick_once(const Pacer::Wake& wake, double dt_s) {
  // After a late wake the next one may follow almost immediately. Laws do not support such a short step.
  const double shortest_s = 0.1 / options.rate_hz;
  tick.set_paused(paused.load(std::memory_order_relaxed) || unguarded.load(std::memory_order_relaxed));
  counts.ran_s = options.time_by_ticks ? static_cast<double>(counts.touch.ticks + 1) / options.rate_hz
                                       : 1e-9 * static_cast<double>(wake.now_ns - begin_ns);
  const TouchSample& sample = tick.step(counts.ran_s, std::max(dt_s, shortest_s));
  rest.update(sample, dt_s);
  counts.touch = tick.counts();
  latest.put(sample);
  status.store(sample.status, std::memory_order_relaxed);
  if (recording.load(std::memory_order_relaxed)) recorded.put(sample);
  tick_further(std::max(dt_s, shortest_s));
  // Not earlier: the fade of a further probe may take longer.
  if (const HapticScene* old = tick.take_retired()) leaving = old;
  if (leaving != nullptr && !any_fades()) retired.put(std::exchange(leaving, nullptr));
}

bool ServoLoop::Impl::any_fades() const {
  return tick.fading() ||
         std::any_of(further.begin(), further.end(), [](const auto& probe) { return probe->tick.fading(); });
}

void ServoLoop::Impl::rehearse(double dt_s) {
  tick.rehearse(dt_s);
  for (const auto& probe : further) probe->tick.rehearse(dt_s);
}

void ServoLoop::Impl::tick_further(double dt_s) {
  for (const auto& probe : further) {
    probe->tick.set_paused(paused.load(std::memory_order_relaxed));
    const TouchSample& sample = probe->tick.step(counts.ran_s, dt_s);
    // The hand returns the old scene, for all.
    probe->tick.take_retired();
    probe->rest.update(sample, dt_s);
    probe->latest.put(sample);
    if (is_present(sample) && recording.load(std::memory_order_relaxed)) recorded.put(sample);
  }
}

bool ServoLoop::Impl::may_rest() const {
  if (!device->traits().may_rest || recording.load(std::memory_order_relaxed)) return false;
  if (any_fades() || waiting.load(std::memory_order_relaxed) != nullptr) return false;
  const auto rests = [&](const RestDetector& one) { return one.rested_s() >= options.rest_after_s; };
  // Further probes are pointers, which may rest.
  return rests(rest) &&
         std::all_of(further.begin(), further.end(), [&](const auto& probe) { return rests(probe->rest); });
}

void ServoLoop::Impl::note_missed(const Pacer::Wake& wake) {
  counts.missed += wake.periods - 1;
  counts.missed_by_cause[static_cast<std::size_t>(wake.cause)] += wake.periods - 1;
  missed.put({counts.touch.ticks, wake.periods - 1, wake.late_us, wake.cause});
}

void ServoLoop::Impl::swap_scenes() {
  // Checked first: the servo must always be able to return the old scene, since it may not free it.
  if (any_fades() || !retired.has_room()) return;
  if (waiting.load(std::memory_order_relaxed) == nullptr) return;
  const HapticScene* next = waiting.exchange(nullptr, std::memory_order_acq_rel);
  if (next == nullptr) return;
  tick.change(*next);
  for (const auto& probe : further) probe->tick.change(*next);
}

void ServoLoop::Impl::run_maintenance() {
  std::unique_lock lock(mutex);
  while (!maintenance_ending) {
    KeptScenes::Released old = sweep();
    lock.unlock();
    old.clear();
    if (guardian) unguarded = !guardian->keep_alive();
    lock.lock();
    if (!maintenance_ending) maintenance_wake.wait_for(lock, kMaintenancePeriod);
  }
}

KeptScenes::Released ServoLoop::Impl::sweep() {
  KeptScenes::Released old_scenes;
  while (const auto old = retired.take()) scenes.release(*old, old_scenes);
  while (const auto timing = timings.take()) {
    periods.record_ns(static_cast<double>(timing->period_ns));
    computes.record_ns(static_cast<double>(timing->compute_ns));
  }
  counts_out.take(seen);
  return old_scenes;
}

ServoLoop::ServoLoop(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
ServoLoop::~ServoLoop() { stop(); }

Result<std::unique_ptr<ServoLoop>> ServoLoop::start(std::unique_ptr<device::Device> device, HapticScene scene,
                                                    const ServoOptions& options,
                                                    std::vector<std::unique_ptr<device::Device>> further) {
  PALPABLE_CHECK(device != nullptr && scene.touchable != nullptr);
  PALPABLE_CHECK(further.size() < kMaxLiveProbes);
  for (const auto& probe : further) PALPABLE_CHECK(probe != nullptr && !probe->traits().pushes_back);
  if (auto valid = check(options); !valid) return std::move(valid).error();
  if (auto valid = device::check(device->traits()); !valid) return std::move(valid).error();
  for (const auto& probe : further)
    if (auto valid = device::check(probe->traits()); !valid) return std::move(valid).error();
  scene.touchable->touch_pages();
  auto impl = std::make_unique<Impl>(std::move(device), std::move(scene), options, std::move(further));
  impl->real_time.memory = options.memory == Memory::lock ? lock_memory() : "not locked (not asked for)";
  if (auto guarded = impl->start_guardian(); !guarded) return std::move(guarded).error();
  // From here on the loop's end joins what runs: the system may give one thread and refuse the next.
  std::unique_ptr<ServoLoop> loop(new ServoLoop(std::move(impl)));
  loop->impl_->start_threads();
  return loop;
}

void ServoLoop::change(HapticScene scene) {
  PALPABLE_CHECK(scene.touchable != nullptr);
  scene.touchable->touch_pages();
  auto& it = *impl_;
  KeptScenes::Released freed_last;
  const std::lock_guard lock(it.mutex);
  const HapticScene* unused =
      it.waiting.exchange(&it.scenes.keep(std::move(scene)), std::memory_order_acq_rel);
  if (unused != nullptr) it.scenes.release(unused, freed_last);
}

void ServoLoop::pause() { impl_->paused = true; }
void ServoLoop::resume() { impl_->paused = false; }

void ServoLoop::stop() {
  auto& it = *impl_;
  it.ending = true;
  if (it.servo.joinable()) it.servo.join();
  {
    const std::lock_guard lock(it.mutex);
    it.maintenance_ending = true;
  }
  it.maintenance_wake.notify_all();
  if (it.maintenance.joinable()) it.maintenance.join();
  KeptScenes::Released freed_last;
  const std::lock_guard lock(it.mutex);
  freed_last = it.sweep();
}

std::optional<TouchSample> ServoLoop::take_latest(std::size_t probe) {
  if (probe > impl_->further.size()) return std::nullopt;
  TouchSample sample;
  auto& latest = probe == 0 ? impl_->latest : impl_->further[probe - 1]->latest;
  return latest.take(sample) ? std::optional(sample) : std::nullopt;
}
std::optional<TouchEvent> ServoLoop::take_event() { return impl_->events.take(); }
std::optional<MissedDeadline> ServoLoop::take_missed() { return impl_->missed.take(); }
void ServoLoop::record(Recording recording) { impl_->recording = recording == Recording::on; }
bool ServoLoop::is_recording() const { return impl_->recording; }
std::optional<TouchSample> ServoLoop::take_recorded() { return impl_->recorded.take(); }
std::uint64_t ServoLoop::recording_lost() const { return impl_->recorded.refused(); }

ServoStatistics ServoLoop::statistics() const {
  auto& it = *impl_;
  KeptScenes::Released freed_last;
  const std::lock_guard lock(it.mutex);
  freed_last = it.sweep();
  const LoopCounts& seen = it.seen;
  const TickCounts& touch = seen.touch;
  ServoStatistics statistics;
  const double busy_s = seen.ran_s - seen.rested_s;
  statistics.rate_hz = busy_s > 0.0 ? static_cast<double>(touch.ticks - seen.rest_ticks) / busy_s : 0.0;
  statistics.rested_s = seen.rested_s;
  statistics.rest_ticks = seen.rest_ticks;
  statistics.missed = seen.missed;
  statistics.missed_by_cause = seen.missed_by_cause;
  statistics.period_us = in_us(it.periods.summary());
  statistics.compute_us = in_us(it.computes.summary());
  statistics.touch = touch;
  statistics.allocations_in_ticks = seen.allocations;
  return statistics;
}

RealTimeOutcome ServoLoop::real_time() const {
  const std::lock_guard lock(impl_->mutex);
  return impl_->real_time;
}
const device::Traits& ServoLoop::device_traits() const { return impl_->device->traits(); }
device::Status ServoLoop::device_status() const { return impl_->status.load(std::memory_order_relaxed); }
std::string ServoLoop::device_fault() const { return impl_->device->fault(); }
std::string ServoLoop::device_guidance() const { return impl_->device->guidance(); }

}  // namespace palpable::haptics
