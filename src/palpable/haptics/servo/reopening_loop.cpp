// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/haptics/servo/reopening_loop.hpp"

#include <utility>

namespace palpable::haptics {
namespace {

constexpr auto kReopenLook = std::chrono::milliseconds(50);

std::vector<std::unique_ptr<device::Device>> made(const ReopeningLoop::Further& further) {
  return further ? further() : std::vector<std::unique_ptr<device::Device>>{};
}

/// Whether a device can continue the touch of another: the scene's placement and the law depend on these.
bool is_same_kind(const device::Traits& a, const device::Traits& b) {
  return a.degrees_of_freedom == b.degrees_of_freedom && a.workspace_m == b.workspace_m &&
         a.max_force_N == b.max_force_N && a.has_torque == b.has_torque;
}

}  // namespace

Result<std::unique_ptr<ReopeningLoop>> ReopeningLoop::start(std::unique_ptr<device::Device> device,
                                                            HapticScene scene, const ServoOptions& options,
                                                            Open open, Further further) {
  auto first = ServoLoop::start(std::move(device), scene, options, made(further));
  if (!first) return std::move(first).error();
  std::unique_ptr<ReopeningLoop> it(
      new ReopeningLoop(std::move(scene), options, std::move(open), std::move(further)));
  it->traits_ = (*first)->device_traits();
  it->loop_ = *std::move(first);
  it->options_.recording = Recording::off;
  if (it->open_) it->watcher_ = std::thread([&self = *it] { self.watch(); });
  return it;
}

ReopeningLoop::~ReopeningLoop() { stop(); }

std::shared_ptr<ServoLoop> ReopeningLoop::loop() const {
  const std::lock_guard lock(mutex_);
  return loop_;
}

void ReopeningLoop::change(HapticScene scene) {
  // Under the lock, so that no loop begins with an older scene.
  const std::lock_guard lock(mutex_);
  scene_ = scene;
  if (loop_) loop_->change(std::move(scene));
}

void ReopeningLoop::pause() {
  const std::lock_guard lock(mutex_);
  paused_ = true;
  if (loop_) loop_->pause();
}

void ReopeningLoop::resume() {
  const std::lock_guard lock(mutex_);
  paused_ = false;
  if (loop_) loop_->resume();
}

void ReopeningLoop::stop() {
  {
    const std::lock_guard lock(mutex_);
    ending_ = true;
  }
  wake_.notify_all();
  if (watcher_.joinable()) watcher_.join();
  if (const auto last = loop()) last->stop();
}

bool ReopeningLoop::wait(std::chrono::milliseconds longest) {
  std::unique_lock lock(mutex_);
  return !wake_.wait_for(lock, longest, [this] { return ending_; });
}

void ReopeningLoop::watch() {
  std::optional<Clock::time_point> failed_since;
  while (wait(loop() ? kReopenLook : kBetweenTries)) {
    auto current = loop();
    if (!current) {
      try_to_open();
      continue;
    }
    if (current->device_status() != device::Status::fault) {
      failed_since.reset();
      continue;
    }
    if (!failed_since) failed_since = Clock::now();
    if (Clock::now() - *failed_since < kFailedFor) continue;
    failed_since.reset();
    // Else the loop would not be freed.
    current.reset();
    close_failed();
  }
}

void ReopeningLoop::close_failed() {
  std::shared_ptr<ServoLoop> failed;
  {
    const std::lock_guard lock(mutex_);
    failed = std::exchange(loop_, nullptr);
    trouble_ = failed->device_fault();
  }
  failed->stop();
  const ServoStatistics statistics = failed->statistics();
  const RealTimeOutcome real_time = failed->real_time();
  {
    const std::lock_guard lock(mutex_);
    last_statistics_ = statistics;
    last_real_time_ = real_time;
    options_.tick.heat = statistics.touch.heat;
  }
  // A caller may still hold it for a moment: the device must be closed before it can be opened again.
  while (failed.use_count() > 1 && wait(std::chrono::milliseconds(1))) {
  }
}

void ReopeningLoop::try_to_open() {
  auto device = open_();
  if (!device) return;
  if (!is_same_kind((*device)->traits(), traits_)) {
    const std::lock_guard lock(mutex_);
    trouble_ = "the device that answers now is another one; end the touch and begin it again";
    return;
  }
  HapticScene scene;
  {
    const std::lock_guard lock(mutex_);
    scene = scene_;
  }
  const auto begun_with = scene.touchable;
  auto next = ServoLoop::start(*std::move(device), std::move(scene), options_, made(further_));
  if (!next) {
    const std::lock_guard lock(mutex_);
    trouble_ = next.error().sentence();
    return;
  }
  const std::lock_guard lock(mutex_);
  if (paused_) (*next)->pause();
  if (scene_.touchable != begun_with) (*next)->change(scene_);
  loop_ = *std::move(next);
  trouble_.clear();
  ++reopened_;
  ++untold_;
}

std::optional<TouchSample> ReopeningLoop::take_latest(std::size_t probe) {
  const auto current = loop();
  return current ? current->take_latest(probe) : std::nullopt;
}

std::optional<TouchEvent> ReopeningLoop::take_event() {
  const auto current = loop();
  if (current && untold_.load() > 0) {
    --untold_;
    return TouchEvent{0, TouchEvent::Kind::recovered, 0, 0};
  }
  return current ? current->take_event() : std::nullopt;
}

std::optional<MissedDeadline> ReopeningLoop::take_missed() {
  const auto current = loop();
  return current ? current->take_missed() : std::nullopt;
}

void ReopeningLoop::record(Recording recording) {
  if (const auto current = loop()) current->record(recording);
}

bool ReopeningLoop::is_recording() const {
  const auto current = loop();
  return current && current->is_recording();
}

std::optional<TouchSample> ReopeningLoop::take_recorded() {
  const auto current = loop();
  return current ? current->take_recorded() : std::nullopt;
}

std::uint64_t ReopeningLoop::recording_lost() const {
  const auto current = loop();
  return current ? current->recording_lost() : 0;
}

ServoStatistics ReopeningLoop::statistics() const {
  if (const auto current = loop()) return current->statistics();
  const std::lock_guard lock(mutex_);
  return last_statistics_;
}

RealTimeOutcome ReopeningLoop::real_time() const {
  if (const auto current = loop()) return current->real_time();
  const std::lock_guard lock(mutex_);
  return last_real_time_;
}

std::string ReopeningLoop::device_fault() const {
  if (const auto current = loop()) return current->device_fault();
  const std::lock_guard lock(mutex_);
  return trouble_;
}

std::string ReopeningLoop::device_guidance() const {
  if (const auto current = loop()) return current->device_guidance();
  return "The device is opened again as soon as it answers: plug it in, with its handle held as at the start "
         "of a touch";
}

}  // namespace palpable::haptics
