// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sources/live/rosbridge_message.hpp"

#include "palpable/core/text/base64.hpp"
#include "palpable/core/text/plain_text.hpp"
#include "palpable/sources/live/frame_folder.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace palpable::sources {
namespace {

using RosJson = nlohmann::json;

/// The member of an object, or null.
const RosJson& ros_member(const RosJson& object, const char* name) {
  static const RosJson none;
  if (!object.is_object()) return none;
  const auto found = object.find(name);
  return found == object.end() ? none : *found;
}

/// A finite number; nullopt for anything else.
std::optional<double> ros_number(const RosJson& value) {
  if (!value.is_number()) return std::nullopt;
  const double number = value.get<double>();
  return std::isfinite(number) ? std::optional(number) : std::nullopt;
}

/// A whole number of 0 ... `most`.
std::optional<std::size_t> ros_count(const RosJson& value, std::size_t most) {
  if (!value.is_number_unsigned()) return std::nullopt;
  const auto number = value.get<std::uint64_t>();
  return number <= most ? std::optional(static_cast<std::size_t>(number)) : std::nullopt;
}

bool ros_flag(const RosJson& value) {
  if (value.is_boolean()) return value.get<bool>();
  return value.is_number_unsigned() && value.get<std::uint64_t>() != 0;
}

/// uint8[]: base64, or, of servers that were set so, a list of numbers.
std::optional<std::vector<std::byte>> ros_bytes(const RosJson& value) {
  if (value.is_string()) return from_base64(value.get_ref<const std::string&>());
  if (!value.is_array()) return std::nullopt;
  std::vector<std::byte> bytes;
  bytes.reserve(value.size());
  for (const RosJson& item : value) {
    const auto byte = ros_count(item, std::numeric_limits<std::uint8_t>::max());
    if (!byte) return std::nullopt;
    bytes.push_back(static_cast<std::byte>(*byte));
  }
  return bytes;
}

/// Whether a text can be JSON of a message: neither nested deeper, nor with more values. Parsing other text
/// would take much memory.
bool has_plausible_structure(std::string_view text) {
  constexpr int kDeepest = 16;
  constexpr std::size_t kMostValues = 3'000'000;
  int depth = 0;
  std::size_t values = 0;
  bool in_text = false;
  for (std::size_t k = 0; k < text.size(); ++k) {
    const char c = text[k];
    if (in_text) {
      if (c == '\\') ++k;
      in_text = c != '"';
      continue;
    }
    in_text = c == '"';
    if (c == '[' || c == '{') ++depth;
    if (c == ']' || c == '}') --depth;
    if (c == ',') ++values;
    if (depth > kDeepest || values > kMostValues) return false;
  }
  return true;
}

struct Size {
  int width = 0, height = 0;
};

/// The size that a picture or cloud states. Errors: as check_frame_size().
Result<Size> size_in(const RosJson& message) {
  constexpr std::size_t kMost = 1U << 20U;
  const auto width = ros_count(ros_member(message, "width"), kMost);
  const auto height = ros_count(ros_member(message, "height"), kMost);
  if (!width || !height) return invalid_input("sends a picture without a size");
  const Size size{static_cast<int>(*width), static_cast<int>(*height)};
  if (auto valid = check_frame_size(size.width, size.height); !valid)
    return invalid_input("sends a picture that " + valid.error().message);
  return size;
}

constexpr std::size_t kMostStep = std::size_t{1} << 28U;

Result<RosBody> picture_in(const RosJson& message) {
  const auto size = size_in(message);
  if (!size) return size.error();
  const auto step = ros_count(ros_member(message, "step"), kMostStep);
  const auto& encoding = ros_member(message, "encoding");
  auto data = ros_bytes(ros_member(message, "data"));
  if (!step || !encoding.is_string() || !data) return invalid_input("sends a damaged picture");
  if (data->size() / static_cast<std::size_t>(size->height) < *step)
    return invalid_input("sends less of a picture than its size needs");
  return RosBody(RosPicture{size->width, size->height, encoding.get<std::string>(),
                            ros_flag(ros_member(message, "is_bigendian")), *step, *std::move(data)});
}

Result<RosBody> compressed_in(const RosJson& message) {
  auto data = ros_bytes(ros_member(message, "data"));
  const auto& format = ros_member(message, "format");
  if (!data || !format.is_string()) return invalid_input("sends a damaged compressed picture");
  return RosBody(RosCompressed{format.get<std::string>(), *std::move(data)});
}

/// A row-major matrix of `columns` whose first three are fx 0 cx, 0 fy cy, 0 0 1; nullopt for anything else.
std::optional<Pinhole> pinhole_in(const RosJson& matrix, std::size_t columns, const Size& size) {
  if (!matrix.is_array() || matrix.size() != 3 * columns) return std::nullopt;
  const auto fx = ros_number(matrix[0]), cx = ros_number(matrix[2]), fy = ros_number(matrix[columns + 1]),
             cy = ros_number(matrix[columns + 2]);
  constexpr double kMost_px = 1e6;
  if (!fx || !fy || !cx || !cy || *fx <= 0.0 || *fy <= 0.0 || *fx > kMost_px || *fy > kMost_px ||
      std::abs(*cx) > kMost_px || std::abs(*cy) > kMost_px)
    return std::nullopt;
  return Pinhole{*fx, *fy, *cx, *cy, size.width, size.height};
}

/// `matrix`: its camera matrix K. A projection matrix P that is none, as of zeros, is not stated.
Result<RosBody> ros_camera_in(const RosJson& message, const RosJson& matrix) {
  const auto size = size_in(message);
  if (!size) return size.error();
  const auto camera = pinhole_in(matrix, 3, *size);
  if (!camera) return invalid_input("sends a camera that is none");
  RosCamera stated{*camera, std::nullopt};
  for (const char* name : {"P", "p"}) {
    const auto& projection = ros_member(message, name);
    stated.rectified = pinhole_in(projection, 4, *size);
    if (!stated.rectified) continue;
    constexpr double kFarthest_m = 100.0;
    const double right_m = -ros_number(projection[3]).value_or(0.0) / stated.rectified->fx;
    stated.right_m = std::abs(right_m) <= kFarthest_m ? right_m : 0.0;
    break;
  }
  return RosBody(stated);
}

/// Where in a point a field of this name is, which must be a float32.
std::optional<std::size_t> field_at(const RosJson& fields, std::string_view name) {
  constexpr std::size_t kFloat32 = 7;
  if (!fields.is_array()) return std::nullopt;
  for (const RosJson& field : fields) {
    const auto& called = ros_member(field, "name");
    if (!called.is_string() || called.get_ref<const std::string&>() != name) continue;
    if (ros_count(ros_member(field, "datatype"), kFloat32) != kFloat32) return std::nullopt;
    return ros_count(ros_member(field, "offset"), kMostStep);
  }
  return std::nullopt;
}

Result<RosBody> cloud_in(const RosJson& message) {
  const auto size = size_in(message);
  if (!size) return size.error();
  const auto point_step = ros_count(ros_member(message, "point_step"), kMostStep);
  const auto row_step = ros_count(ros_member(message, "row_step"), kMostStep);
  const auto& fields = ros_member(message, "fields");
  const auto x = field_at(fields, "x"), y = field_at(fields, "y"), z = field_at(fields, "z");
  auto data = ros_bytes(ros_member(message, "data"));
  if (!point_step || !row_step || !x || !y || !z || !data)
    return invalid_input("sends a cloud without points of float32 x, y and z");
  const bool is_whole = std::max({*x, *y, *z}) + sizeof(float) <= *point_step &&
                        *row_step >= *point_step * static_cast<std::size_t>(size->width) &&
                        data->size() / static_cast<std::size_t>(size->height) >= *row_step;
  if (!is_whole) return invalid_input("sends less of a cloud than its size needs");
  return RosBody(RosCloud{size->width, size->height, ros_flag(ros_member(message, "is_bigendian")),
                          *point_step, *row_step, *x, *y, *z, *std::move(data)});
}

/// The member of an object, a number of less than a million; nullopt for anything else.
std::optional<double> plausible_number(const RosJson& of, const char* name) {
  constexpr double kMost = 1e6;
  const auto value = ros_number(ros_member(of, name));
  return value && std::abs(*value) < kMost ? value : std::nullopt;
}

/// geometry_msgs/Pose. `named`: what it is of, for errors. `usual_z_m`: where it states no z; nullopt: it
/// must.
Result<RosPose> pose_in(const RosJson& pose, const char* named, std::optional<double> usual_z_m) {
  const auto& place = ros_member(pose, "position");
  const auto& turn = ros_member(pose, "orientation");
  const auto px = plausible_number(place, "x"), py = plausible_number(place, "y"),
             pz = ros_member(place, "z").is_null() ? usual_z_m : plausible_number(place, "z");
  const auto x = plausible_number(turn, "x"), y = plausible_number(turn, "y"),
             z = plausible_number(turn, "z"), w = plausible_number(turn, "w");
  for (const auto& value : {px, py, pz, x, y, z, w})
    if (!value) return invalid_input(fmt::format("sends {} that is none", named));
  // Zeros of a robot that does not know how it stands are no turn.
  constexpr double kOff = 0.1;
  const double size = *x * *x + *y * *y + *z * *z + *w * *w;
  if (std::abs(size - 1.0) > kOff)
    return invalid_input(fmt::format("sends {} with an orientation that is no unit quaternion", named));
  const double s = 2.0 / size;
  RosPose found{{*px, *py, *pz}};
  found.rotation = {
      1.0 - s * (*y * *y + *z * *z), s * (*x * *y - *w * *z),       s * (*x * *z + *w * *y),
      s * (*x * *y + *w * *z),       1.0 - s * (*x * *x + *z * *z), s * (*y * *z - *w * *x),
      s * (*x * *z - *w * *y),       s * (*y * *z + *w * *x),       1.0 - s * (*x * *x + *y * *y)};
  return found;
}

/// The yaw of the quaternion, ROS' convention: z up.
Result<RosBody> odometry_in(const RosJson& message) {
  const auto pose = pose_in(ros_member(ros_member(message, "pose"), "pose"), "odometry", 0.0);
  if (!pose) return pose.error();
  const auto& twist = ros_member(ros_member(message, "twist"), "twist");
  const auto forward = plausible_number(ros_member(twist, "linear"), "x");
  const auto turning = plausible_number(ros_member(twist, "angular"), "z");
  if (!forward || !turning) return invalid_input("sends odometry that is none");
  const double yaw_rad = std::atan2(pose->rotation[3], pose->rotation[0]);
  return RosBody(RosOdometry{pose->position_m.x, pose->position_m.y, yaw_rad, *forward, *turning});
}

Result<RosBody> stamped_pose_in(const RosJson& message) {
  auto pose = pose_in(ros_member(message, "pose"), "a pose", std::nullopt);
  if (!pose) return std::move(pose).error();
  return RosBody(*std::move(pose));
}

Result<RosBody> sound_format_in(const RosJson& message) {
  constexpr std::size_t kMostChannels = 64, kLeastRate_hz = 8'000, kMostRate_hz = 192'000;
  const auto channels = ros_count(ros_member(message, "channels"), kMostChannels);
  const auto rate_hz = ros_count(ros_member(message, "sample_rate"), kMostRate_hz);
  const auto& samples = ros_member(message, "sample_format");
  if (!channels || *channels == 0 || !rate_hz || *rate_hz < kLeastRate_hz || !samples.is_string())
    return invalid_input("sends sound without channels, rate and format");
  return RosBody(
      RosSoundFormat{static_cast<int>(*channels), static_cast<int>(*rate_hz), samples.get<std::string>()});
}

Result<RosBody> sound_in(const RosJson& data) {
  auto bytes = ros_bytes(data);
  if (!bytes) return invalid_input("sends damaged sound");
  return RosBody(RosSound{*std::move(bytes)});
}

Result<RosBody> body_in(const RosJson& message) {
  for (const char* matrix : {"K", "k"})
    if (const auto& numbers = ros_member(message, matrix); numbers.is_array())
      return ros_camera_in(message, numbers);
  if (message.contains("encoding")) return picture_in(message);
  if (message.contains("format")) return compressed_in(message);
  if (message.contains("point_step")) return cloud_in(message);
  if (message.contains("pose") && message.contains("twist")) return odometry_in(message);
  if (message.contains("pose")) return stamped_pose_in(message);
  if (const auto charge = ros_number(ros_member(message, "percentage")); charge)
    return RosBody(RosBattery{std::clamp(*charge, 0.0, 1.0)});
  if (const auto& data = ros_member(message, "data"); data.is_boolean())
    return RosBody(RosFlag{data.get<bool>()});
  if (message.contains("sample_rate")) return sound_format_in(message);
  const auto& stamped = ros_member(ros_member(message, "audio"), "data");
  for (const auto& data : {ros_member(message, "data"), stamped})
    if (data.is_string() || data.is_array()) return sound_in(data);
  return invalid_input("sends a message of another type than was asked for");
}

std::optional<double> stamp_in(const RosJson& message) {
  const auto& stamp = ros_member(ros_member(message, "header"), "stamp");
  constexpr std::size_t kMost_s = std::size_t{1} << 34U, kNano = 1'000'000'000;
  for (const auto& [whole, part] : {std::pair("secs", "nsecs"), {"sec", "nanosec"}}) {
    const auto seconds = ros_count(ros_member(stamp, whole), kMost_s);
    const auto nano = ros_count(ros_member(stamp, part), kNano);
    if (!seconds || !nano || (*seconds == 0 && *nano == 0)) continue;
    return static_cast<double>(*seconds) + 1e-9 * static_cast<double>(*nano);
  }
  return std::nullopt;
}

RosVersion version_of(const RosJson& message) {
  const auto& stamp = ros_member(ros_member(message, "header"), "stamp");
  if (stamp.is_object() && stamp.contains("secs")) return RosVersion::ros1;
  if (stamp.is_object() && stamp.contains("sec")) return RosVersion::ros2;
  return RosVersion::unknown;
}

std::string shown_words(const RosJson& words) {
  constexpr std::size_t kMost = 200;
  if (!words.is_string() || !is_utf8(words.get_ref<const std::string&>())) return "";
  std::string line = plain_name(words.get_ref<const std::string&>());
  if (line.size() > kMost) {
    std::size_t end = kMost;
    while (end > 0 && (static_cast<unsigned char>(line[end]) & 0xC0U) == 0x80U) --end;
    line.resize(end);
  }
  return line;
}

}  // namespace

Result<RosHeard> parse_rosbridge(std::string_view text) {
  if (text.size() > kLongestRosMessage || !has_plausible_structure(text))
    return invalid_input("sends a message that is larger or nested deeper than any picture");
  const RosJson json = RosJson::parse(text, nullptr, false);
  if (!json.is_object()) return invalid_input("sends something else than JSON of rosbridge");
  const auto& operation = ros_member(json, "op");
  if (operation == "status")
    return RosHeard(RosStatus{ros_member(json, "level") == "error", shown_words(ros_member(json, "msg"))});
  const auto& topic = ros_member(json, "topic");
  const auto& message = ros_member(json, "msg");
  if (operation != "publish" || !topic.is_string() || !message.is_object())
    return invalid_input("sends an operation that was not asked for");
  auto body = body_in(message);
  if (!body) return std::move(body).error();
  return RosHeard(
      RosMessage{topic.get<std::string>(), *std::move(body), version_of(message), stamp_in(message)});
}

}  // namespace palpable::sources
