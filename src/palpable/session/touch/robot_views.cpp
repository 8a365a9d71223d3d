// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/session/touch/robot_views.hpp"

#include "palpable/core/picture/camera_pose.hpp"
#include "palpable/session/robot/robot_messages.hpp"
#include "palpable/session/touch/touch_session.hpp"
#include "palpable/sources/live/rosbridge_picture.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <utility>
#include <variant>
#include <vector>

#include <fmt/format.h>

namespace palpable::session {
namespace {

using ViewClock = std::chrono::steady_clock;

bool has_moved(const RobotPose& from, const RobotPose& to) {
  constexpr double kMoved_m = 0.01, kMoved_rad = 0.01;
  return std::hypot(to.x_m - from.x_m, to.y_m - from.y_m) > kMoved_m ||
         std::abs(std::remainder(to.heading_rad - from.heading_rad, 2.0 * M_PI)) > kMoved_rad;
}

/// The median of what is known; a map of which nothing is known has none.
double middle_depth_m(const Raster<float>& depth_m) {
  std::vector<float> known;
  std::copy_if(depth_m.values().begin(), depth_m.values().end(), std::back_inserter(known),
               [](float z) { return std::isfinite(z); });
  if (known.empty()) return 0.0;
  const auto middle = known.begin() + static_cast<std::ptrdiff_t>(known.size() / 2);
  std::nth_element(known.begin(), middle, known.end());
  return *middle;
}

}  // namespace

RobotViews::RobotViews(sources::RosbridgeClient& client, const Places& places, const SweepOptions& sweep,
                       const RobotShape& shape)
    : client_(client),
      places_(places),
      half_m_(sweep.half_m),
      speed_m_per_s_(sweep.speed_m_per_s),
      base_from_wide_(
          camera_pose({{shape.camera_forward_m, 0.0, shape.camera_height_m}}, 0.0, shape.camera_down_rad)),
      sweep_(sweep) {}

RobotViews::~RobotViews() {
  cancelled_ = true;
  if (computing_.joinable()) computing_.join();
}

void RobotViews::request(RobotView view) {
  const std::lock_guard lock(mutex_);
  asked_ = view == RobotView::near ? Asked::near : Asked::wide;
}

bool RobotViews::is_plain() const {
  const std::lock_guard lock(mutex_);
  return shown_ == RobotView::wide && shift_ == ViewShift{};
}

RobotView RobotViews::view() const {
  const std::lock_guard lock(mutex_);
  return sweep_.is_active() || is_computing_ ? RobotView::near : wanted_;
}

std::optional<Image> RobotViews::colour() const {
  const std::lock_guard lock(mutex_);
  if (shown_ != RobotView::near) return std::nullopt;
  return near_->colour;
}

void RobotViews::tick(const RobotNow& now) {
  const std::lock_guard lock(mutex_);
  leave(now);
  follow_wish(now);
  take_wrist(now.t_s);
  command_arm(now);
  if (auto failure = sweep_.take_failure()) {
    end_sweep();
    notices_.put(*std::move(failure));
  }
  if (auto pictures = sweep_.take_pictures()) compute(*std::move(pictures));
  take_computed();
}

/// Ends what does not hold any more: the near view is of the place where the robot stood.
void RobotViews::leave(const RobotNow& now) {
  const bool is_busy = sweep_.is_active() || is_computing_;
  if (now.mode != RobotMode::touch) {
    go_wide();
    // What is touched then is neither view.
    shown_ = RobotView::wide;
    shift_ = {};
    return;
  }
  if (sweep_.is_active() && !now.is_started) {
    go_wide();
    notices_.put("The near view is given up: the robot is not started any more.");
  } else if ((is_busy || wanted_ == RobotView::near) && has_moved(stood_, now.pose)) {
    go_wide();
    notices_.put("The near view is left: the robot does not stand where it was.");
  }
}

void RobotViews::go_wide() {
  end_sweep();
  cancelled_ = true;
  wanted_ = RobotView::wide;
}

void RobotViews::end_sweep() {
  sweep_.cancel();
  if (std::exchange(is_subscribed_, false)) client_.unsubscribe_from(places_.picture);
}

void RobotViews::follow_wish(const RobotNow& now) {
  const Asked asked = std::exchange(asked_, Asked::nothing);
  if (asked == Asked::wide) {
    if (sweep_.is_active() || is_computing_) notices_.put("The near view is given up.");
    go_wide();
  }
  if (asked == Asked::near) begin_sweep(now);
}

void RobotViews::begin_sweep(const RobotNow& now) {
  if (sweep_.is_active() || is_computing_) return;
  if (now.mode != RobotMode::touch || !now.is_started) {
    notices_.put("For the near view the robot's arm moves: start the robot first, in the mode touch.");
    return;
  }
  if (!sweep_.begin(now.t_s)) {
    notices_.put("There is no near view: the arm does not say where its camera is.");
    return;
  }
  // Another one begins from the wide view again, which what is under the hand is taken from.
  wanted_ = RobotView::wide;
  stood_ = now.pose;
  client_.subscribe_to(places_.picture);
  is_subscribed_ = true;
  notices_.put(
      fmt::format("The arm moves its camera by {:.0f} cm to the right and to the left, at {:.0f} cm a "
                  "second: it must have "
                  "room there.",
                  100.0 * half_m_, 100.0 * speed_m_per_s_));
}

void RobotViews::take_wrist(double t_s) {
  if (const auto newest = client_.take(places_.pose))
    if (const auto* at = std::get_if<sources::RosPose>(&newest->message.body))
      sweep_.take_pose(t_s, {at->rotation, at->position_m}, newest->message.stamp_s);
  if (const auto newest = client_.take(places_.info))
    if (const auto* camera = std::get_if<sources::RosCamera>(&newest->message.body)) wrist_ = camera->camera;
  if (!sweep_.is_active()) return;
  const auto newest = client_.take(places_.picture);
  if (!newest) return;
  if (auto picture = sources::colour_of(newest->message.body))
    sweep_.take_picture(t_s, *std::move(picture), newest->message.stamp_s);
}

void RobotViews::command_arm(const RobotNow& now) {
  const double left_m_per_s = sweep_.command(now.t_s, now.may_move);
  // Also after the end, since a zero that is sent once may be lost, until one was sent.
  if (!sweep_.is_active() && !sweep_.is_watched(now.t_s) && published_m_per_s_ == 0.0) return;
  if (!client_.publish(places_.arm, arm_twist_text(left_m_per_s))) return;
  published_m_per_s_ = left_m_per_s;
  ++arm_commands_;
}

bool RobotViews::stop_arm() {
  const std::lock_guard lock(mutex_);
  return arm_commands_ == 0 || client_.publish(places_.arm, arm_twist_text(0.0));
}

void RobotViews::compute(std::vector<WristPicture> pictures) {
  notices_.put("The pictures are taken: the arm goes back, and their depth is computed.");
  if (std::exchange(is_subscribed_, false)) client_.unsubscribe_from(places_.picture);
  if (!wrist_) {
    notices_.put("There is no near view: the wrist camera does not state its data (camera_info).");
    return;
  }
  if (computing_.joinable()) computing_.join();
  cancelled_ = false;
  is_computing_ = true;
  computing_ = std::thread([this, taken = std::move(pictures), camera = *wrist_] {
    Work work;
    // The rest of the touch goes on beside it.
    work.threads = 1;
    work.cancel = &cancelled_;
    auto made = near_depth(taken, camera, {}, work);
    const std::lock_guard lock(mutex_);
    computed_ = std::move(made);
  });
}

void RobotViews::take_computed() {
  if (!computed_ || shown_ != RobotView::wide) return;
  const auto made = *std::exchange(computed_, std::nullopt);
  is_computing_ = false;
  if (cancelled_) return;
  if (!made) {
    notices_.put(fmt::format("There is no near view: {}.", made.error().message));
    return;
  }
  if (!vision::range_of_depths(made->depth.depth_m)) {
    notices_.put("There is no near view: the wrist camera's pictures show no depth.");
    return;
  }
  // The zoom begins with the next picture.
  near_ = *made;
  near_relief_.reset();
  wanted_ = RobotView::near;
}

TouchedView RobotViews::near_view() const {
  return {*near_relief_, near_->depth.depth_m, near_->depth.camera, near_->base_from_camera};
}

std::shared_ptr<const models::Relief> RobotViews::surface(const SeenView& seen, TouchSession& session) {
  const std::lock_guard lock(mutex_);
  const auto now = ViewClock::now();
  const double dt_s = surfaced_at_ ? std::chrono::duration<double>(now - *surfaced_at_).count() : 0.0;
  surfaced_at_ = now;
  if (near_ && !near_relief_) {
    auto made = sculpt::relief_in_window(near_->depth.depth_m, *vision::range_of_depths(near_->depth.depth_m),
                                         seen.shape);
    if (!made) return nullptr;
    near_relief_ = std::make_shared<const models::Relief>(*std::move(made));
  }
  const ViewShift before = shift_;
  if (wanted_ != shown_) {
    zoom({seen.relief, seen.depth_m, seen.camera, base_from_wide_}, session);
    placed_.reset();
  } else if (!session.latest().has(haptics::flag::kContact)) {
    constexpr double kLongest_s = 0.1;
    shift_ = relaxed(shift_, std::min(dt_s, kLongest_s));
    if (shift_ != before) placed_.reset();
  }
  if (shown_ == RobotView::wide) {
    if (shift_ == ViewShift{}) return nullptr;
    auto moved = shifted(seen.relief, shift_);
    return moved ? *std::move(moved) : nullptr;
  }
  if (!placed_)
    if (auto moved = shifted(*near_relief_, shift_)) placed_ = *std::move(moved);
  return placed_;
}

void RobotViews::zoom(const TouchedView& wide, TouchSession& session) {
  const auto sample = session.latest();
  const TouchedView near = near_view();
  const bool goes_near = wanted_ == RobotView::near;
  shown_ = wanted_;
  ZoomedShift zoomed;
  if (sample.status == device::Status::ok)
    zoomed = zoomed_shift(goes_near ? wide : near, shift_, goes_near ? near : wide, sample.position.v,
                          session.radius_in_use_m());
  shift_ = zoomed.shift;
  if (!goes_near) {
    notices_.put(zoomed.point ? "The wide view." : "The wide view; what was under the hand is not in it.");
    return;
  }
  ++near_views_;
  if (!zoomed.point) {
    const double z_m = middle_depth_m(near.depth_m);
    notices_.put(fmt::format(
        "The near view: most of it is {:.2f} m from the wrist camera, and it is {:.0f} cm wide there. What "
        "was under the hand is not in it.",
        z_m, 100.0 * z_m * near.camera->width / near.camera->fx));
    return;
  }
  const double z_m = (near.base_from_camera.inverse() * *zoomed.point).v.z;
  notices_.put(fmt::format(
      "The near view: under the hand it is {:.2f} m from the wrist camera, and {:.0f} cm wide there.", z_m,
      100.0 * z_m * near.camera->width / near.camera->fx));
}

}  // namespace palpable::session
