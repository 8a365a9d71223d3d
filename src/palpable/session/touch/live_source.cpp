// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/session/touch/live_source.hpp"

#include "palpable/session/touch/camera_pairs.hpp"
#include "palpable/session/touch/depth_camera_source.hpp"
#include "palpable/session/touch/live_address.hpp"
#include "palpable/session/touch/matched_source.hpp"
#include "palpable/session/touch/recorded_pairs.hpp"
#include "palpable/session/touch/robot_source.hpp"
#include "palpable/session/touch/ros_eyes.hpp"
#include "palpable/sources/live/frame_folder.hpp"
#include "palpable/sources/live/video_device.hpp"

#include <algorithm>
#include <string_view>
#include <thread>
#include <utility>
#include <variant>

namespace palpable::session {
namespace {

using Clock = std::chrono::steady_clock;

/// Which of `count` frames a camera would have given by now, one a period from the first wait() on.
class Pacer {
 public:
  Pacer(std::size_t count, double rate_hz, bool repeats)
      : count_(count),
        period_(std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(1.0 / rate_hz))),
        repeats_(repeats) {}

  struct Due {
    std::uint64_t number = 0;
    std::size_t index = 0;
    Clock::time_point arrival;
  };
  /// The newest frame that was not due before; waits for one until `deadline`.
  std::optional<Due> wait(Clock::time_point deadline) {
    if (!begin_) begin_ = Clock::now();
    if (has_ended()) return std::nullopt;
    const auto next = *begin_ + static_cast<Clock::rep>(next_) * period_;
    std::this_thread::sleep_until(std::min(next, deadline));
    const auto now = Clock::now();
    if (now < next) return std::nullopt;
    auto newest = static_cast<std::uint64_t>((now - *begin_) / period_);
    if (!repeats_) newest = std::min<std::uint64_t>(newest, count_ - 1);
    next_ = newest + 1;
    return Due{newest, newest % count_, *begin_ + static_cast<Clock::rep>(newest) * period_};
  }
  bool has_ended() const { return !repeats_ && next_ >= count_; }

 private:
  std::size_t count_;
  Clock::duration period_;
  bool repeats_;
  std::optional<Clock::time_point> begin_;
  std::uint64_t next_ = 0;
};

class PacedDepths final : public LiveSource {
 public:
  PacedDepths(sources::FrameFolder folder, const FramesAddress& address)
      : folder_(std::move(folder)), pacer_(folder_.size(), address.rate_hz, address.repeats) {}

  Result<std::optional<LiveFrame>> take(Clock::time_point deadline) override {
    const auto due = pacer_.wait(deadline);
    if (!due) return std::optional<LiveFrame>();
    newest_ = due->index;
    auto depth = folder_.depth(due->index);
    if (!depth) return std::move(depth).error();
    auto pose = folder_.pose(due->index);
    if (!pose) return std::move(pose).error();
    return std::optional(LiveFrame{due->number, due->arrival, *std::move(depth), *pose});
  }
  bool has_ended() const override { return pacer_.has_ended(); }

  std::optional<Image> colour() override {
    if (!newest_) return std::nullopt;
    auto picture = folder_.colour(*newest_);
    return picture ? std::optional(*std::move(picture)) : std::nullopt;
  }

 private:
  sources::FrameFolder folder_;
  Pacer pacer_;
  std::optional<std::size_t> newest_;
};

class PacedPairs final : public PairSource {
 public:
  PacedPairs(sources::FrameFolder folder, const FramesAddress& address)
      : folder_(std::move(folder)), pacer_(folder_.size(), address.rate_hz, address.repeats) {}

  Result<std::optional<LivePair>> take(Clock::time_point deadline) override {
    const auto due = pacer_.wait(deadline);
    if (!due) return std::optional<LivePair>();
    auto pair = folder_.pair(due->index);
    if (!pair) return std::move(pair).error();
    return std::optional(
        LivePair{due->number, due->arrival, std::move(pair->first), std::move(pair->second)});
  }
  bool has_ended() const override { return pacer_.has_ended(); }

 private:
  sources::FrameFolder folder_;
  Pacer pacer_;
};

Result<std::unique_ptr<sources::CameraStream>> open_camera(const sources::HttpAddress& address) {
  return sources::CameraStream::open([address] { return sources::connect_http_camera(address); },
                                     address.shown);
}

Result<std::unique_ptr<sources::CameraStream>> open_camera(const sources::VideoDevice& device) {
  return sources::CameraStream::open(
      [device] { return sources::open_video_device(device); },
      device.number < 0 ? "camera:" : "camera:" + std::to_string(device.number));
}

Result<std::unique_ptr<sources::CameraStream>> open_camera(const sources::StreamAddress& address) {
  return sources::CameraStream::open([address] { return sources::connect_stream_camera(address); },
                                     address.shown);
}

/// `Cameras`: HttpCameras, StreamCameras or VideoCameras.
template <class Cameras>
Result<std::unique_ptr<PairSource>> open_pairs(const Cameras& cameras, sources::StereoLayout layout) {
  auto left = open_camera(cameras.left);
  if (!left) return std::move(left).error();
  if (!cameras.right) return camera_pairs(*std::move(left), nullptr, layout);
  auto right = open_camera(*cameras.right);
  if (!right) return std::move(right).error();
  return camera_pairs(*std::move(left), *std::move(right), layout);
}

}  // namespace

Result<std::unique_ptr<LiveSource>> open_live_source(const std::string& address,
                                                     const LivePairOptions& options, const Work& work) {
  const auto parsed = parse_live_address(address);
  if (!parsed) return parsed.error();
  const auto matched = [&](Result<std::unique_ptr<PairSource>> pairs) -> Result<std::unique_ptr<LiveSource>> {
    if (pairs && !options.record_to.empty()) pairs = recorded_pairs(*std::move(pairs), options.record_to);
    if (!pairs) return std::move(pairs).error();
    return matched_source(*std::move(pairs), options.rig, work);
  };
  if (const auto* network = std::get_if<HttpCameras>(&*parsed))
    return matched(open_pairs(*network, options.layout));
  if (const auto* streams = std::get_if<StreamCameras>(&*parsed))
    return matched(open_pairs(*streams, options.layout));
  if (const auto* local = std::get_if<VideoCameras>(&*parsed))
    return matched(open_pairs(*local, options.layout));
  const auto* ros = std::get_if<RosAddress>(&*parsed);
  const auto* robot = std::get_if<RobotAddress>(&*parsed);
  const auto* depths = std::get_if<sources::DepthCamera>(&*parsed);
  if (ros != nullptr) {
    sources::RosbridgeOptions server;
    server.host = ros->host;
    server.port = ros->port;
    const auto topics = add_topics(*ros, server.topics);
    auto client = sources::RosbridgeClient::open(std::move(server));
    if (!client) return std::move(client).error();
    if (!ros->pair) return ros_depths(*std::move(client), topics, *ros);
    const auto cameras = options.rig ? RosCameras::known : RosCameras::stated;
    return matched(ros_pairs(*std::move(client), topics, *ros, cameras));
  }
  if (robot != nullptr) return open_robot_source(*robot, work);
  if (depths != nullptr) return open_depth_camera_source(*depths, address);
  const auto& frames = std::get<FramesAddress>(*parsed);
  auto folder = sources::FrameFolder::open(frames.folder);
  if (!folder) return std::move(folder).error();
  if (folder->has_pairs())
    return matched(std::unique_ptr<PairSource>(std::make_unique<PacedPairs>(*std::move(folder), frames)));
  if (!options.record_to.empty())
    return Error{ErrorCode::usage, "frames of depth are in a folder already", frames.folder};
  return std::unique_ptr<LiveSource>(std::make_unique<PacedDepths>(*std::move(folder), frames));
}

}  // namespace palpable::session
