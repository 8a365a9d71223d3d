// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/cli/console.hpp"
#include "palpable/core/result.hpp"
#include "palpable/session/touch/robot_control.hpp"
#include "palpable/study/world/robot_server.hpp"

#include <atomic>
#include <memory>
#include <string>
#include <string_view>
#include <thread>

namespace palpable::cli {

/// A simulated robot in a room, and the address at which it is touched.
struct SampleRobot {
  std::unique_ptr<study::RobotServer> server;
  std::string address;
};

/// Whether an address is that of the simulated robot, robot:sample.
bool is_sample_robot(std::string_view address);
/// Starts the robot of robot:sample?seed=N&eyes=depth|stereo&fps=HZ&delay=S&jitter=S&loss=SHARE; further
/// options, such as mode, are those of robot:. Errors: usage for a value out of its range; failed.
Result<SampleRobot> start_sample_robot(const std::string& address);

/// Obeys the lines of a terminal for as long as it lives; does nothing where standard input is none.
class RobotTerminal {
 public:
  /// `robot`: null for none; must outlive this.
  RobotTerminal(session::RobotControl* robot, Console& console);
  ~RobotTerminal();
  RobotTerminal(const RobotTerminal&) = delete;
  RobotTerminal& operator=(const RobotTerminal&) = delete;

 private:
  void run(session::RobotControl& robot, Console& console) const;

  std::atomic<bool> ending_{false};
  std::thread thread_;
};

}  // namespace palpable::cli
