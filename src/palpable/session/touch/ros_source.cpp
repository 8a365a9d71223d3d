// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/session/touch/ros_source.hpp"

#include "palpable/session/touch/frame_order.hpp"
#include "palpable/sources/live/rosbridge_client.hpp"
#include "palpable/sources/live/rosbridge_picture.hpp"

#include <utility>
#include <variant>

namespace palpable::session {
namespace {

using sources::RosbridgeClient;

/// Places of the topics in the client's list.
enum RosTopic : std::size_t { kDepth, kColour, kInfo };

class RosSource final : public LiveSource {
 public:
  RosSource(std::unique_ptr<RosbridgeClient> client, std::optional<double> metres_per_unit)
      : client_(std::move(client)), metres_per_unit_(metres_per_unit) {}

  Result<std::optional<LiveFrame>> take(std::chrono::steady_clock::time_point deadline) override {
    auto newest = client_->wait(kDepth, deadline);
    if (!newest) return std::move(newest).error();
    if (!*newest || order_.is_late((*newest)->message.stamp_s)) return std::optional<LiveFrame>();
    if (const auto info = client_->take(kInfo))
      if (const auto* camera = std::get_if<Pinhole>(&info->message.body)) camera_ = *camera;
    auto depth = sources::depth_of((*newest)->message.body, camera_, metres_per_unit_);
    if (!depth) return invalid_input(depth.error().message, client_->name());
    return std::optional(LiveFrame{(*newest)->number, (*newest)->arrival, *std::move(depth)});
  }
  bool has_ended() const override { return false; }

  std::optional<Image> colour() override {
    const auto newest = client_->take(kColour);
    if (!newest) return std::nullopt;
    auto picture = sources::colour_of(newest->message.body);
    return picture ? std::optional(*std::move(picture)) : std::nullopt;
  }
  std::optional<std::string> loss() override { return client_->loss(); }
  std::optional<std::string> notice() override { return client_->notice(); }

 private:
  std::unique_ptr<RosbridgeClient> client_;
  std::optional<double> metres_per_unit_;
  std::optional<Pinhole> camera_;
  FrameOrder order_;
};

}  // namespace

Result<std::unique_ptr<LiveSource>> open_ros_source(const RosAddress& address) {
  sources::RosbridgeOptions options;
  options.host = address.host;
  options.port = address.port;
  options.topics = {address.depth, address.colour, address.info};
  auto client = RosbridgeClient::open(std::move(options));
  if (!client) return std::move(client).error();
  return std::unique_ptr<LiveSource>(
      std::make_unique<RosSource>(*std::move(client), address.metres_per_unit));
}

}  // namespace palpable::session
