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

std::string sentence_of(RobotEvent event, double vouched_m) {
  switch (event) {
    case RobotEvent::started:
      return fmt::format(
          "The robot is started. The floor within {:.2f} m around it, which its camera does not see, must be "
          "free.",
          vouched_m);
    case RobotEvent::not_ready:
      return "The robot is not started: its odometry, or pictures of its camera with their data and depth, "
             "do "
             "not come.";
    case RobotEvent::stopped:
      return "The robot is stopped.";
    case RobotEvent::touched:
      return "The robot touches something: it is stopped, and must be started again.";
    case RobotEvent::link_lost:
      return "The robot is not started any more: its connection was lost.";
    case RobotEvent::odometry_lost:
      return "The robot stands: its odometry does not come. Start it again when it does.";
    case RobotEvent::picture_lost:
      return "The robot stands: no picture of its camera has come for half a second, or none with a camera's "
             "data and depth, or the same again and again. Start it again when it sees.";
    case RobotEvent::stalled:
      return "The robot is stopped, since this program stood still: start it again.";
    case RobotEvent::moved_unasked:
      return "The robot moves, though it is told to stand: use its own emergency stop.";
    case RobotEvent::stays:
      return "The robot is stopped: it was told to move, and its odometry says that it stands. It may be "
             "blocked, or its odometry hangs.";
    case RobotEvent::none:
      break;
  }
  return {};
}

std::string sentence_of(DriveLimit limit) {
  if (limit == DriveLimit::obstacle)
    return "There is something ahead of the robot, or floor that it has not seen.";
  return limit == DriveLimit::off_centre ? "The robot stands: bring the hand to the middle first." : "";
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
