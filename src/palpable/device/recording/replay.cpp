// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/device/recording/replay.hpp"

#include "palpable/device/open_options.hpp"
#include "palpable/device/recording/traits_json.hpp"
#include "palpable/device/url.hpp"

#include <chrono>
#include <cmath>
#include <cstdint>
#include <string>
#include <utility>

namespace palpable::device {
namespace {

/// Eight seconds at 4 kHz.
constexpr std::size_t kAhead = std::size_t{1} << 15U;
constexpr auto kReadPeriod = std::chrono::milliseconds(100);

/// The end of a recording, checked to contain a tick and not to be damaged. A truncated recording is valid.
Result<RecordingEnd> end_of(const std::string& file) {
  const auto reader = RecordingReader::open(file);
  if (!reader) return reader.error();
  std::uint64_t ticks = 0;
  while (const Recording* piece = (*reader)->next()) ticks += piece->ticks.size();
  if (const auto valid = (*reader)->check_end(); !valid) return valid.error();
  if (ticks == 0) return invalid_input("is a recording without a tick", file);
  return (*reader)->end();
}

}  // namespace

ReplayDevice::ReplayDevice(std::unique_ptr<RecordingReader> reader, const Traits& traits)
    : traits_(traits), period_s_(1.0 / traits.rate_hz), reader_(std::move(reader)), ahead_(kAhead) {
  // Filled before the first tick, so that the machine's load does not matter.
  fill();
  thread_ = std::thread([this] { read_ahead(); });
}

ReplayDevice::~ReplayDevice() {
  ending_ = true;
  thread_.join();
}

void ReplayDevice::read_ahead() {
  while (!ending_.load(std::memory_order_relaxed)) {
    std::this_thread::sleep_for(kReadPeriod);
    fill();
  }
}

/// Reads until the ring is full or the recording ends.
void ReplayDevice::fill() {
  while (true) {
    while (piece_ == nullptr || next_ == piece_->ticks.size()) {
      if (reader_->end() != RecordingEnd::not_yet) return all_read_.store(true, std::memory_order_release);
      piece_ = reader_->next();
      next_ = 0;
      if (piece_ == nullptr) return all_read_.store(true, std::memory_order_release);
    }
    if (!ahead_.has_room()) return;
    ahead_.put(recorded_reading(piece_->ticks[next_++]));
  }
}

Reading ReplayDevice::read() noexcept {
  const bool all_read = all_read_.load(std::memory_order_acquire);
  if (const auto reading = ahead_.take()) return last_ = *reading;
  Reading ended = last_;
  ended.status = Status::stale;
  if (all_read) has_ended_.store(true, std::memory_order_relaxed);
  if (!all_read || !last_.recorded) {
    ended.recorded.reset();
    return ended;
  }
  // The recorded time goes on: the clock of whoever replays it is at another time.
  ended.recorded = RecordedTime{last_.recorded->t_s + period_s_, period_s_, 0};
  return last_ = ended;
}

std::string ReplayDevice::fault() const {
  return has_ended_.load(std::memory_order_relaxed) ? "the recording has ended" : std::string();
}

Reading recorded_reading(const TouchSample& tick) noexcept {
  return {tick.device_position, tick.status, tick.buttons, tick.device_rotation,
          RecordedTime{tick.t_s, tick.dt_s, tick.flags}};
}

Result<std::unique_ptr<Device>> open_replay(DeviceUrl& url, const OpenOptions& options) {
  if (auto valid = url.finish(); !valid) return std::move(valid).error();
  if (url.path().empty()) return Error{ErrorCode::usage, "needs the recording's file: replay:FILE", "replay"};
  const auto end = end_of(url.path());
  if (!end) return end.error();
  auto reader = RecordingReader::open(url.path());
  if (!reader) return std::move(reader).error();
  const std::string& header = (*reader)->header_json();
  if (options.check_header)
    if (auto valid = options.check_header(header); !valid)
      return invalid_input(valid.error().message, url.path());
  auto traits = recorded_traits(header);
  if (traits)
    if (auto valid = check(*traits); !valid) return invalid_input(valid.error().message, url.path());
  if (!traits) {
    traits.emplace();
    traits->rate_hz = options.rate_hz;
    traits->pushes_back = false;
  }
  if (std::isnan(traits->rate_hz)) traits->rate_hz = options.rate_hz;
  traits->name = traits->name.empty() ? "replay" : "replay of " + traits->name;
  if (*end == RecordingEnd::cut) traits->name += " (the recording was interrupted)";
  return std::unique_ptr<Device>(std::make_unique<ReplayDevice>(*std::move(reader), *traits));
}

}  // namespace palpable::device
