// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/session/touch/recorder.hpp"

#include "palpable/core/check.hpp"
#include "palpable/session/touch/recorded_parts.hpp"

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>

namespace palpable::session {
namespace {

/// Interval at which the ring is emptied. A killed program loses at most this much of its recording.
constexpr auto kInterval = std::chrono::milliseconds(50);

}  // namespace

struct Recorder::Impl {
  Impl(haptics::ReopeningLoop& recorded, std::unique_ptr<device::RecordingWriter> file)
      : loop(recorded), writer(std::move(file)), parts([this] { return loop.take_recorded(); }) {}
  void run();
  void write_what_came();

  haptics::ReopeningLoop& loop;
  std::unique_ptr<device::RecordingWriter> writer;
  RecordedParts parts;
  std::mutex mutex;
  std::condition_variable rest;
  bool ending = false;
  /// The first write error, until it is taken.
  std::optional<Error> fault;
  /// Of the whole recording, once it is finished.
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
  const bool went_well = parts.outcome().has_value();
  parts.write_to(*writer);
  if (!went_well || parts.outcome()) return;
  const std::lock_guard lock(mutex);
  fault = parts.outcome().error();
}

Recorder::Recorder(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}

Result<std::unique_ptr<Recorder>> Recorder::start(haptics::ReopeningLoop& loop,
                                                  const std::filesystem::path& file,
                                                  const std::string& header_json,
                                                  const device::RecordedScene& scene) {
  PALPABLE_CHECK(loop.is_recording());
  auto writer = device::RecordingWriter::create(file, header_json);
  if (!writer) return std::move(writer).error();
  auto impl = std::make_unique<Impl>(loop, std::move(*writer));
  impl->parts.note(scene);
  impl->thread = std::thread([&it = *impl] { it.run(); });
  return std::unique_ptr<Recorder>(new Recorder(std::move(impl)));
}

Recorder::~Recorder() { static_cast<void>(finish()); }

void Recorder::note(const device::RecordedScene& scene) { impl_->parts.note(scene); }

std::optional<Error> Recorder::take_fault() {
  const std::lock_guard lock(impl_->mutex);
  return std::exchange(impl_->fault, std::nullopt);
}

Result<void> Recorder::finish() {
  auto& it = *impl_;
  if (!it.thread.joinable()) return it.outcome;
  it.loop.record(haptics::Recording::off);
  {
    const std::lock_guard lock(it.mutex);
    it.ending = true;
  }
  it.rest.notify_all();
  it.thread.join();
  it.write_what_came();
  it.outcome = it.parts.outcome();
  if (it.outcome) it.outcome = it.writer->finish(it.loop.recording_lost());
  return it.outcome;
}

}  // namespace palpable::session
