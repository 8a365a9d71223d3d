// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/device/recording/replay.hpp"

#include "palpable/device/open_options.hpp"
#include "palpable/device/recording/traits_json.hpp"
#include "palpable/device/url.hpp"

#include <utility>

namespace palpable::device {

ReplayDevice::ReplayDevice(std::vector<TouchSample> ticks, const Traits& traits)
    : traits_(traits), ticks_(std::move(ticks)) {
  PALPABLE_CHECK(!ticks_.empty());
}

Reading ReplayDevice::read() noexcept {
  if (next_ < ticks_.size()) return recorded_reading(ticks_[next_++]);
  Reading ended = recorded_reading(ticks_.back());
  ended.status = Status::stale;
  ended.recorded.reset();
  return ended;
}

Reading recorded_reading(const TouchSample& tick) noexcept {
  return {tick.device_position, tick.status, tick.buttons, tick.device_rotation,
          RecordedTime{tick.t_s, tick.dt_s, tick.flags}};
}

Result<std::unique_ptr<Device>> open_replay(DeviceUrl& url, const OpenOptions& options) {
  if (auto valid = url.finish(); !valid) return std::move(valid).error();
  if (url.path().empty())
    return Error{ErrorCode::usage, "needs the recording's file: replay:FILE", "replay:"};
  auto recording = read_recording(url.path());
  if (!recording) return std::move(recording).error();
  if (recording->ticks.empty()) return invalid_input("is a recording without a tick", url.path());
  auto traits = recorded_traits(recording->header_json);
  if (!traits) {
    traits.emplace();
    traits->rate_hz = options.rate_hz;
    traits->pushes_back = false;
  }
  traits->name = traits->name.empty() ? "replay" : "replay of " + traits->name;
  return std::unique_ptr<Device>(std::make_unique<ReplayDevice>(std::move(recording->ticks), *traits));
}

}  // namespace palpable::device
