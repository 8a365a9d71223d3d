// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/haptics/servo/servo_loop.hpp"

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

namespace palpable::haptics {

/// A ServoLoop whose device is opened again after it has failed, for example when it was unplugged: the loop
/// ends with zero force, its device and guardian are closed, and as soon as the device can be opened a new
/// loop begins on the same scene, whose force rises from zero as at every beginning. A device that only was
/// silent for a while goes on without that, with a ramp. Methods as those of ServoLoop; between two loops
/// nothing is new, and changes are kept for the next. A recording ends with the first loop.
class ReopeningLoop {
 public:
  /// Opens the same device again. Called by a thread of this class until it succeeds.
  using Open = std::function<Result<std::unique_ptr<device::Device>>()>;
  /// Makes the devices of the further probes of a loop.
  using Further = std::function<std::vector<std::unique_ptr<device::Device>>()>;
  /// A device that has failed for this long is closed and opened again.
  static constexpr std::chrono::milliseconds kFailedFor{1000};
  static constexpr std::chrono::milliseconds kBetweenTries{500};

  /// As ServoLoop::start(). `open` empty: the device is not opened again; `further` may be empty.
  static Result<std::unique_ptr<ReopeningLoop>> start(std::unique_ptr<device::Device> device,
                                                      HapticScene scene, const ServoOptions& options,
                                                      Open open, Further further = {});
  ~ReopeningLoop();
  ReopeningLoop(const ReopeningLoop&) = delete;
  ReopeningLoop& operator=(const ReopeningLoop&) = delete;

  void change(HapticScene scene);
  void pause();
  void resume();
  void stop();
  std::optional<TouchSample> take_latest(std::size_t probe = 0);
  /// A new loop begins with the event `recovered`.
  std::optional<TouchEvent> take_event();
  std::optional<MissedDeadline> take_missed();
  void record(Recording recording);
  bool is_recording() const;
  std::optional<TouchSample> take_recorded();
  std::uint64_t recording_lost() const;
  ServoStatistics statistics() const;
  RealTimeOutcome real_time() const;
  const device::Traits& device_traits() const { return traits_; }
  std::string device_fault() const;
  std::string device_guidance() const;
  /// How often the device was opened again.
  int reopened() const { return reopened_.load(); }

 private:
  using Clock = std::chrono::steady_clock;
  ReopeningLoop(HapticScene scene, const ServoOptions& options, Open open, Further further)
      : scene_(std::move(scene)), options_(options), open_(std::move(open)), further_(std::move(further)) {}
  std::shared_ptr<ServoLoop> loop() const;
  void watch();
  /// Waits between two looks; false at the end.
  bool wait(std::chrono::milliseconds longest);
  void close_failed();
  void try_to_open();

  mutable std::mutex mutex_;
  std::condition_variable wake_;
  bool ending_ = false;
  std::shared_ptr<ServoLoop> loop_;
  /// What the next loop begins with.
  HapticScene scene_;
  bool paused_ = false;
  /// Of the last loop.
  ServoStatistics last_statistics_;
  RealTimeOutcome last_real_time_;
  std::string trouble_;
  ServoOptions options_;
  Open open_;
  Further further_;
  device::Traits traits_;
  std::atomic<int> reopened_{0};
  std::atomic<int> untold_{0};
  std::thread watcher_;
};

}  // namespace palpable::haptics
