// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/session/robot/robot_messages.hpp"

#include <chrono>
#include <variant>

#include <fmt/format.h>

namespace palpable::session {

std::string twist_text(const RobotVelocity& velocity) {
  return fmt::format(
      R"({{"linear":{{"x":{:.4f},"y":0.0,"z":0.0}},"angular":{{"x":0.0,"y":0.0,"z":{:.4f}}}}})",
      velocity.forward_m_per_s, velocity.turn_rad_per_s);
}

std::string arm_twist_text(double left_m_per_s) {
  return fmt::format(R"({{"linear":{{"x":0.0,"y":{:.4f},"z":0.0}},"angular":{{"x":0.0,"y":0.0,"z":0.0}}}})",
                     left_m_per_s);
}

std::string sentence_of(DriveLimit limit) {
  switch (limit) {
    case DriveLimit::picture_lost:
      return "The robot stands: no picture of its camera has come for half a second, or none with a camera's "
             "data and depth, or the same again and again. Start it again when it sees.";
    case DriveLimit::link_lost:
      return "The robot stands: its odometry does not come. Start it again when it does.";
    case DriveLimit::obstacle:
      return "There is something ahead of the robot, or floor that it has not seen.";
    case DriveLimit::none:
    case DriveLimit::not_started:
    case DriveLimit::released:
    case DriveLimit::standing:
      break;
  }
  return {};
}

std::string sentence_of(RobotMode mode) {
  switch (mode) {
    case RobotMode::drive:
      return "Drive: up drives the robot, right and left turn it.";
    case RobotMode::look:
      return "Look: right and left turn the robot.";
    case RobotMode::touch:
      break;
  }
  return "Touch: the robot stands, and the hand touches what its camera sees.";
}

Result<void> take_sound(sources::RosbridgeClient& client, std::size_t sound, std::size_t format,
                        RobotEars& ears) {
  if (const auto newest = client.take(format))
    if (const auto* stated = std::get_if<sources::RosSoundFormat>(&newest->message.body))
      if (auto taken =
              ears.take_format({stated->channels, static_cast<double>(stated->rate_hz), stated->samples});
          !taken)
        return taken;
  while (const auto part = client.take(sound))
    if (const auto* samples = std::get_if<sources::RosSound>(&part->message.body))
      ears.take(samples->data, std::chrono::duration<double>(part->arrival.time_since_epoch()).count());
  return {};
}

}  // namespace palpable::session
