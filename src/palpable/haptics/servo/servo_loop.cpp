// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/haptics/servo/servo_loop.hpp"

#include "palpable/core/allocations.hpp"
#include "palpable/core/hand_off.hpp"
#include "palpable/haptics/safety/zero_force.hpp"
#include "palpable/haptics/servo/latency_recorder.hpp"
#include "palpable/haptics/servo/pacing.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <string>
#include <thread>
#include <utility>
#include <vector>

namespace palpable::haptics {
namespace {

constexpr std::size_t kEvents = 1024;
constexpr std::size_t kTimings = 8192;
constexpr std::size_t kRetired = 16;
constexpr auto kHousekeeping = std::chrono::milliseconds(50);

/// How long one tick took and how far it stands from the one before.
struct Timing {
  std::int64_t period_ns = 0;
  std::int64_t compute_ns = 0;
};

/// What the loop counts beside the tick's own counts.
struct LoopCounts {
  TickCounts touch;
  std::uint64_t missed = 0;
  std::array<std::uint64_t, 4> missed_by_cause{};
  std::uint64_t allocations = 0;
  double ran_s = 0.0;
};

Percentiles in_us(const LatencySummary& summary) {
  return {1e-3 * summary.p50_ns, 1e-3 * summary.p99_ns, 1e-3 * summary.p99_9_ns, 1e-3 * summary.max_ns};
}

Result<void> check(const ServoOptions& options) {
  const auto usage = [](std::string message) { return Error{ErrorCode::usage, std::move(message), {}}; };
  if (!(options.rate_hz >= 100.0 && options.rate_hz <= 4000.0))
    return usage("the loop rate must be 100 to 4000 Hz");
  if (!(options.tick.max_force_N > 0.0)) return usage("the greatest force must be above 0 N");
  if (!(options.tick.max_force_rate_N_per_s > 0.0))
    return usage("the greatest force rate must be above 0 N/s");
  if (!(options.tick.fade_s > 0.0 && options.tick.ramp_down_s > 0.0 && options.tick.ramp_up_s > 0.0))
    return usage("fade and ramp times must be above 0 s");
  if (options.realtime_priority < 0 || options.realtime_priority > 99)
    return usage("the real-time priority must be 0 to 99");
  if (!(options.watch_s >= 0.0 && options.watch_s <= 0.5 / options.rate_hz))
    return usage("the time to watch the clock must be 0 to half a period");
  return {};
}

}  // namespace

/// One of several probes besides the hand.
struct FurtherProbe {
  FurtherProbe(std::unique_ptr<device::Device> opened, const Program& first, const TickOptions& options,
               Ring<TouchEvent>& events, std::uint8_t number)
      : device(std::move(opened)), tick(*device, first, options, events, number) {}

  std::unique_ptr<device::Device> device;
  Tick tick;
  LatestValue<TouchSample> latest;
};

/// Three threads meet here: the servo, the housekeeper (ordinary priority: frees, sums up), and the callers.
struct ServoLoop::Inside {
  Inside(std::unique_ptr<device::Device> opened, Program first, const ServoOptions& wanted,
         std::vector<std::unique_ptr<device::Device>> more)
      : options(wanted),
        device(std::move(opened)),
        recorded(wanted.recording_capacity),
        tick(*device, own(std::move(first)), options.tick, events) {
    for (auto& next : more)
      further.push_back(std::make_unique<FurtherProbe>(std::move(next), *programs.front(), options.tick,
                                                       events,
                                                       static_cast<std::uint8_t>(further.size() + 1)));
  }

  const Program& own(Program program);

  void serve();
  void tick_once(const Pacer::Wake& wake, double dt_s);
  void tick_further(double dt_s);
  void note_missed(const Pacer::Wake& wake);
  void swap_programs();
  void keep_house();
  void sweep();

  const ServoOptions options;
  std::unique_ptr<device::Device> device;

  // From the servo to others.
  LatestValue<TouchSample> latest;
  LatestValue<LoopCounts> counts_out;
  Ring<TouchEvent> events{kEvents};
  Ring<MissedDeadline> missed{kEvents};
  Ring<TouchSample> recorded;
  Ring<Timing> timings{kTimings};
  Ring<const Program*> retired{kRetired};

  // From others to the servo.
  std::atomic<const Program*> waiting{nullptr};
  std::atomic<bool> ending{false};
  std::atomic<bool> paused{false};
  std::atomic<bool> recording{false};

  // The housekeeper's and the callers', under the mutex.
  mutable std::mutex mutex;
  /// Every program that the servo may still use.
  std::vector<std::unique_ptr<const Program>> programs;
  std::condition_variable house_rest;
  bool house_ending = false;
  LatencyRecorder periods;
  LatencyRecorder computes;
  LoopCounts seen;
  RealTimeOutcome real_time;

  // The servo's own.
  Tick tick;
  std::vector<std::unique_ptr<FurtherProbe>> further;
  LoopCounts counts;
  std::int64_t begin_ns = 0;

  std::thread servo;
  std::thread housekeeper;
};

void ServoLoop::Inside::serve() {
  const RunningServo self(*device);
  {
    std::string priority = request_priority(options.realtime_priority);
    const std::lock_guard lock(mutex);
    real_time.priority = std::move(priority);
  }
  flush_denormals();
  touch_stack();
  Pacer pacer(options.rate_hz, options.watch_s);
  pacer.begin();
  begin_ns = monotonic_ns();
  std::int64_t before_ns = begin_ns;
  // From here to the end of the loop nothing allocates: what does is counted tick by tick and reported.
  while (!ending.load(std::memory_order_relaxed) && !self.must_end()) {
    const Pacer::Wake wake = pacer.wait();
    const AllocationScope allocations;
    const std::int64_t period_ns = wake.now_ns - before_ns;
    before_ns = wake.now_ns;
    if (wake.periods > 1) note_missed(wake);
    swap_programs();
    tick_once(wake, 1e-9 * static_cast<double>(period_ns));
    counts.allocations += allocations.count();
    counts_out.put(counts);
    timings.put({period_ns, monotonic_ns() - wake.now_ns});
  }
  device->write({});
  device->stop();
}

void ServoLoop::Inside::tick_once(const Pacer::Wake& wake, double dt_s) {
  // A wake that came late and the one after it may be almost nothing apart: no law is made for that.
  const double shortest_s = 0.1 / options.rate_hz;
  tick.set_paused(paused.load(std::memory_order_relaxed));
  counts.ran_s = 1e-9 * static_cast<double>(wake.now_ns - begin_ns);
  const TouchSample& sample = tick.step(counts.ran_s, std::max(dt_s, shortest_s));
  counts.touch = tick.counts();
  latest.put(sample);
  if (recording.load(std::memory_order_relaxed)) recorded.put(sample);
  tick_further(std::max(dt_s, shortest_s));
  // Not before: until here the further probes may have been at it.
  if (const Program* old = tick.take_retired()) retired.put(old);
}

void ServoLoop::Inside::tick_further(double dt_s) {
  for (const auto& probe : further) {
    probe->tick.set_paused(paused.load(std::memory_order_relaxed));
    const TouchSample& sample = probe->tick.step(counts.ran_s, dt_s);
    // All probes fade in step with the hand, who hands the old program back.
    probe->tick.take_retired();
    probe->latest.put(sample);
    if (is_there(sample) && recording.load(std::memory_order_relaxed)) recorded.put(sample);
  }
}

void ServoLoop::Inside::note_missed(const Pacer::Wake& wake) {
  counts.missed += wake.periods - 1;
  counts.missed_by_cause[static_cast<std::size_t>(wake.cause)] += wake.periods - 1;
  missed.put({counts.touch.ticks, wake.periods - 1, wake.late_us, wake.cause});
}

void ServoLoop::Inside::swap_programs() {
  // Room for the old one is made sure of first: the servo must never be left holding what it may not free.
  if (tick.fading() || !retired.has_room()) return;
  if (waiting.load(std::memory_order_relaxed) == nullptr) return;
  const Program* next = waiting.exchange(nullptr, std::memory_order_acq_rel);
  if (next == nullptr) return;
  tick.change(*next);
  for (const auto& probe : further) probe->tick.change(*next);
}

void ServoLoop::Inside::keep_house() {
  std::unique_lock lock(mutex);
  while (!house_ending) {
    sweep();
    house_rest.wait_for(lock, kHousekeeping);
  }
}

const Program& ServoLoop::Inside::own(Program program) {
  programs.push_back(std::make_unique<const Program>(std::move(program)));
  return *programs.back();
}

void ServoLoop::Inside::sweep() {
  while (const auto old = retired.take())
    std::erase_if(programs, [&](const auto& p) { return p.get() == *old; });
  while (const auto timing = timings.take()) {
    periods.record_ns(static_cast<double>(timing->period_ns));
    computes.record_ns(static_cast<double>(timing->compute_ns));
  }
  counts_out.take(seen);
}

ServoLoop::ServoLoop(std::unique_ptr<Inside> inside) : inside_(std::move(inside)) {}
ServoLoop::~ServoLoop() { stop(); }

Result<std::unique_ptr<ServoLoop>> ServoLoop::start(std::unique_ptr<device::Device> device, Program program,
                                                    const ServoOptions& options,
                                                    std::vector<std::unique_ptr<device::Device>> further) {
  PALPABLE_CHECK(device != nullptr && program.touchable != nullptr);
  PALPABLE_CHECK(further.size() < kMostLiveProbes);
  for (const auto& probe : further) PALPABLE_CHECK(probe != nullptr && !probe->traits().pushes_back);
  if (auto sound = check(options); !sound) return std::move(sound).error();
  program.touchable->touch_pages();
  auto inside = std::make_unique<Inside>(std::move(device), std::move(program), options, std::move(further));
  inside->real_time.memory = options.memory == Memory::lock ? lock_memory() : "not locked (not asked for)";
  inside->servo = std::thread([&it = *inside] { it.serve(); });
  inside->housekeeper = std::thread([&it = *inside] { it.keep_house(); });
  return std::unique_ptr<ServoLoop>(new ServoLoop(std::move(inside)));
}

void ServoLoop::change(Program program) {
  PALPABLE_CHECK(program.touchable != nullptr);
  program.touchable->touch_pages();
  auto& it = *inside_;
  const std::lock_guard lock(it.mutex);
  const Program* unused = it.waiting.exchange(&it.own(std::move(program)), std::memory_order_acq_rel);
  std::erase_if(it.programs, [&](const auto& p) { return unused != nullptr && p.get() == unused; });
}

void ServoLoop::pause() { inside_->paused = true; }
void ServoLoop::resume() { inside_->paused = false; }

void ServoLoop::stop() {
  auto& it = *inside_;
  it.ending = true;
  if (it.servo.joinable()) it.servo.join();
  {
    const std::lock_guard lock(it.mutex);
    it.house_ending = true;
  }
  it.house_rest.notify_all();
  if (it.housekeeper.joinable()) it.housekeeper.join();
  const std::lock_guard lock(it.mutex);
  it.sweep();
}

std::optional<TouchSample> ServoLoop::take_latest(std::size_t probe) {
  if (probe > inside_->further.size()) return std::nullopt;
  TouchSample sample;
  auto& latest = probe == 0 ? inside_->latest : inside_->further[probe - 1]->latest;
  return latest.take(sample) ? std::optional(sample) : std::nullopt;
}
std::optional<TouchEvent> ServoLoop::take_event() { return inside_->events.take(); }
std::optional<MissedDeadline> ServoLoop::take_missed() { return inside_->missed.take(); }
void ServoLoop::record(Recording recording) { inside_->recording = recording == Recording::on; }
std::optional<TouchSample> ServoLoop::take_recorded() { return inside_->recorded.take(); }
std::uint64_t ServoLoop::recording_lost() const { return inside_->recorded.refused(); }

ServoStatistics ServoLoop::statistics() const {
  auto& it = *inside_;
  const std::lock_guard lock(it.mutex);
  it.sweep();
  const LoopCounts& seen = it.seen;
  const TickCounts& touch = seen.touch;
  ServoStatistics statistics;
  statistics.rate_hz = seen.ran_s > 0.0 ? static_cast<double>(touch.ticks) / seen.ran_s : 0.0;
  statistics.missed = seen.missed;
  statistics.missed_by_cause = seen.missed_by_cause;
  statistics.period_us = in_us(it.periods.summary());
  statistics.compute_us = in_us(it.computes.summary());
  statistics.touch = touch;
  statistics.allocations_in_ticks = seen.allocations;
  return statistics;
}

RealTimeOutcome ServoLoop::real_time() const {
  const std::lock_guard lock(inside_->mutex);
  return inside_->real_time;
}
const device::Traits& ServoLoop::device_traits() const { return inside_->device->traits(); }
std::string ServoLoop::device_fault() const { return inside_->device->fault(); }

}  // namespace palpable::haptics
