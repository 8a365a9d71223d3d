// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/result.hpp"
#include "palpable/session/robot/robot_drive.hpp"
#include "palpable/session/robot/robot_ears.hpp"
#include "palpable/session/robot/robot_state.hpp"
#include "palpable/sources/live/rosbridge_client.hpp"

#include <cstddef>
#include <string>

// What passes between a robot's rosbridge server, its drive and its ears, and the person.
namespace palpable::session {

/// A velocity as geometry_msgs/Twist, JSON.
std::string twist_text(const RobotVelocity& velocity);

/// An arm's speed to the left as geometry_msgs/Twist in the robot's frame, JSON.
std::string arm_twist_text(double left_m_per_s);

/// What is said of an event; `vouched_m`: RobotDrive::vouched_m().
std::string sentence_of(RobotEvent event, double vouched_m);
/// A sentence on why the robot goes slowly; empty: nothing is to be said.
std::string sentence_of(DriveLimit limit);
/// What the hand does in this mode.
std::string sentence_of(RobotMode mode);

/// Gives the ears all parts of the sound that came, and the format that the robot states. `sound`, `format`:
/// places in the client's list of topics. Errors: RobotEars::take_format().
Result<void> take_sound(sources::RosbridgeClient& client, std::size_t sound, std::size_t format,
                        RobotEars& ears);

}  // namespace palpable::session
