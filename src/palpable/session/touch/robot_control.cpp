// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/session/touch/robot_control.hpp"

namespace palpable::session {

bool obey(std::string_view word, RobotControl& robot) {
  if (word == "start")
    robot.request_start();
  else if (word == "stop")
    robot.request_stop();
  else if (word == "drive")
    robot.request_mode(RobotMode::drive);
  else if (word == "look")
    robot.request_mode(RobotMode::look);
  else if (word == "touch")
    robot.request_mode(RobotMode::touch);
  else if (word == "near")
    robot.request_view(RobotView::near);
  else if (word == "wide")
    robot.request_view(RobotView::wide);
  else
    return false;
  return true;
}

}  // namespace palpable::session
