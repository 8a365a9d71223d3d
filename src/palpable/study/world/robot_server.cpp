// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/study/world/robot_server.hpp"

#include "palpable/core/net/tcp_stream.hpp"
#include "palpable/core/net/web_socket.hpp"
#include "palpable/core/text/base64.hpp"
#include "palpable/study/world/robot_microphones.hpp"
#include "palpable/study/world/sound_scene.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cmath>
#include <deque>
#include <mutex>
#include <set>
#include <span>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

namespace palpable::study {
namespace {

using ServerJson = nlohmann::json;
using ServerClock = std::chrono::steady_clock;

constexpr const char* kDepthTopic = "/camera/depth/image_rect_raw";
constexpr const char* kColourTopic = "/camera/color/image_raw";
constexpr const char* kInfoTopic = "/camera/depth/camera_info";
constexpr const char* kLeftTopic = "/stereo/left/image_rect_color";
constexpr const char* kRightTopic = "/stereo/right/image_rect_color";
constexpr const char* kLeftInfoTopic = "/stereo/left/camera_info";
constexpr const char* kRightInfoTopic = "/stereo/right/camera_info";
constexpr const char* kWristTopic = "/wrist_camera/image_raw";
constexpr const char* kWristInfoTopic = "/wrist_camera/camera_info";
constexpr const char* kWristPoseTopic = "/wrist_camera/pose";

/// Of simulated time.
ServerJson header_of(double time_s, bool is_ros2) {
  const auto whole = static_cast<std::int64_t>(time_s);
  const auto nano = static_cast<std::int64_t>((time_s - static_cast<double>(whole)) * 1e9);
  ServerJson stamp =
      is_ros2 ? ServerJson{{"sec", whole}, {"nanosec", nano}} : ServerJson{{"secs", whole}, {"nsecs", nano}};
  return {{"stamp", std::move(stamp)}, {"frame_id", "camera"}};
}

template <class Value>
ServerJson picture_of(ServerJson header, int width, int height, const char* encoding, std::size_t pixel_bytes,
                      std::span<const Value> data) {
  return {{"header", std::move(header)},
          {"width", width},
          {"height", height},
          {"encoding", encoding},
          {"is_bigendian", 0},
          {"step", pixel_bytes * static_cast<std::size_t>(width)},
          {"data", base64(std::as_bytes(data))}};
}

ServerJson colours_of(ServerJson header, const RoomView& view) {
  return picture_of<Rgb8>(std::move(header), view.colour.width(), view.colour.height(), "rgb8", 3,
                          view.colour.values());
}

/// Millimetres; 0 where the depth is unknown.
std::vector<std::uint16_t> millimetres(const Raster<float>& depth_m) {
  std::vector<std::uint16_t> values;
  values.reserve(depth_m.count());
  for (const float z : depth_m.values()) {
    const double mm = std::isfinite(z) ? std::clamp(1000.0 * double{z}, 0.0, 65535.0) : 0.0;
    values.push_back(static_cast<std::uint16_t>(std::lround(mm)));
  }
  return values;
}

ServerJson odometry_of(ServerJson header, const FloorPose& pose, const WheelMotion& motion) {
  return {{"header", std::move(header)},
          {"pose",
           {{"pose",
             {{"position", {{"x", pose.x_m}, {"y", pose.y_m}, {"z", 0.0}}},
              {"orientation",
               {{"x", 0.0},
                {"y", 0.0},
                {"z", std::sin(0.5 * pose.heading_rad)},
                {"w", std::cos(0.5 * pose.heading_rad)}}}}}}},
          {"twist",
           {{"twist",
             {{"linear", {{"x", motion.forward_m_per_s}, {"y", 0.0}, {"z", 0.0}}},
              {"angular", {{"x", 0.0}, {"y", 0.0}, {"z", motion.turn_rad_per_s}}}}}}}};
}

/// `right_m`: how far it is to the right of the first camera of its pair.
ServerJson camera_info_of(ServerJson header, const Pinhole& camera, bool is_ros2, double right_m = 0.0) {
  return {{"header", std::move(header)},
          {"width", camera.width},
          {"height", camera.height},
          {is_ros2 ? "k" : "K", {camera.fx, 0.0, camera.cx, 0.0, camera.fy, camera.cy, 0.0, 0.0, 1.0}},
          {is_ros2 ? "p" : "P",
           {camera.fx, 0.0, camera.cx, -camera.fx * right_m, 0.0, camera.fy, camera.cy, 0.0, 0.0, 0.0, 1.0,
            0.0}}};
}

ServerJson pose_of(ServerJson header, const Transform<WorldFrame, CameraFrame>& pose) {
  const auto& r = pose.rotation;
  // Of a rotation by less than a half turn, as those of cameras that look ahead are.
  const double w = 0.5 * std::sqrt(std::max(0.0, 1.0 + r[0] + r[4] + r[8]));
  const Vec3 at = pose.translation_m;
  return {{"header", std::move(header)},
          {"pose",
           {{"position", {{"x", at.x}, {"y", at.y}, {"z", at.z}}},
            {"orientation",
             {{"x", (r[7] - r[5]) / (4.0 * w)},
              {"y", (r[2] - r[6]) / (4.0 * w)},
              {"z", (r[3] - r[1]) / (4.0 * w)},
              {"w", w}}}}}};
}

std::string sent_text(const char* topic, const ServerJson& message) {
  return ServerJson{{"op", "publish"}, {"topic", topic}, {"msg", message}}.dump();
}

double component(const ServerJson& message, const char* of, const char* name) {
  const auto vector = message.find(of);
  if (vector == message.end() || !vector->is_object()) return NAN;
  const auto value = vector->find(name);
  return value != vector->end() && value->is_number() ? value->get<double>() : NAN;
}

}  // namespace

struct RobotServer::Impl {
  Impl(const RobotServerOptions& wanted, TcpListener bound)
      : options(wanted),
        link(wanted.link),
        camera(camera_of(wanted.width, wanted.height, wanted.field_of_view_rad)),
        wrist(camera_of(wanted.wrist_width, wanted.wrist_height, wanted.wrist_field_of_view_rad)),
        world(make_room(wanted.seed), wanted.body, wanted.errors, wanted.seed),
        microphones(world.room(), square_array(kArray_m), wanted.body.camera_height_m, wanted.seed),
        random(wanted.seed),
        listener(std::move(bound)) {}

  void run() {
    begin = ServerClock::now();
    std::unique_ptr<WebSocket> socket;
    while (!ending) {
      if (hangs_up.exchange(false)) socket.reset();
      if (!socket) socket = accepted();
      follow_clock();
      if (socket && !serve(*socket)) socket.reset();
      if (!socket) subscribed.clear();
    }
  }

  std::unique_ptr<WebSocket> accepted() {
    wait_for_any(std::array{listener.descriptor()}, std::chrono::milliseconds(5));
    auto stream = listener.accept();
    if (!stream) return nullptr;
    constexpr WebSocket::Limits kLimits{std::size_t{1} << 16U, std::size_t{1} << 23U};
    auto socket = WebSocket::accept(*std::move(stream), std::chrono::seconds(1), kLimits);
    waiting.clear();
    return socket ? *std::move(socket) : nullptr;
  }

  void follow_clock() {
    const std::lock_guard lock(mutex);
    // A machine that stalls does not let the robot jump.
    constexpr double kMost_s = 0.1;
    const double now_s = std::chrono::duration<double>(ServerClock::now() - begin).count();
    world.advance(std::min(now_s - followed_s, kMost_s));
    followed_s = now_s;
  }

  /// False: the connection is lost.
  bool serve(WebSocket& socket) {
    // All that came: on a busy machine commands would wait in line, and be followed seconds later.
    for (auto patience = std::chrono::microseconds(2000);; patience = std::chrono::microseconds(200)) {
      auto received = socket.receive(ServerClock::now() + patience);
      if (!received) return false;
      if (!*received) break;
      take(**received);
    }
    if (followed_s >= next_picture_s) take_picture();
    if (followed_s >= next_state_s) send_state(socket);
    if (followed_s >= next_wrist_s) send_wrist(socket);
    if (options.has_sound && followed_s >= next_sound_s) send_sound(socket);
    for (; !waiting.empty() && waiting.front().first <= followed_s; waiting.pop_front())
      for (std::string& message : waiting.front().second) socket.send(std::move(message));
    return true;
  }

  void take(const std::string& text) {
    const ServerJson json = ServerJson::parse(text, nullptr, false);
    if (!json.is_object() || !json.contains("op") || !json.contains("topic") || !json["topic"].is_string())
      return;
    const std::string topic = json["topic"];
    if (json["op"] == "subscribe") subscribed.insert(topic);
    if (json["op"] == "unsubscribe") subscribed.erase(topic);
    if (json["op"] != "publish" || !json.contains("msg") || !json["msg"].is_object()) return;
    const auto& message = json["msg"];
    const std::lock_guard lock(mutex);
    if (topic == "/arm/cmd_vel") {
      ++arm_commands;
      world.command_arm(component(message, "linear", "y"));
    }
    if (topic != "/cmd_vel") return;
    ++commands;
    world.command({component(message, "linear", "x"), component(message, "angular", "z")});
  }

  void take_picture() {
    // This thread alone changes the world, so it may look at it without the lock, for which others would
    // starve.
    const RobotLink now = [&] {
      const std::lock_guard lock(mutex);
      return link;
    }();
    next_picture_s = std::max(next_picture_s + 1.0 / now.rate_hz, followed_s);
    const auto uniform = [&] { return static_cast<double>(random() >> 11U) * 0x1p-53; };
    if (uniform() < now.loss) return;
    std::vector<std::string> messages =
        options.eyes == RobotEyes::stereo ? pair_messages() : depth_messages();
    // Messages of one connection stay in their order.
    const double due_s = followed_s + now.delay_s + now.jitter_s * uniform();
    waiting.emplace_back(std::max(due_s, waiting.empty() ? 0.0 : waiting.back().first), std::move(messages));
  }

  RoomView seen(RoomView (RobotWorld::*eye)(const Pinhole&, const CameraNoise&) const) {
    CameraNoise noise = options.noise;
    noise.seed = random();
    return (world.*eye)(camera, noise);
  }
  void add_message(std::vector<std::string>& messages, const char* topic, const ServerJson& message) const {
    if (subscribed.contains(topic)) messages.push_back(sent_text(topic, message));
  }

  std::vector<std::string> depth_messages() {
    const RoomView view = seen(&RobotWorld::view);
    const auto header = [&] { return header_of(world.time_s(), options.is_ros2); };
    std::vector<std::string> messages;
    add_message(messages, kInfoTopic, camera_info_of(header(), camera, options.is_ros2));
    add_message(messages, kColourTopic, colours_of(header(), view));
    add_message(messages, kDepthTopic,
                picture_of<std::uint16_t>(header(), camera.width, camera.height, "16UC1", 2,
                                          millimetres(view.depth_m)));
    return messages;
  }

  std::vector<std::string> pair_messages() {
    const RoomView left = seen(&RobotWorld::view), right = seen(&RobotWorld::right_view);
    const auto header = [&] { return header_of(world.time_s(), options.is_ros2); };
    std::vector<std::string> messages;
    add_message(messages, kLeftInfoTopic, camera_info_of(header(), camera, options.is_ros2));
    add_message(messages, kRightInfoTopic,
                camera_info_of(header(), camera, options.is_ros2, options.body.baseline_m));
    add_message(messages, kLeftTopic, colours_of(header(), left));
    add_message(messages, kRightTopic, colours_of(header(), right));
    return messages;
  }

  void send_state(WebSocket& socket) {
    constexpr double kPeriod_s = 0.02;
    next_state_s = followed_s + kPeriod_s;
    const ServerJson header = header_of(world.time_s(), options.is_ros2);
    const auto add = [&](const char* topic, const ServerJson& message) {
      if (subscribed.contains(topic)) socket.send(sent_text(topic, message));
    };
    add("/odom", odometry_of(header, world.odometry(), world.motion()));
    add("/contact", {{"data", world.has_touched()}});
    add(kWristPoseTopic, pose_of(header, world.measured_base_from_wrist()));
    if (followed_s < next_battery_s) return;
    next_battery_s = followed_s + 1.0;
    add("/battery_state", {{"header", header}, {"percentage", 0.8}});
  }

  void send_wrist(WebSocket& socket) {
    next_wrist_s = followed_s + 1.0 / options.wrist_rate_hz;
    if (!subscribed.contains(kWristTopic)) return;
    CameraNoise noise = options.noise;
    noise.seed = random();
    const RoomView view = world.wrist_view(wrist, noise);
    const ServerJson header = header_of(world.time_s(), options.is_ros2);
    socket.send(sent_text(kWristInfoTopic, camera_info_of(header, wrist, options.is_ros2)));
    socket.send(sent_text(kWristTopic, colours_of(header, view)));
  }

  void send_sound(WebSocket& socket) {
    constexpr double kPart_s = 0.05;
    // Parts that nobody subscribed to, or that a stall held back, are not made up for.
    next_sound_s = std::max(next_sound_s + kPart_s, followed_s - kPart_s);
    if (!subscribed.contains("/audio")) return;
    constexpr auto kLength = static_cast<std::size_t>(kPart_s * RobotMicrophones::kRate_hz);
    const auto samples = microphones.hear(world.pose(), kLength);
    socket.send(sent_text("/audio", {{"data", base64(std::as_bytes(std::span(samples)))}}));
    if (!subscribed.contains("/audio_info") || followed_s < next_format_s) return;
    next_format_s = followed_s + 1.0;
    socket.send(sent_text("/audio_info", {{"channels", 4},
                                          {"sample_rate", RobotMicrophones::kRate_hz},
                                          {"sample_format", "S16LE"},
                                          {"bitrate", 0},
                                          {"coding_format", "wave"}}));
  }

  static constexpr double kArray_m = 0.1;

  RobotServerOptions options;
  RobotLink link;
  Pinhole camera, wrist;
  /// Guards changes of the world, the link and the count of commands.
  mutable std::mutex mutex;
  RobotWorld world;
  RobotMicrophones microphones;
  std::mt19937_64 random;
  TcpListener listener;
  std::set<std::string> subscribed;
  /// When they are sent.
  std::deque<std::pair<double, std::vector<std::string>>> waiting;
  ServerClock::time_point begin;
  double followed_s = 0.0;
  double next_picture_s = 0.0, next_state_s = 0.0, next_battery_s = 0.0, next_sound_s = 0.0,
         next_format_s = 0.0, next_wrist_s = 0.0;
  std::uint64_t commands = 0, arm_commands = 0;
  std::atomic<bool> hangs_up{false};
  std::atomic<bool> ending{false};
  std::thread thread;
};

RobotServer::RobotServer(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {
  impl_->thread = std::thread([raw = impl_.get()] { raw->run(); });
}

RobotServer::~RobotServer() {
  impl_->ending = true;
  impl_->thread.join();
}

Result<std::unique_ptr<RobotServer>> RobotServer::start(const RobotServerOptions& options) {
  auto listener = TcpListener::open("127.0.0.1", options.port);
  if (!listener) return std::move(listener).error();
  return std::unique_ptr<RobotServer>(new RobotServer(std::make_unique<Impl>(options, *std::move(listener))));
}

std::uint16_t RobotServer::port() const { return impl_->listener.port(); }

FloorPose RobotServer::pose() const {
  const std::lock_guard lock(impl_->mutex);
  return impl_->world.pose();
}

WheelMotion RobotServer::commanded() const {
  const std::lock_guard lock(impl_->mutex);
  return impl_->world.commanded();
}

bool RobotServer::has_touched() const {
  const std::lock_guard lock(impl_->mutex);
  return impl_->world.has_touched();
}

double RobotServer::arm_m() const {
  const std::lock_guard lock(impl_->mutex);
  return impl_->world.base_from_wrist().translation_m.y;
}

double RobotServer::arm_m_per_s() const {
  const std::lock_guard lock(impl_->mutex);
  return impl_->world.arm_m_per_s();
}

std::uint64_t RobotServer::arm_commands() const {
  const std::lock_guard lock(impl_->mutex);
  return impl_->arm_commands;
}

std::uint64_t RobotServer::commands() const {
  const std::lock_guard lock(impl_->mutex);
  return impl_->commands;
}

Point<WorldFrame> RobotServer::sound_source() const { return impl_->microphones.source(); }

void RobotServer::set_link(const RobotLink& link) {
  const std::lock_guard lock(impl_->mutex);
  impl_->link = link;
}

void RobotServer::hang_up() { impl_->hangs_up = true; }

}  // namespace palpable::study
