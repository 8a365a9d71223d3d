// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/session/touch/robot_hearing.hpp"

#include "palpable/session/robot/robot_messages.hpp"
#include "palpable/session/touch/touch_session.hpp"

#include <utility>

#include <fmt/format.h>

namespace palpable::session {

RobotHearing::RobotHearing(std::optional<RobotEars> ears, const Options& options)
    : options_(options),
      marks_(ears && options.marks),
      pulls_(ears && options.pulls),
      ears_(std::move(ears)) {}

void RobotHearing::listen(sources::RosbridgeClient& client, double t_s, double heading_rad) {
  const std::lock_guard lock(mutex_);
  if (!ears_) return;
  ears_->turn(t_s, heading_rad);
  const auto heard = take_sound(client, options_.sound, options_.sound_format, *ears_);
  if (auto words = ears_->words()) notices_.put(*std::move(words));
  sounds_ = ears_->sounds();
  if (heard) return;
  notices_.put(fmt::format("The robot {}: it is not listened to.", heard.error().message));
  ears_.reset();
}

std::optional<double> RobotHearing::azimuth_rad(double t_s, double heading_rad) const {
  const std::lock_guard lock(mutex_);
  return ears_ ? ears_->azimuth_rad(t_s, heading_rad) : std::nullopt;
}

void RobotHearing::mark(Raster<std::uint8_t>& labels, std::uint8_t label, const Pinhole& camera, double t_s,
                        double heading_rad) const {
  if (const auto azimuth = azimuth_rad(t_s, heading_rad))
    mark_direction(labels, label, camera, options_.camera_down_rad, *azimuth);
}

std::shared_ptr<const models::RouteGuide> RobotHearing::guide(const models::Scene& scene,
                                                              const TouchSession& session,
                                                              const std::optional<Pinhole>& camera,
                                                              double t_s, double heading_rad) {
  const auto sample = session.latest();
  const bool is_there = camera && sample.status == device::Status::ok;
  const auto azimuth = is_there ? azimuth_rad(t_s, heading_rad) : std::nullopt;
  const auto place_of = [&](Place hand) {
    return sound_place(*models::relief_of(scene), *camera, options_.camera_down_rad, *azimuth, hand);
  };
  return pull_.guide(scene, session.device_traits(), {sample.position.v.x, sample.position.v.y}, sounds(),
                     azimuth.has_value(), place_of);
}

std::optional<std::string> RobotHearing::notice() {
  if (auto words = pull_.words()) return words;
  return notices_.take();
}

std::uint64_t RobotHearing::sounds() const {
  const std::lock_guard lock(mutex_);
  return sounds_;
}

}  // namespace palpable::session
