// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/session/touch/recorder.hpp"

#include "palpable/core/check.hpp"

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>
#include <vector>

namespace palpable::session {
namespace {

/// Interval at which the ring is emptied. A killed program loses at most this much of its recording.
constexpr auto kInterval = std::chrono::milliseconds(50);
/// Number of ticks that are written together. This bounds the memory after a long delay.
constexpr std::size_t kTogether = 512;

}  // namespace

struct Recorder::Impl {
  void run();
  void write_what_came();

  haptics::ServoLoop* loop = nullptr;
  std::unique_ptr<device::RecordingWriter> writer;
  std::mutex mutex;
  std::condition_variable rest;
  bool ending = false;
  std::vector<device::RecordedScene> scenes;
  /// The first write error, until it is taken.
  std::optional<Error> fault;
  // Used only by the thread.
  std::vector<device::TouchSample> ticks;
  Result<void> outcome;
  std::thread thread;
};

void Recorder::Impl::run() {
  std::unique_lock lock(mutex);
  while (!ending) {
    rest.wait_for(lock, kInterval, [&] { return ending; });
    lock.unlock();
    write_what_came();
    lock.lock();
  }
}

void Recorder::Impl::write_what_came() {
  const bool went_well = outcome.has_value();
  do {
    ticks.clear();
    while (ticks.size() < kTogether)
      if (const auto sample = loop->take_recorded())
        ticks.push_back(*sample);
      else
        break;
    // A scene is noted before the servo gets it. So all scenes of these ticks are noted now, but not before
    // they were taken; and a scene is written before its ticks.
    std::vector<device::RecordedScene> noted;
    {
      const std::lock_guard lock(mutex);
      noted.swap(scenes);
    }
    for (const auto& scene : noted)
      if (outcome) outcome = writer->write(scene);
    if (outcome && !ticks.empty()) outcome = writer->write(ticks);
  } while (ticks.size() == kTogether);
  if (went_well && !outcome) {
    const std::lock_guard lock(mutex);
    fault = outcome.error();
  }
}

Recorder::Recorder(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}

Result<std::unique_ptr<Recorder>> Recorder::start(haptics::ServoLoop& loop, const std::filesystem::path& file,
                                                  const std::string& header_json,
                                                  const device::RecordedScene& scene) {
  PALPABLE_CHECK(loop.is_recording());
  auto writer = device::RecordingWriter::create(file, header_json);
  if (!writer) return std::move(writer).error();
  auto impl = std::make_unique<Impl>();
  impl->loop = &loop;
  impl->writer = std::move(*writer);
  impl->scenes.push_back(scene);
  impl->thread = std::thread([&it = *impl] { it.run(); });
  return std::unique_ptr<Recorder>(new Recorder(std::move(impl)));
}

Recorder::~Recorder() { static_cast<void>(finish()); }

void Recorder::note(const device::RecordedScene& scene) {
  const std::lock_guard lock(impl_->mutex);
  impl_->scenes.push_back(scene);
}

std::optional<Error> Recorder::take_fault() {
  const std::lock_guard lock(impl_->mutex);
  return std::exchange(impl_->fault, std::nullopt);
}

Result<void> Recorder::finish() {
  auto& it = *impl_;
  if (!it.thread.joinable()) return it.outcome;
  it.loop->record(haptics::Recording::off);
  {
    const std::lock_guard lock(it.mutex);
    it.ending = true;
  }
  it.rest.notify_all();
  it.thread.join();
  it.write_what_came();
  if (it.outcome) it.outcome = it.writer->finish(it.loop->recording_lost());
  return it.outcome;
}

}  // namespace palpable::session
