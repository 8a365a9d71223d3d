// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/session/touch/robot_source.hpp"

#include "palpable/session/robot/drive_surface.hpp"
#include "palpable/session/robot/motion_watch.hpp"
#include "palpable/session/robot/robot_messages.hpp"
#include "palpable/session/touch/robot_hand.hpp"
#include "palpable/session/touch/robot_hearing.hpp"
#include "palpable/session/touch/robot_views.hpp"
#include "palpable/session/touch/touch_session.hpp"
#include "palpable/sources/live/rosbridge_client.hpp"
#include "palpable/sources/live/rosbridge_picture.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <condition_variable>
#include <deque>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>
#include <variant>

#include <fmt/format.h>

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

double seconds_of(RobotClock::time_point time) {
  return std::chrono::duration<double>(time.time_since_epoch()).count();
}

class RobotSource final : public LiveSource, public RobotControl {
 public:
  RobotSource(std::unique_ptr<RosbridgeClient> client, const RobotAddress& address,
              const RobotViews::Places& wrist, std::optional<RobotEars> ears,
              const RobotHearing::Options& hearing)
      : client_(std::move(client)),
        metres_per_unit_(address.pictures.metres_per_unit),
        hearing_(std::move(ears), hearing),
        drive_(address.drive) {
    drive_.set_mode(address.mode);
    mode_ = address.mode;
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
    // Before what follows from it.
    if (auto words = own_notice()) return words;
    if (views_)
      if (auto words = views_->notice()) return words;
    return hearing_.notice();
  }
  std::string_view kind() const override { return "robot"; }
  std::shared_ptr<const models::Relief> surface(const SeenView& seen) override {
    camera_seen_ = seen.camera;
    if (mode() == RobotMode::touch) return touched_view(seen);
    const RobotDrive now = [&] {
      const std::lock_guard lock(mutex_);
      return drive_;
    }();
    auto made = drive_surface(now, seen.relief);
    return made ? *std::move(made) : nullptr;
  }
  RobotControl* robot() override { return this; }
  bool marks_sounds() const override { return hearing_.marks(); }
  void mark_sound(Raster<std::uint8_t>& labels, std::uint8_t label, const Pinhole& camera) override {
    hearing_.mark(labels, label, camera, seconds_of(RobotClock::now()), pose().heading_rad);
  }
  std::shared_ptr<const models::RouteGuide> guide(const models::Scene& scene) override {
    const TouchSession* session = hand_.touch();
    if (!hearing_.pulls() || session == nullptr) return scene.guide;
    // A pull leads to a mark, and there is none in the other views.
    const bool is_marked = mode() == RobotMode::touch && (!views_ || views_->is_plain());
    return hearing_.guide(scene, *session, is_marked ? camera_seen_ : std::nullopt,
                          seconds_of(RobotClock::now()), pose().heading_rad);
  }
  void begin(TouchSession& session) override { hand_.begin(session); }
  void end() override {
    request_stop();
    hand_.end();
  }

  // RobotControl
  void request_start() override { asked_ = Asked::start; }
  void request_stop() override { asked_ = Asked::stop; }
  void request_mode(RobotMode mode) override {
    const std::lock_guard lock(mutex_);
    mode_ = mode;
    drive_.set_mode(mode);
    hand_.change_mode(mode);
    notices_.emplace_back(sentence_of(mode));
  }
  void request_view(RobotView view) override {
    if (views_) return views_->request(view);
    const std::lock_guard lock(mutex_);
    notices_.emplace_back("This robot has no near view: its address names no arm (arm=/TOPIC).");
  }
  RobotStatistics statistics() const override {
    const std::lock_guard lock(mutex_);
    RobotStatistics statistics = statistics_;
    statistics.picture_age = picture_ages_.summary();
    statistics.is_started = drive_.is_started();
    statistics.sounds = hearing_.sounds();
    if (views_) statistics.arm = {views_->arm_commands(), views_->near_views()};
    return statistics;
  }

 private:
  enum class Asked : std::uint8_t { nothing, start, stop };

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
      const bool stands = !has_commanded_ || client_->publish(0, twist_text({}));
      const bool arm_stands = !views_ || views_->stop_arm();
      sent += stands && arm_stands ? 1 : 0;
    }
  }
  std::optional<std::string> own_notice() {
    const std::lock_guard lock(mutex_);
    if (notices_.empty()) return std::nullopt;
    std::string first = std::move(notices_.front());
    notices_.pop_front();
    return first;
  }

  /// As surface(), in the mode touch.
  std::shared_ptr<const models::Relief> touched_view(const SeenView& seen) {
    TouchSession* session = hand_.touch();
    return views_ && session != nullptr ? views_->surface(seen, *session) : nullptr;
  }
  RobotPose pose() const {
    const std::lock_guard lock(mutex_);
    return drive_.pose();
  }

  void fail(const Error& error) {
    const std::lock_guard lock(mutex_);
    if (!std::exchange(has_failed_, true)) fault_ = error;
    changed_.notify_all();
  }

  void take_picture(RosbridgeClient::Newest& newest) {
    if (const auto info = client_->take(kRobotInfo))
      if (const auto* camera = std::get_if<Pinhole>(&info->message.body)) camera_ = *camera;
    auto depth = sources::depth_of(newest.message.body, camera_, metres_per_unit_);
    const std::lock_guard lock(mutex_);
    if (!depth) {
      fault_ = invalid_input(depth.error().message, client_->name());
    } else {
      drive_.take_picture(seconds_of(newest.arrival), *depth, newest.message.stamp_s);
      // A picture that is newer than the odometry is younger than that can tell.
      if (newest.message.stamp_s && odometry_stamp_s_)
        picture_ages_.record_ns(1e9 * std::max(0.0, *odometry_stamp_s_ - *newest.message.stamp_s));
      newest_ = LiveFrame{newest.number, newest.arrival, *std::move(depth)};
    }
    changed_.notify_all();
  }

  void tick(RobotClock::time_point now) {
    take_state();
    // It may have come back since the last tick.
    const std::uint64_t losses = client_->losses();
    const bool was_lost = std::exchange(losses_, losses) != losses || !client_->is_connected();
    hand_.follow_law();
    const RobotNow robot = follow(now, was_lost, hand_.now());
    if (views_) views_->tick(robot);
  }

  /// Commands the wheels, and says what the arm may do.
  RobotNow follow(RobotClock::time_point now, bool was_lost, const RobotHand::Now& hand) {
    const bool is_connected = client_->is_connected();
    const std::lock_guard lock(mutex_);
    notice_stall(now);
    // The robot may still have the command of before the loss.
    const bool had_lost = std::exchange(was_lost_, was_lost);
    if (is_connected && (was_lost || had_lost) && has_commanded_) started_at_ = now;
    if (was_lost) {
      // A start that was asked for before is no start of what comes back.
      asked_ = Asked::nothing;
      if (drive_.is_started())
        notices_.emplace_back("The robot is not started any more: its connection was lost.");
      drive_.lose_link();
    }
    follow_wishes(seconds_of(now));
    if (hand.is_released) drive_.release_hand();
    if (hand.at) drive_.take_hand(seconds_of(now), *hand.at);
    const auto command = drive_.command(seconds_of(now));
    tell(command.limit, now);
    send(command.velocity, now);
    watch_motion(now);
    // As the wheels in the other modes, the arm moves only while nothing else makes the robot stand.
    return {seconds_of(now), mode_, drive_.is_started(), command.limit == DriveLimit::standing,
            drive_.pose()};
  }

  /// A program that stood still must not go on by itself.
  void notice_stall(RobotClock::time_point now) {
    constexpr auto kStall = std::chrono::milliseconds(500);
    const auto before = std::exchange(ticked_at_, now);
    if (!before || now - *before < kStall || !drive_.is_started()) return;
    drive_.stop();
    notices_.emplace_back("The robot is stopped, since this program stood still: start it again.");
  }

  void take_state() {
    if (const auto newest = client_->take(kRobotOdometry))
      if (const auto* at = std::get_if<sources::RosOdometry>(&newest->message.body)) {
        const std::lock_guard lock(mutex_);
        drive_.take_odometry(seconds_of(newest->arrival), {at->x_m, at->y_m, at->yaw_rad},
                             newest->message.stamp_s);
        odometry_stamp_s_ = newest->message.stamp_s;
        measured_ = {at->forward_m_per_s, at->turn_rad_per_s};
      }
    if (const auto newest = client_->take(kRobotContact))
      if (const auto* touches = std::get_if<sources::RosFlag>(&newest->message.body))
        take_contact(touches->value);
    hearing_.listen(*client_, seconds_of(RobotClock::now()), pose().heading_rad);
    if (const auto newest = client_->take(kRobotBattery))
      if (const auto* battery = std::get_if<sources::RosBattery>(&newest->message.body))
        take_battery(battery->charge);
  }

  void take_contact(bool touches) {
    const std::lock_guard lock(mutex_);
    if (touches && !touches_) {
      drive_.stop();
      notices_.emplace_back("The robot touches something: it is stopped, and must be started again.");
    }
    touches_ = touches;
  }

  void take_battery(double charge) {
    constexpr double kLow = 0.15;
    const std::lock_guard lock(mutex_);
    if (charge < kLow && !std::exchange(said_battery_, true))
      notices_.push_back(fmt::format("The robot's battery is at {:.0f} %.", 100.0 * charge));
  }

  RobotMode mode() const {
    const std::lock_guard lock(mutex_);
    return mode_;
  }

  void follow_wishes(double now_s) {
    if (asked_ == Asked::stop) {
      asked_ = Asked::nothing;
      if (drive_.is_started()) notices_.emplace_back("The robot is stopped.");
      drive_.stop();
    }
    constexpr double kPatience_s = 2.0;
    const bool is_asked = asked_ == Asked::start && !drive_.is_started();
    if (!is_asked || !start_asked_at_s_) start_asked_at_s_ = now_s;
    if (is_asked && now_s - *start_asked_at_s_ > kPatience_s) {
      asked_ = Asked::nothing;
      notices_.emplace_back(
          "The robot is not started: its odometry, or pictures of its camera with their data and depth, do "
          "not come.");
    }
    if (asked_ == Asked::start && (drive_.is_started() || drive_.start(now_s))) {
      asked_ = Asked::nothing;
      notices_.push_back(
          fmt::format("The robot is started. The floor within {:.2f} m around it, which its camera does not "
                      "see, must be free.",
                      drive_.vouched_m()));
    }
  }

  void tell(DriveLimit limit, RobotClock::time_point now) {
    constexpr auto kLasting = std::chrono::milliseconds(500);
    if (limit != limit_) {
      limit_ = limit;
      limit_since_ = now;
      limit_is_said_ = false;
    }
    if (limit_is_said_ || now - limit_since_ < kLasting) return;
    limit_is_said_ = true;
    // What was lost for so long does not go on by itself.
    if (limit == DriveLimit::picture_lost || limit == DriveLimit::link_lost) drive_.stop();
    if (auto words = sentence_of(limit); !words.empty()) notices_.push_back(std::move(words));
  }

  void send(const RobotVelocity& velocity, RobotClock::time_point now) {
    // For a second after the end, since a zero that is sent once may be lost.
    constexpr auto kAfter = std::chrono::seconds(1);
    if (drive_.is_started()) started_at_ = now;
    if (!started_at_ || (now - *started_at_ > kAfter && published_ == RobotVelocity{})) return;
    has_commanded_ = true;
    if (!client_->publish(0, twist_text(velocity))) return;
    published_ = velocity;
    ++statistics_.commands;
    if (velocity != RobotVelocity{}) ++statistics_.moving_commands;
  }

  void watch_motion(RobotClock::time_point now) {
    const auto words = watch_.look(seconds_of(now), published_, measured_.forward_m_per_s, drive_.pose(),
                                   has_commanded_ && !was_lost_);
    if (!words) return;
    drive_.stop();
    notices_.emplace_back(*words);
  }

  std::unique_ptr<RosbridgeClient> client_;
  std::optional<double> metres_per_unit_;
  RobotHearing hearing_;
  std::atomic<bool> ending_{false};
  std::atomic<Asked> asked_{Asked::nothing};
  RobotHand hand_;
  /// Null: there is no near view.
  std::unique_ptr<RobotViews> views_;

  /// The feed's thread's own: of the last surface().
  std::optional<Pinhole> camera_seen_;

  // The thread's own.
  std::optional<Pinhole> camera_;
  bool has_commanded_ = false;
  bool has_failed_ = false;
  bool touches_ = false;
  bool said_battery_ = false;
  bool limit_is_said_ = false;
  DriveLimit limit_ = DriveLimit::none;
  RobotClock::time_point limit_since_;
  std::optional<RobotClock::time_point> started_at_, ticked_at_;
  std::optional<double> start_asked_at_s_;
  bool was_lost_ = false;
  std::uint64_t losses_ = 0;
  /// The command that was sent last.
  RobotVelocity published_;
  std::optional<double> odometry_stamp_s_;
  RobotVelocity measured_;
  MotionWatch watch_;

  /// Guards what follows.
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  RobotDrive drive_;
  RobotMode mode_ = RobotMode::drive;
  std::optional<LiveFrame> newest_;
  std::optional<Error> fault_;
  std::deque<std::string> notices_;
  RobotStatistics statistics_;
  haptics::LatencyRecorder picture_ages_;
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
