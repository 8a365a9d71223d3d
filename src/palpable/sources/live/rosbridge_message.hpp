// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/picture/camera.hpp"
#include "palpable/core/result.hpp"
#include "palpable/core/vec3.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace palpable::sources {

// Messages of a rosbridge server (rosbridge protocol 2.0, JSON text) as it sends them to a subscriber, of ROS
// 1 and ROS 2: they differ in the names of some members (stamp: secs, sec; camera matrix: K, k).

/// sensor_msgs/Image.
struct RosPicture {
  /// Pixels, 1 or more.
  int width = 0, height = 0;
  /// "rgb8", "16UC1", …
  std::string encoding;
  bool is_big_endian = false;
  /// Bytes from a row to the next.
  std::size_t step = 0;
  std::vector<std::byte> data;
};

/// sensor_msgs/CompressedImage.
struct RosCompressed {
  /// "jpeg", "rgb8; jpeg compressed bgr8", "16UC1; compressedDepth", …
  std::string format;
  std::vector<std::byte> data;
};

/// sensor_msgs/PointCloud2, whose fields x, y and z are float32 (metres).
struct RosCloud {
  int width = 0, height = 0;
  bool is_big_endian = false;
  std::size_t point_step = 0, row_step = 0;
  /// Where in a point they are, bytes.
  std::size_t x = 0, y = 0, z = 0;
  std::vector<std::byte> data;
};

/// nav_msgs/Odometry of a robot on a floor: metres, radians (anticlockwise from above) and per second.
struct RosOdometry {
  double x_m = 0.0, y_m = 0.0, yaw_rad = 0.0;
  double forward_m_per_s = 0.0, turn_rad_per_s = 0.0;
};

/// geometry_msgs/PoseStamped: a place and a turn, parent_from_child, of a frame in that of its header.
struct RosPose {
  Vec3 position_m;
  /// A rotation matrix, row-major.
  std::array<double, 9> rotation{1, 0, 0, 0, 1, 0, 0, 0, 1};
};

/// sensor_msgs/BatteryState.
struct RosBattery {
  /// 0 ... 1.
  double charge = 0.0;
};

/// std_msgs/Bool, as of a bumper.
struct RosFlag {
  bool value = false;
};

/// audio_common_msgs/AudioData or AudioDataStamped: samples as its AudioInfo says.
struct RosSound {
  std::vector<std::byte> data;
};

/// audio_common_msgs/AudioInfo.
struct RosSoundFormat {
  /// 1 ... 64; samples of all channels at one instant follow one another.
  int channels = 1;
  /// 8000 ... 192 000.
  int rate_hz = 16'000;
  /// "S16LE", "S32LE", "F32LE", …
  std::string samples;
};

/// sensor_msgs/CameraInfo; its distortion is not used.
struct RosCamera {
  /// Of the picture as it is taken (K).
  Pinhole camera;
  /// Of the rectified picture (P); nullopt: not stated.
  std::optional<Pinhole> rectified;
  /// How far it is to the right of the first camera of its pair, m: -P[3] / P[0]. 0 of a single camera.
  double right_m = 0.0;
};

/// What a topic's message is, recognised by its members. All numbers are finite.
using RosBody = std::variant<RosPicture, RosCompressed, RosCamera, RosCloud, RosOdometry, RosPose, RosBattery,
                             RosFlag, RosSound, RosSoundFormat>;

enum class RosVersion : std::uint8_t { unknown, ros1, ros2 };

struct RosMessage {
  std::string topic;
  RosBody body;
  /// As its header shows.
  RosVersion version = RosVersion::unknown;
  /// When it was measured, by the robot's clock, s; nullopt without a header, and for 0.
  std::optional<double> stamp_s = {};
};

/// A status message of the server itself.
struct RosStatus {
  bool is_error = false;
  /// One line that can be shown, at most 200 bytes.
  std::string words;
};

using RosHeard = std::variant<RosMessage, RosStatus>;

/// The longest message that is read, bytes: a coloured cloud of 640 x 480 points, as base64, has 13 million.
inline constexpr std::size_t kLongestRosMessage = std::size_t{32} << 20U;

/// Parses one message of a server; untrusted. Errors (invalid_input, without a place), each a clause about
/// the server: "sends …": no JSON (NaN is none), nested deeper or with more values than any message has, an
/// operation that was not asked for, a body of another type, numbers out of range, data that is no base64, or
/// less data than its size needs.
Result<RosHeard> parse_rosbridge(std::string_view text);

}  // namespace palpable::sources
