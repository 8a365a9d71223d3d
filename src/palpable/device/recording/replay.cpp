// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/device/recording/replay.hpp"

#include "palpable/device/open_options.hpp"
#include "palpable/device/url.hpp"

#include <utility>

namespace palpable::device {

ReplayDevice::ReplayDevice(std::vector<TouchSample> ticks, const Traits& traits)
    : traits_(traits), ticks_(std::move(ticks)) {
  PALPABLE_CHECK(!ticks_.empty());
}

Reading ReplayDevice::read() noexcept {
  const bool ended = next_ >= ticks_.size();
  const TouchSample& tick = ended ? ticks_.back() : ticks_[next_++];
  return {tick.device_position, ended ? Status::stale : tick.status, tick.buttons};
}

Result<std::unique_ptr<Device>> open_replay(DeviceUrl& url, const OpenOptions& options) {
  if (auto sound = url.finish(); !sound) return std::move(sound).error();
  if (url.path().empty())
    return Error{ErrorCode::usage, "needs the recording's file: replay:FILE", "replay:"};
  auto recording = read_recording(url.path());
  if (!recording) return std::move(recording).error();
  if (recording->ticks.empty()) return invalid_input("is a recording without a tick", url.path());
  Traits traits;
  traits.name = "replay";
  traits.rate_hz = options.rate_hz;
  traits.pushes_back = false;
  return std::unique_ptr<Device>(std::make_unique<ReplayDevice>(std::move(recording->ticks), traits));
}

}  // namespace palpable::device
