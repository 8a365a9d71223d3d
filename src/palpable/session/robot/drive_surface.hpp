// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/result.hpp"
#include "palpable/models/relief/relief.hpp"
#include "palpable/session/robot/robot_drive.hpp"

#include <memory>

namespace palpable::session {

/// The place of a hand over a relief, by its border.
DriveHand drive_hand_at(double x_m, double y_m, const models::Relief& relief);

/// The potential of the force on a hand that drives, as a relief of the size of `like`, for the law
/// `rolling`: a bowl whose flat middle is the dead zone, and which rises ahead where the robot would go
/// slower than the hand asks for, with a slope of twice that share (guidance by a potential field: Khatib
/// 1986). Slopes are at most 3. So each such force is passive; a change from one surface to the next is
/// accounted for as that of a scene.
Result<std::shared_ptr<const models::Relief>> drive_surface(const RobotDrive& drive,
                                                            const models::Relief& like);

}  // namespace palpable::session
