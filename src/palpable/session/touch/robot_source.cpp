// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/session/touch/robot_source.hpp"

#include "palpable/session/robot/drive_surface.hpp"
#include "palpable/session/touch/frame_order.hpp"
#include "palpable/session/touch/robot_hand.hpp"
#include "palpable/session/touch/robot_hearing.hpp"
#include "palpable/session/touch/robot_views.hpp"
#include "palpable/session/touch/robot_wheels.hpp"
#include "palpable/session/touch/touch_session.hpp"
#include "palpable/session/touch/what_is_ahead.hpp"
#include "palpable/sources/live/rosbridge_client.hpp"
#include "palpable/sources/live/rosbridge_picture.hpp"

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>
#include <variant>

namespace palpable::session {
namespace {

using sources::RosbridgeClient;
using RobotClock = std::chrono::steady_clock;

/// Places of the topics in the client's list.
enum RobotTopic : std::size_t {
  kRobotDepth,
  kRobotColour,
  kRobotInfo,
  kRobotOdometry,
  kRobotBattery,
  kRobotContact
};

constexpr auto kTick = std::chrono::milliseconds(20);

double now_s() { return RobotWheels::seconds_of(RobotClock::now()); }

class RobotSource final : public LiveSource, public RobotControl {
 public:
  RobotSource(std::unique_ptr<RosbridgeClient> client, const RobotAddress& address,
              const RobotViews::Places& wrist, std::optional<RobotEars> ears,
              const RobotHearing::Options& hearing)
      : client_(std::move(client)),
        metres_per_unit_(address.pictures.metres_per_unit),
        shape_(address.drive.shape),
        wheels_(*client_, {kRobotOdometry, kRobotBattery, kRobotContact, 0}, address.drive, address.mode),
        hearing_(std::move(ears), hearing) {
    hand_.change_mode(address.mode);
    if (address.wrist)
      views_ = std::make_unique<RobotViews>(*client_, wrist, address.wrist->sweep, address.drive.shape);
    thread_ = std::thread([this] { run(); });
  }
  ~RobotSource() override {
    ending_ = true;
    thread_.join();
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
    const auto newest = client_->take(kRobotColour);
    if (!newest) return std::nullopt;
    auto picture = sources::colour_of(newest->message.body);
    return picture ? std::optional(*std::move(picture)) : std::nullopt;
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
      // Wakes for each picture, so that none waits for the next tick.
      auto depth = client_->wait(kRobotDepth, next);
      if (depth && *depth) take_picture(**depth);
      if (!depth) fail(depth.error());
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
  /// As surface(), in the mode touch.
  std::shared_ptr<const models::Relief> touched_view(const SeenView& seen) {
    TouchSession* session = hand_.touch();
    return views_ && session != nullptr ? views_->surface(seen, *session) : nullptr;
  }
  void fail(const Error& error) {
    const std::lock_guard lock(mutex_);
    if (!std::exchange(has_failed_, true)) fault_ = error;
    changed_.notify_all();
  }

  void take_picture(RosbridgeClient::Newest& newest) {
    if (order_.is_late(newest.message.stamp_s)) return;
    if (const auto info = client_->take(kRobotInfo))
      if (const auto* camera = std::get_if<Pinhole>(&info->message.body)) camera_ = *camera;
    auto depth = sources::depth_of(newest.message.body, camera_, metres_per_unit_);
    if (depth) {
      wheels_.take_picture(newest.arrival, *depth, newest.message.stamp_s);
      const RobotState robot = wheels_.state();
      const bool stands = robot.is_started && !robot.moves && robot.mode != RobotMode::touch;
      if (auto words = ahead_.look(now_s(), *depth, shape_, stands)) notices_.put(*std::move(words));
    }
    const std::lock_guard lock(mutex_);
    if (!depth) {
      fault_ = invalid_input(depth.error().message, client_->name());
    } else {
      newest_ = LiveFrame{newest.number, newest.arrival, *std::move(depth)};
    }
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

  std::unique_ptr<RosbridgeClient> client_;
  std::optional<double> metres_per_unit_;
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

  // The thread's own.
  std::optional<Pinhole> camera_;
  FrameOrder order_;
  AheadWatch ahead_;
  bool has_failed_ = false;

  /// Guards what follows.
  std::mutex mutex_;
  std::condition_variable changed_;
  std::optional<LiveFrame> newest_;
  std::optional<Error> fault_;
  std::thread thread_;
};

}  // namespace

Result<std::unique_ptr<LiveSource>> open_robot_source(const RobotAddress& address) {
  if (auto valid = check(address.drive); !valid) return std::move(valid).error();
  sources::RosbridgeOptions options;
  options.host = address.pictures.host;
  options.port = address.pictures.port;
  options.topics = {address.pictures.depth, address.pictures.colour, address.pictures.info,
                    address.odometry,       address.battery,         address.contact};
  options.publications = {{address.command, "geometry_msgs", "Twist"}};
  RobotViews::Places places;
  RobotHearing::Options hearing{address.marks_sounds, address.pulls_to_sounds,
                                address.drive.shape.camera_down_rad};
  const auto add = [&](const std::string& topic) {
    options.topics.push_back(topic);
    return options.topics.size() - 1;
  };
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
  auto client = RosbridgeClient::open(std::move(options));
  if (!client) return std::move(client).error();
  return std::unique_ptr<LiveSource>(
      std::make_unique<RobotSource>(*std::move(client), address, places, std::move(ears), hearing));
}

}  // namespace palpable::session
