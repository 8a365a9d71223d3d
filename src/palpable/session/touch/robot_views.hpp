// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/session/robot/view_shift.hpp"
#include "palpable/session/robot/wrist_sweep.hpp"
#include "palpable/session/touch/live_address.hpp"
#include "palpable/session/touch/live_source.hpp"
#include "palpable/session/touch/notices.hpp"
#include "palpable/session/touch/robot_wheels.hpp"
#include "palpable/sources/live/rosbridge_client.hpp"

#include <array>
#include <atomic>
#include <cstddef>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

namespace palpable::session {

/// The two views of a robot that are touched in the mode touch, and the zoom between them (Park & Howard
/// 2012, section 4: "multi-scale"): the wide one of its first camera, which is live, and the near one of its
/// wrist camera, which was swept sideways and stands still. The hand keeps its place in the robot's
/// surroundings, and the surface its height under the hand; the shift that this takes goes back slowly while
/// the hand touches nothing (view_shift.hpp). request(), statistics and surface() from any thread.
class RobotViews {
 public:
  /// Places of the wrist camera's topics in the client's list, and of the arm in its publications. `client`
  /// must outlive this.
  struct Places {
    std::size_t picture = 0, info = 0, pose = 0, arm = 0;
  };
  RobotViews(sources::RosbridgeClient& client, const Places& places, const SweepOptions& sweep,
             const RobotShape& shape);
  ~RobotViews();
  RobotViews(const RobotViews&) = delete;
  RobotViews& operator=(const RobotViews&) = delete;

  void request(RobotView view);
  /// At least ten times a second, by one thread: takes what came, and commands the arm.
  void tick(const RobotNow& now);
  /// Tells the arm to stand, if it was ever told to move.
  bool stop_arm();
  /// As LiveSource::surface(), of the view that is touched; begins a zoom that is due.
  std::shared_ptr<const models::Relief> surface(const SeenView& seen, TouchSession& session);
  /// The near view's colours while that is touched.
  std::optional<Image> colour() const;
  /// What is touched, or will be once the arm was swept.
  RobotView view() const;
  /// The wide view is shown, at its own place.
  bool is_plain() const;
  std::optional<std::string> notice() { return notices_.take(); }

  // Counts of commands to the arm, and of near views.
  std::uint64_t arm_commands() const { return arm_commands_; }
  std::uint64_t near_views() const { return near_views_; }

 private:
  enum class Asked : std::uint8_t { nothing, near, wide };

  void follow_wish(const RobotNow& now);
  void begin_sweep(const RobotNow& now);
  void end_sweep();
  void go_wide();
  void leave(const RobotNow& now);
  void take_wrist(double t_s);
  void command_arm(const RobotNow& now);
  void compute(std::vector<WristPicture> pictures);
  void take_computed();
  void zoom(const TouchedView& wide, TouchSession& session);
  TouchedView near_view() const;

  sources::RosbridgeClient& client_;
  Places places_;
  double half_m_, speed_m_per_s_;
  Transform<WorldFrame, CameraFrame> base_from_wide_;
  std::atomic<std::uint64_t> arm_commands_{0}, near_views_{0};
  std::atomic<bool> cancelled_{false};
  Notices notices_;

  /// Guards what follows.
  mutable std::mutex mutex_;
  Asked asked_ = Asked::nothing;
  WristSweep sweep_;
  std::optional<Pinhole> wrist_;
  /// To the wrist camera's pictures.
  bool is_subscribed_ = false;
  /// Where the robot stood when the arm began.
  RobotPose stood_;
  /// The command that was sent last.
  double published_m_per_s_ = 0.0;
  /// What the computing thread leaves.
  std::optional<Result<NearView>> computed_;
  bool is_computing_ = false;
  std::optional<NearView> near_;
  std::shared_ptr<const models::Relief> near_relief_;
  /// The near relief with the shift.
  std::shared_ptr<const models::Relief> placed_;
  RobotView wanted_ = RobotView::wide, shown_ = RobotView::wide;
  ViewShift shift_;
  std::optional<std::chrono::steady_clock::time_point> surfaced_at_;
  std::thread computing_;
};

}  // namespace palpable::session
