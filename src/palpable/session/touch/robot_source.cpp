// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/session/touch/robot_source.hpp"

#include "palpable/core/picture/camera_pose.hpp"
#include "palpable/session/robot/drive_surface.hpp"
#include "palpable/session/touch/robot_hand.hpp"
#include "palpable/session/touch/robot_hearing.hpp"
#include "palpable/session/touch/robot_views.hpp"
#include "palpable/session/touch/robot_wheels.hpp"
#include "palpable/session/touch/ros_eyes.hpp"
#include "palpable/session/touch/touch_session.hpp"
#include "palpable/session/touch/what_is_ahead.hpp"
#include "palpable/sources/live/rosbridge_client.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <condition_variable>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>

namespace palpable::session {
namespace {

using sources::RosbridgeClient;
using RobotClock = std::chrono::steady_clock;

constexpr auto kTick = std::chrono::milliseconds(20);

double now_s() { return RobotWheels::seconds_of(RobotClock::now()); }

/// Where a robot's camera is in the frame of its odometry, z up.
Transform<WorldFrame, CameraFrame> world_from_camera(const RobotPose& robot, const RobotShape& shape) {
  const double c = std::cos(robot.heading_rad), s = std::sin(robot.heading_rad);
  const double ahead_m = shape.camera_forward_m, left_m = shape.camera_left_m;
  return camera_pose(
      {{robot.x_m + ahead_m * c - left_m * s, robot.y_m + ahead_m * s + left_m * c, shape.camera_height_m}},
      robot.heading_rad, shape.camera_down_rad);
}

class RobotSource final : public LiveSource, public RobotControl {
 public:
  RobotSource(std::shared_ptr<RosbridgeClient> client, std::unique_ptr<LiveSource> eyes,
              const RobotAddress& address, const RobotWheels::Places& wheels, const RobotViews::Places& wrist,
              std::optional<RobotEars> ears, const RobotHearing::Options& hearing)
      : client_(std::move(client)),
        eyes_(std::move(eyes)),
        shape_(address.drive.shape),
        wheels_(*client_, wheels, address.drive, address.mode),
        hearing_(std::move(ears), hearing) {
    hand_.change_mode(address.mode);
    if (address.wrist)
      views_ = std::make_unique<RobotViews>(*client_, wrist, address.wrist->sweep, address.drive.shape);
    thread_ = std::thread([this] { run(); });
    looking_ = std::thread([this] { look(); });
  }
  ~RobotSource() override {
    ending_ = true;
    thread_.join();
    looking_.join();
  }

  // LiveSource
  Result<std::optional<LiveFrame>> take(RobotClock::time_point deadline) override {
    std::unique_lock lock(mutex_);
    changed_.wait_until(lock, deadline, [&] { return newest_ || fault_; });
    if (fault_) return *std::exchange(fault_, std::nullopt);
    return std::exchange(newest_, std::nullopt);
  }
  bool has_ended() const override { return false; }
  std::optional<Image> colour() override {
    if (views_)
      if (auto near = views_->colour()) return near;
    const std::lock_guard lock(mutex_);
    wants_colour_ = true;
    return std::exchange(colour_, std::nullopt);
  }
  vision::DepthNoise noise() const override {
    const std::lock_guard lock(mutex_);
    return noise_;
  }
  std::optional<std::string> loss() override { return client_->loss(); }
  std::optional<std::string> notice() override {
    if (auto words = client_->notice()) return words;
    if (auto words = notices_.take()) return words;
    if (views_)
      if (auto words = views_->notice()) return words;
    return hearing_.notice();
  }
  std::string_view kind() const override { return "robot"; }
  std::shared_ptr<const models::Relief> surface(const SeenView& seen) override {
    camera_seen_ = seen.camera;
    if (wheels_.mode() == RobotMode::touch) return touched_view(seen);
    auto made = drive_surface(wheels_.drive(), seen.relief);
    return made ? *std::move(made) : nullptr;
  }
  RobotControl* robot() override { return this; }
  bool marks_sounds() const override { return hearing_.marks(); }
  void mark_sound(Raster<std::uint8_t>& labels, std::uint8_t label, const Pinhole& camera) override {
    hearing_.mark(labels, label, camera, now_s(), wheels_.pose().heading_rad);
  }
  std::shared_ptr<const models::RouteGuide> guide(const models::Scene& scene) override {
    const TouchSession* session = hand_.touch();
    if (!hearing_.pulls() || session == nullptr) return scene.guide;
    // A pull leads to a mark, and there is none in the other views.
    const bool is_marked = wheels_.mode() == RobotMode::touch && (!views_ || views_->is_plain());
    return hearing_.guide(scene, *session, is_marked ? camera_seen_ : std::nullopt, now_s(),
                          wheels_.pose().heading_rad);
  }
  void begin(TouchSession& session) override { hand_.begin(session); }
  void end() override {
    request_stop();
    hand_.end();
  }

  // RobotControl
  RobotState state() const override {
    RobotState state = wheels_.state();
    if (views_) state.view = view_;
    return state;
  }
  std::shared_ptr<const RobotFloor> floor() const override { return wheels_.floor(); }
  std::optional<std::string> state_notice() override { return wheels_.notice(); }
  void request_start() override { wheels_.request_start(); }
  void request_stop() override { wheels_.request_stop(); }
  void request_mode(RobotMode mode) override {
    wheels_.change_mode(mode);
    hand_.change_mode(mode);
  }
  void request_view(RobotView view) override {
    if (views_) return views_->request(view);
    notices_.put("This robot has no near view: its address names no arm (arm=/TOPIC).");
  }
  RobotStatistics statistics() const override {
    RobotStatistics statistics = wheels_.statistics();
    statistics.sounds = hearing_.sounds();
    if (views_) statistics.arm = {views_->arm_commands(), views_->near_views()};
    return statistics;
  }

 private:
  void run() {
    for (auto next = RobotClock::now(); !ending_; next += kTick) {
      tick(RobotClock::now());
      std::this_thread::sleep_until(std::min(next, RobotClock::now() + kTick));
      next = std::max(next, RobotClock::now() - kTick);
    }
    // Several, since one may be lost; none leaves while the connection is busy.
    constexpr int kZeros = 3, kTries = 25;
    for (int tries = 0, sent = 0; tries < kTries && sent < kZeros;
         ++tries, std::this_thread::sleep_for(kTick)) {
      const bool stands = wheels_.stand();
      const bool arm_stands = !views_ || views_->stop_arm();
      sent += stands && arm_stands ? 1 : 0;
    }
  }
  /// Takes what its camera sees: on a thread of its own, since the depth of a pair takes longer than the
  /// wheels may wait.
  void look() {
    constexpr auto kPatience = std::chrono::milliseconds(50);
    while (!ending_) {
      auto taken = eyes_->take(RobotClock::now() + kPatience);
      if (!taken) {
        fail(taken.error());
        std::this_thread::sleep_for(kTick);
      } else if (*taken) {
        take_picture(**std::move(taken));
      }
    }
  }
  /// As surface(), in the mode touch.
  std::shared_ptr<const models::Relief> touched_view(const SeenView& seen) {
    TouchSession* session = hand_.touch();
    return views_ && session != nullptr ? views_->surface(seen, *session) : nullptr;
  }
  void fail(const Error& error) {
    const std::lock_guard lock(mutex_);
    fault_ = error;
    changed_.notify_all();
  }

  void take_picture(LiveFrame frame) {
    wheels_.take_picture(frame.arrival, frame.depth, frame.stamp_s);
    if (const auto pose = wheels_.pose_at(frame.stamp_s))
      frame.world_from_camera = world_from_camera(*pose, shape_);
    const RobotState robot = wheels_.state();
    const bool stands = robot.is_started && !robot.moves && robot.mode != RobotMode::touch;
    if (auto words = ahead_.look(now_s(), frame.depth, shape_, stands)) notices_.put(*std::move(words));
    const std::lock_guard lock(mutex_);
    noise_ = eyes_->noise();
    if (std::exchange(wants_colour_, false)) colour_ = eyes_->colour();
    newest_ = std::move(frame);
    changed_.notify_all();
  }

  void tick(RobotClock::time_point now) {
    hand_.follow_law();
    const RobotNow robot = wheels_.tick(now, hand_.now());
    if (views_) {
      views_->tick(robot);
      view_ = views_->view();
    }
    hearing_.listen(*client_, robot.t_s, robot.pose.heading_rad);
  }

  std::shared_ptr<RosbridgeClient> client_;
  /// The thread's that looks.
  std::unique_ptr<LiveSource> eyes_;
  RobotShape shape_;
  RobotWheels wheels_;
  RobotHearing hearing_;
  std::atomic<bool> ending_{false};
  std::atomic<RobotView> view_{RobotView::wide};
  Notices notices_;
  RobotHand hand_;
  /// Null: there is no near view.
  std::unique_ptr<RobotViews> views_;

  /// The feed's thread's own: of the last surface().
  std::optional<Pinhole> camera_seen_;

  /// The thread's that looks.
  AheadWatch ahead_;

  /// Guards what follows.
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::optional<LiveFrame> newest_;
  std::optional<Error> fault_;
  vision::DepthNoise noise_;
  std::optional<Image> colour_;
  bool wants_colour_ = true;
  std::thread thread_, looking_;
};

}  // namespace

Result<std::unique_ptr<LiveSource>> open_robot_source(const RobotAddress& address, const Work& work) {
  if (auto valid = check(address.drive); !valid) return std::move(valid).error();
  sources::RosbridgeOptions options;
  options.host = address.pictures.host;
  options.port = address.pictures.port;
  const RosEyesTopics eyes = add_topics(address.pictures, options.topics);
  options.publications = {{address.command, "geometry_msgs", "Twist"}};
  RobotViews::Places places;
  RobotHearing::Options hearing{address.marks_sounds, address.pulls_to_sounds,
                                address.drive.shape.camera_down_rad};
  const auto add = [&](const std::string& topic) {
    options.topics.push_back(topic);
    return options.topics.size() - 1;
  };
  const RobotWheels::Places wheels{add(address.odometry), add(address.battery), add(address.contact), 0};
  if (const auto& wrist = address.wrist) {
    if (auto valid = check(wrist->sweep); !valid) return std::move(valid).error();
    places = {add(wrist->picture), add(wrist->info), add(wrist->pose), options.publications.size()};
    options.on_demand = {places.picture};
    options.publications.push_back({wrist->arm, "geometry_msgs", "Twist"});
  }
  std::optional<RobotEars> ears;
  if (address.microphones) {
    auto made = RobotEars::create(*address.microphones, {});
    if (!made) return std::move(made).error();
    ears = *std::move(made);
    hearing.sound = add(address.sound);
    hearing.sound_format = add(address.sound_format);
    options.kept_whole = {hearing.sound};
  }
  auto opened = RosbridgeClient::open(std::move(options));
  if (!opened) return std::move(opened).error();
  const std::shared_ptr<RosbridgeClient> client = *std::move(opened);
  return std::unique_ptr<LiveSource>(
      std::make_unique<RobotSource>(client, ros_eyes(client, eyes, address.pictures, work), address, wheels,
                                    places, std::move(ears), hearing));
}

}  // namespace palpable::session
