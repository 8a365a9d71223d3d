// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/session/touch/ros_eyes.hpp"

#include "palpable/session/touch/frame_order.hpp"
#include "palpable/sources/live/rosbridge_picture.hpp"

#include <chrono>
#include <cmath>
#include <optional>
#include <utility>
#include <variant>

namespace palpable::session {
namespace {

using sources::RosbridgeClient;
using sources::RosCamera;
using Clock = std::chrono::steady_clock;
using Newest = RosbridgeClient::Newest;

class RosDepths final : public LiveSource {
 public:
  RosDepths(std::shared_ptr<RosbridgeClient> client, const RosEyesTopics& topics,
            std::optional<double> metres_per_unit)
      : client_(std::move(client)), topics_(topics), metres_per_unit_(metres_per_unit) {}

  Result<std::optional<LiveFrame>> take(Clock::time_point deadline) override {
    auto newest = client_->wait(topics_.depth, deadline);
    if (!newest) return std::move(newest).error();
    if (!*newest || order_.is_late((*newest)->message.stamp_s)) return std::optional<LiveFrame>();
    if (const auto info = client_->take(topics_.info))
      if (const auto* camera = std::get_if<RosCamera>(&info->message.body)) camera_ = camera->camera;
    auto depth = sources::depth_of((*newest)->message.body, camera_, metres_per_unit_);
    if (!depth) return invalid_input(depth.error().message, client_->name());
    LiveFrame frame{(*newest)->number, (*newest)->arrival, *std::move(depth)};
    frame.stamp_s = (*newest)->message.stamp_s;
    return std::optional(std::move(frame));
  }
  bool has_ended() const override { return false; }

  std::optional<Image> colour() override {
    const auto newest = client_->take(topics_.colour);
    if (!newest) return std::nullopt;
    auto picture = sources::colour_of(newest->message.body);
    return picture ? std::optional(*std::move(picture)) : std::nullopt;
  }
  std::optional<std::string> loss() override { return client_->loss(); }
  std::optional<std::string> notice() override { return client_->notice(); }

 private:
  std::shared_ptr<RosbridgeClient> client_;
  RosEyesTopics topics_;
  std::optional<double> metres_per_unit_;
  std::optional<Pinhole> camera_;
  FrameOrder order_;
};

class RosPairs final : public PairSource {
 public:
  RosPairs(std::shared_ptr<RosbridgeClient> client, const RosEyesTopics& topics,
           std::optional<double> baseline_m, RosCameras cameras)
      : client_(std::move(client)), topics_(topics), baseline_m_(baseline_m), cameras_(cameras) {}

  Result<std::optional<LivePair>> take(Clock::time_point deadline) override {
    for (const auto& [topic, newest] : {std::pair(topics_.left, &left_), {topics_.right, &right_}}) {
      // One that is kept waits for the other; a newer one takes its place.
      auto taken = client_->wait(topic, *newest ? Clock::now() : deadline);
      if (!taken) return std::move(taken).error();
      if (*taken) *newest = *std::move(taken);
      if (!*newest) return std::optional<LivePair>();
    }
    // Whichever is older has no partner any more.
    const double right_later_s = seconds_between(*left_, *right_);
    if (std::abs(right_later_s) > longest_apart_s(*left_, *right_)) {
      (right_later_s > 0.0 ? left_ : right_).reset();
      return std::optional<LivePair>();
    }
    const Newest left = *std::exchange(left_, std::nullopt), right = *std::exchange(right_, std::nullopt);
    if (order_.is_late(left.message.stamp_s)) return std::optional<LivePair>();
    auto rig = this->rig();
    if (!rig) return std::move(rig).error();
    if (!*rig && cameras_ == RosCameras::stated) return std::optional<LivePair>();
    return pair_of(left, right, *rig);
  }
  bool has_ended() const override { return false; }
  std::optional<std::string> loss() override { return client_->loss(); }
  std::optional<std::string> notice() override { return client_->notice(); }

 private:
  static bool have_stamps(const Newest& left, const Newest& right) {
    return left.message.stamp_s && right.message.stamp_s;
  }
  static double seconds_between(const Newest& left, const Newest& right) {
    return have_stamps(left, right) ? *right.message.stamp_s - *left.message.stamp_s
                                    : std::chrono::duration<double>(right.arrival - left.arrival).count();
  }
  static double longest_apart_s(const Newest& left, const Newest& right) {
    constexpr double kStamped_s = 0.01, kArrived_s = 0.1;
    return have_stamps(left, right) ? kStamped_s : kArrived_s;
  }

  /// As the cameras are stated so far; nullopt: not yet.
  Result<std::optional<StereoRig>> rig() {
    for (const auto& [topic, camera] :
         {std::pair(topics_.left_info, &left_camera_), {topics_.right_info, &right_camera_}})
      if (const auto info = client_->take(topic))
        if (const auto* stated = std::get_if<RosCamera>(&info->message.body)) *camera = *stated;
    if (!left_camera_ || !right_camera_) return std::optional<StereoRig>();
    // Rectified pictures are those of the projection matrices.
    const Pinhole left = left_camera_->rectified.value_or(left_camera_->camera);
    const Pinhole right = right_camera_->rectified.value_or(right_camera_->camera);
    const double baseline_m = baseline_m_.value_or(right_camera_->right_m);
    if (!(baseline_m > 0.0))
      return invalid_input(
          "states no distance between its cameras (the fourth number of P of the right one); baseline=METRES "
          "of the address does",
          client_->name());
    return std::optional(StereoRig{left, baseline_m, right.cx - left.cx});
  }

  Result<std::optional<LivePair>> pair_of(const Newest& left, const Newest& right,
                                          const std::optional<StereoRig>& rig) const {
    auto left_picture = sources::colour_of(left.message.body);
    if (!left_picture) return invalid_input(left_picture.error().message, client_->name());
    auto right_picture = sources::colour_of(right.message.body);
    if (!right_picture) return invalid_input(right_picture.error().message, client_->name());
    LivePair pair{left.number, left.arrival, *std::move(left_picture), *std::move(right_picture)};
    pair.stamp_s = left.message.stamp_s;
    pair.rig = rig;
    return std::optional(std::move(pair));
  }

  std::shared_ptr<RosbridgeClient> client_;
  RosEyesTopics topics_;
  std::optional<double> baseline_m_;
  RosCameras cameras_;
  /// The newest pictures that have no partner yet.
  std::optional<Newest> left_, right_;
  std::optional<RosCamera> left_camera_, right_camera_;
  FrameOrder order_;
};

}  // namespace

RosEyesTopics add_topics(const RosAddress& address, std::vector<std::string>& topics) {
  const auto add = [&](const std::string& topic) {
    topics.push_back(topic);
    return topics.size() - 1;
  };
  RosEyesTopics places;
  if (const auto& pair = address.pair) {
    places.left = add(pair->left), places.right = add(pair->right);
    places.left_info = add(pair->left_info), places.right_info = add(pair->right_info);
  } else {
    places.depth = add(address.depth), places.colour = add(address.colour), places.info = add(address.info);
  }
  return places;
}

std::unique_ptr<LiveSource> ros_depths(std::shared_ptr<RosbridgeClient> client, const RosEyesTopics& topics,
                                       const RosAddress& address) {
  return std::make_unique<RosDepths>(std::move(client), topics, address.metres_per_unit);
}

std::unique_ptr<PairSource> ros_pairs(std::shared_ptr<RosbridgeClient> client, const RosEyesTopics& topics,
                                      const RosAddress& address, RosCameras cameras) {
  return std::make_unique<RosPairs>(std::move(client), topics, address.pair->baseline_m, cameras);
}

std::unique_ptr<LiveSource> ros_eyes(std::shared_ptr<RosbridgeClient> client, const RosEyesTopics& topics,
                                     const RosAddress& address, const Work& work) {
  if (!address.pair) return ros_depths(std::move(client), topics, address);
  return matched_source(ros_pairs(std::move(client), topics, address, RosCameras::stated), std::nullopt,
                        work);
}

}  // namespace palpable::session
