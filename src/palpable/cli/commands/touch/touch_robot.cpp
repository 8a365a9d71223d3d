// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/cli/commands/touch/touch_robot.hpp"

#include "palpable/device/url.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>

#include <fmt/format.h>
#include <poll.h>
#include <unistd.h>

namespace palpable::cli {
namespace {

constexpr std::string_view kSampleRobot = "robot:sample";

/// The options of an address that are not the simulated robot's own.
std::string further_options(std::string_view address) {
  const auto question = address.find('?');
  if (question == std::string_view::npos) return {};
  std::string rest;
  for (auto options = address.substr(question + 1); !options.empty();) {
    const auto option = options.substr(0, options.find('&'));
    options.remove_prefix(std::min(options.size(), option.size() + 1));
    const auto name = option.substr(0, option.find('='));
    constexpr std::array<std::string_view, 7> kOwn{"seed", "eyes", "fps", "delay", "jitter", "loss", "sound"};
    if (std::find(kOwn.begin(), kOwn.end(), name) == kOwn.end()) rest.append("&").append(option);
  }
  return rest;
}

}  // namespace

bool is_sample_robot(std::string_view address) {
  return address == kSampleRobot || address.starts_with(std::string(kSampleRobot) + "?");
}

Result<SampleRobot> start_sample_robot(const std::string& address) {
  auto url = device::DeviceUrl::parse(address);
  if (!url) return std::move(url).error();
  study::RobotServerOptions options;
  options.seed = static_cast<std::uint64_t>(url->take_count("seed", 1, 0, 1'000'000));
  const bool is_stereo = url->take_word("eyes", {"depth", "stereo"}) == "stereo";
  if (is_stereo) {
    options.eyes = study::RobotEyes::stereo;
    // As many pairs as two slow processors match.
    options.link.rate_hz = 10.0;
  }
  options.link.rate_hz = url->take_number("fps", options.link.rate_hz, 1.0, 60.0);
  options.link.delay_s = url->take_number("delay", 0.0, 0.0, 5.0);
  options.link.jitter_s = url->take_number("jitter", 0.0, 0.0, 5.0);
  options.link.loss = url->take_number("loss", 0.0, 0.0, 1.0);
  // What is left is checked with the robot's address.
  options.has_sound = url->take_count("sound", 1, 0, 1) == 1;
  for (const auto* other :
       {"mode", "speed", "turn", "reaction", "sound-marker", "sound-pull", "sweep", "arm-speed"})
    url->take_text(other);
  if (auto finished = url->finish(); !finished) return std::move(finished).error();
  auto server = study::RobotServer::start(options);
  if (!server) return std::move(server).error();
  const auto& body = options.body;
  constexpr double kDegree = 3.14159265358979323846 / 180.0;
  const std::string there = fmt::format(
      "robot:127.0.0.1:{}?{}&radius={}&height={}&camera-height={}&camera-forward={}&camera-down={}"
      "&microphones=square:0.1&arm=/arm/cmd_vel&wrist=/wrist_camera/image_raw",
      (*server)->port(),
      is_stereo ? "left=/stereo/left/image_rect_color&right=/stereo/right/image_rect_color"
                : "color=/camera/color/image_raw",
      body.radius_m, body.height_m, body.camera_height_m, body.camera_forward_m,
      body.camera_down_rad / kDegree);
  return SampleRobot{*std::move(server), there + further_options(address)};
}

RobotTerminal::RobotTerminal(session::RobotControl* robot, Console& console) {
  if (robot == nullptr || ::isatty(STDIN_FILENO) != 1) return;
  console.note(
      "Type start and Enter to start the robot; Enter alone, or stop, stops it; drive, look and touch change "
      "the mode, near and wide the view that is touched.");
  thread_ = std::thread([this, robot, &console] { run(*robot, console); });
}

RobotTerminal::~RobotTerminal() {
  ending_ = true;
  if (thread_.joinable()) thread_.join();
}

void RobotTerminal::run(session::RobotControl& robot, Console& console) const {
  constexpr int kPatience_ms = 50;
  std::string line;
  while (!ending_) {
    pollfd waited{STDIN_FILENO, POLLIN, 0};
    if (::poll(&waited, 1, kPatience_ms) <= 0) continue;
    std::array<char, 64> buffer{};
    const ssize_t got = ::read(STDIN_FILENO, buffer.data(), buffer.size());
    // The terminal is gone, and with it the way to stop the robot.
    if (got <= 0) return robot.request_stop();
    for (const char c : std::string_view(buffer.data(), static_cast<std::size_t>(got))) {
      if (c != '\n') {
        line += c;
        continue;
      }
      // Enter alone stops.
      if (!session::obey(line.empty() ? "stop" : std::string_view(line), robot))
        console.note("The robot's words are start, stop, drive, look, touch, near and wide.");
      line.clear();
    }
  }
}

}  // namespace palpable::cli
