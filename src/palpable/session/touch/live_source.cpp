// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/session/touch/live_source.hpp"

#include "palpable/device/url.hpp"
#include "palpable/sources/live/frame_folder.hpp"

#include <algorithm>
#include <array>
#include <string_view>
#include <thread>
#include <utility>

#include <fmt/format.h>

namespace palpable::session {
namespace {

using Clock = std::chrono::steady_clock;

/// The frames of a folder, one a period from the first take() on.
class PacedFrames : public LiveSource {
 public:
  PacedFrames(sources::FrameFolder folder, double rate_hz, bool repeats)
      : folder_(std::move(folder)),
        period_(std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(1.0 / rate_hz))),
        repeats_(repeats) {}

  Result<std::optional<LiveFrame>> take(Clock::time_point deadline) override {
    if (!begin_) begin_ = Clock::now();
    if (has_ended()) return std::optional<LiveFrame>();
    const auto next = *begin_ + static_cast<Clock::rep>(next_) * period_;
    std::this_thread::sleep_until(std::min(next, deadline));
    const auto now = Clock::now();
    if (now < next) return std::optional<LiveFrame>();
    auto newest = static_cast<std::uint64_t>((now - *begin_) / period_);
    if (!repeats_) newest = std::min<std::uint64_t>(newest, folder_.size() - 1);
    next_ = newest + 1;
    auto depth = folder_.depth(index_of(newest));
    if (!depth) return std::move(depth).error();
    const auto arrival = *begin_ + static_cast<Clock::rep>(newest) * period_;
    return std::optional(LiveFrame{newest, arrival, *std::move(depth)});
  }

  bool has_ended() const override { return !repeats_ && next_ >= folder_.size(); }

  std::optional<Image> colour() override {
    if (next_ == 0) return std::nullopt;
    auto picture = folder_.colour(index_of(next_ - 1));
    return picture ? std::optional(*std::move(picture)) : std::nullopt;
  }

 private:
  std::size_t index_of(std::uint64_t number) const { return number % folder_.size(); }

  sources::FrameFolder folder_;
  Clock::duration period_;
  bool repeats_;
  std::optional<Clock::time_point> begin_;
  std::uint64_t next_ = 0;
};

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

Result<std::unique_ptr<LiveSource>> open_live_source(const std::string& address) {
  const auto parsed = parse_frames_address(address);
  if (!parsed) return parsed.error();
  auto folder = sources::FrameFolder::open(parsed->folder);
  if (!folder) return std::move(folder).error();
  return std::unique_ptr<LiveSource>(
      std::make_unique<PacedFrames>(*std::move(folder), parsed->rate_hz, parsed->repeats));
}

}  // namespace palpable::session
