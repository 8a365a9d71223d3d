// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/session/touch/live_address.hpp"

#include "palpable/device/url.hpp"

#include <algorithm>
#include <array>
#include <string_view>

#include <fmt/format.h>

namespace palpable::session {
namespace {

/// The schemes of DESIGN's live sources, so that an address is never taken for the name of a file.
constexpr std::array<std::string_view, 10> kSchemes{
    "frames:", "camera:", "openni:", "freenect:", "realsense:", "rtsp:", "http:", "https:", "ros:", "robot:"};

}  // namespace

bool is_live_address(const std::string& input) {
  return std::any_of(kSchemes.begin(), kSchemes.end(),
                     [&](auto scheme) { return input.starts_with(scheme); });
}

Result<FramesAddress> parse_frames_address(const std::string& address) {
  auto url = device::DeviceUrl::parse(address);
  if (!url) return std::move(url).error();
  if (url->scheme() != "frames")
    return Error{
        ErrorCode::usage,
        fmt::format("live sources of the kind {}: are not supported yet; frames:FOLDER is", url->scheme()),
        address};
  const double rate_hz = url->take_number("fps", 30.0, 0.1, 240.0);
  const int repeats = url->take_count("loop", 0, 0, 1);
  if (auto finished = url->finish(); !finished) return std::move(finished).error();
  return FramesAddress{std::string(url->path()), rate_hz, repeats == 1};
}

}  // namespace palpable::session
