// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/session/touch/robot_address.hpp"

#include "palpable/core/text/number_text.hpp"
#include "palpable/sources/sound/microphones_file.hpp"

#include <algorithm>
#include <optional>
#include <string_view>

namespace palpable::session {
namespace {

/// The name of a topic: /word/word of letters, digits and _.
bool is_topic(std::string_view name) {
  constexpr std::size_t kLongest = 255;
  const auto is_allowed = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '/';
  };
  return name.size() > 1 && name.size() <= kLongest && name.front() == '/' && name.back() != '/' &&
         name.find("//") == std::string_view::npos && std::all_of(name.begin(), name.end(), is_allowed);
}

/// A file of microphones, or square:RADIUS in metres: square_array().
Result<Microphones> microphones_of(const std::string& text) {
  constexpr std::string_view kSquare = "square:";
  if (!text.starts_with(kSquare)) return sources::read_microphones(text);
  constexpr double kLeast_m = 0.01, kMost_m = 1.0;
  const auto radius_m = finite_number(std::string_view(text).substr(kSquare.size()));
  if (!radius_m || *radius_m < kLeast_m || *radius_m > kMost_m)
    return Error{ErrorCode::usage, "the radius of a square of microphones is 0.01 to 1 m", "microphones"};
  return square_array(*radius_m);
}

/// The wrist camera of a robot whose address names its arm.
Result<std::optional<WristAddress>> take_wrist(device::DeviceUrl& url, const std::string& command) {
  WristAddress wrist;
  if (auto taken = take_topics(url, {{"arm", &wrist.arm},
                                     {"wrist", &wrist.picture},
                                     {"wrist-info", &wrist.info},
                                     {"wrist-pose", &wrist.pose}});
      !taken)
    return std::move(taken).error();
  wrist.sweep.half_m = url.take_number("sweep", wrist.sweep.half_m, 0.005, 0.1);
  wrist.sweep.speed_m_per_s = url.take_number("arm-speed", wrist.sweep.speed_m_per_s, 0.005, 0.1);
  if (!wrist.arm.empty() && wrist.arm == command)
    return Error{ErrorCode::usage, "the arm's topic is that of the robot's own commands", "arm"};
  return wrist.arm.empty() ? std::nullopt : std::optional(std::move(wrist));
}

}  // namespace

Result<void> take_topics(device::DeviceUrl& url,
                         std::initializer_list<std::pair<const char*, std::string*>> topics) {
  for (const auto& [option, topic] : topics) {
    auto text = url.take_text(option);
    if (text.empty()) continue;
    if (!is_topic(text))
      return Error{ErrorCode::usage, "a topic is /NAME/NAME of letters, digits and _, not \"" + text + "\"",
                   option};
    *topic = std::move(text);
  }
  return {};
}

Result<RobotAddress> take_robot_options(device::DeviceUrl& url, RosAddress pictures) {
  RobotAddress address;
  address.pictures = std::move(pictures);
  if (auto taken = take_topics(url, {{"odom", &address.odometry},
                                     {"cmd", &address.command},
                                     {"battery", &address.battery},
                                     {"contact", &address.contact},
                                     {"audio", &address.sound},
                                     {"audio-info", &address.sound_format}});
      !taken)
    return std::move(taken).error();
  DriveOptions& drive = address.drive;
  RobotShape& shape = drive.shape;
  constexpr double kDegree = 3.14159265358979323846 / 180.0;
  shape.radius_m = url.take_number("radius", shape.radius_m, 0.05, 1.0);
  shape.height_m = url.take_number("height", shape.height_m, 0.05, 2.5);
  shape.camera_height_m = url.take_number("camera-height", shape.camera_height_m, 0.05, 2.5);
  shape.camera_forward_m = url.take_number("camera-forward", shape.camera_forward_m, -1.0, 1.0);
  shape.camera_left_m = url.take_number("camera-left", shape.camera_left_m, -1.0, 1.0);
  shape.camera_down_rad =
      kDegree * url.take_number("camera-down", shape.camera_down_rad / kDegree, -28.0, 68.0);
  drive.speed_m_per_s = url.take_number("speed", drive.speed_m_per_s, 0.05, 1.0);
  drive.turn_rad_per_s = url.take_number("turn", drive.turn_rad_per_s, 0.1, 2.0);
  drive.reaction_s = url.take_number("reaction", drive.reaction_s, 0.0, 2.0);
  address.marks_sounds = url.take_count("sound-marker", 1, 0, 1) == 1;
  address.pulls_to_sounds = url.take_count("sound-pull", 0, 0, 1) == 1;
  auto wrist = take_wrist(url, address.command);
  if (!wrist) return std::move(wrist).error();
  address.wrist = *std::move(wrist);
  if (const auto text = url.take_text("microphones"); !text.empty()) {
    auto microphones = microphones_of(text);
    if (!microphones) return std::move(microphones).error();
    address.microphones = *std::move(microphones);
  }
  const auto mode = url.take_word("mode", {"drive", "look", "touch"});
  address.mode = mode == "look" ? RobotMode::look : mode == "touch" ? RobotMode::touch : RobotMode::drive;
  return address;
}

}  // namespace palpable::session
