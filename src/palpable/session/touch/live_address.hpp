// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/result.hpp"
#include "palpable/core/sound/microphones.hpp"
#include "palpable/session/robot/robot_drive.hpp"
#include "palpable/session/robot/wrist_sweep.hpp"
#include "palpable/sources/depth_camera/depth_camera.hpp"
#include "palpable/sources/live/http_camera.hpp"
#include "palpable/sources/live/video_device.hpp"
#include "palpable/sources/stream/stream_camera.hpp"

#include <optional>
#include <string>
#include <variant>

namespace palpable::session {

/// Whether a command's input is the address of a live source, whatever its scheme.
bool is_live_address(const std::string& input);

/// What an address of frames says.
struct FramesAddress {
  std::string folder;
  double rate_hz = 30.0;
  bool repeats = false;
};

/// One camera that sends pairs, or two.
struct HttpCameras {
  sources::HttpAddress left;
  std::optional<sources::HttpAddress> right;
};

/// One camera that sends pairs by RTSP or HTTPS, or two.
struct StreamCameras {
  sources::StreamAddress left;
  std::optional<sources::StreamAddress> right;
};

/// One camera of this machine that sends pairs, or two.
struct VideoCameras {
  sources::VideoDevice left;
  std::optional<sources::VideoDevice> right;
};

/// A stereo camera of a rosbridge server: topics of two rectified pictures and their cameras.
struct RosPair {
  std::string left;
  std::string right;
  std::string left_info = "/stereo/left/camera_info";
  std::string right_info = "/stereo/right/camera_info";
  /// Not given: as the right camera states it.
  std::optional<double> baseline_m;
};

/// A camera of a rosbridge server, of depth unless it has a pair.
struct RosAddress {
  std::string host;
  std::string port = "9090";
  /// Names of topics: depth (a picture or a cloud), colours, and the depth's camera.
  std::string depth = "/camera/depth/image_rect_raw";
  std::string colour = "/camera/color/image_raw/compressed";
  std::string info = "/camera/depth/camera_info";
  /// Not given: as the pictures' encoding has it.
  std::optional<double> metres_per_unit;
  /// Given: a stereo camera in place of the depth camera.
  std::optional<RosPair> pair;
};

/// A camera on a robot's arm, and how the arm is told to move it.
struct WristAddress {
  std::string picture = "/wrist_camera/image_raw/compressed";
  std::string info = "/wrist_camera/camera_info";
  /// Where it is in the robot's frame.
  std::string pose = "/wrist_camera/pose";
  std::string arm;
  SweepOptions sweep;
};

/// A robot of a rosbridge server.
struct RobotAddress {
  /// Of the depth camera that looks ahead.
  RosAddress pictures;
  std::string odometry = "/odom";
  std::string command = "/cmd_vel";
  std::string battery = "/battery_state";
  std::string contact = "/contact";
  std::string sound = "/audio";
  std::string sound_format = "/audio_info";
  /// Level, around the robot's axis; none: it is not listened to.
  std::optional<Microphones> microphones;
  /// The direction of a sound is marked in the touched picture.
  bool marks_sounds = true;
  /// The hand is pulled faintly to where it is marked.
  bool pulls_to_sounds = false;
  /// None: there is no near view.
  std::optional<WristAddress> wrist;
  DriveOptions drive;
  RobotMode mode = RobotMode::drive;
};

using LiveAddress = std::variant<FramesAddress, HttpCameras, StreamCameras, VideoCameras,
                                 sources::DepthCamera, RosAddress, RobotAddress>;

/// Parses frames:FOLDER?fps=30&loop=0, camera:N?right=N&size=1280x480&fps=30&format=mjpeg (all that both
/// cameras have in common; format: mjpeg, yuyv), openni:N?library=FILE, freenect:N and realsense:N likewise,
/// ros://HOST:PORT?depth=/TOPIC&color=/TOPIC&info=/TOPIC&scale=METRES or
/// ?left=/TOPIC&right=/TOPIC&left-info=/TOPIC&right-info=/TOPIC&baseline=METRES,
/// robot:HOST:PORT with these options and those of docs/live.md, or
/// http://HOST:PORT/PATH?QUERY#right=http://HOST:PORT/PATH?QUERY (what stands before # is the camera's own),
/// and likewise rtsp://NAME:PASSWORD@HOST:PORT/PATH#right=…, rtsps:// and https://, the last two also with
/// #certificate=any&right=…, which holds for both cameras. Errors: usage for another scheme, an unknown or
/// wrong option, an address with a space or a character outside of ASCII, or, of http:, a user's name.
Result<LiveAddress> parse_live_address(const std::string& address);

}  // namespace palpable::session
