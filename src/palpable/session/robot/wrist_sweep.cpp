// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/session/robot/wrist_sweep.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace palpable::session {
namespace {

/// Within this of a place it is there: where exactly is measured.
constexpr double kReached_m = 0.002;
/// For this time it stands before a picture counts.
constexpr double kStanding_s = 0.25;
constexpr double kStill_m = 0.0008;
constexpr const char* kMovesUnasked =
    "The arm moves, though it is told to stand: use the robot's own emergency stop.";

}  // namespace

Result<void> check(const SweepOptions& options) {
  const auto usage = [](const char* message) { return Error{ErrorCode::usage, message, {}}; };
  if (!(options.half_m >= 0.005 && options.half_m <= 0.1))
    return usage("a wrist camera is moved by 0.005 to 0.1 m to either side");
  if (!(options.speed_m_per_s >= 0.005 && options.speed_m_per_s <= 0.1))
    return usage("a wrist camera is moved at 0.005 to 0.1 m/s");
  if (options.places < 3 || options.places > 9 || options.places % 2 == 0)
    return usage("a wrist camera stands at 3, 5, 7 or 9 places");
  return {};
}

void WristSweep::take_pose(double t_s, const Pose& pose, std::optional<double> stamp_s) {
  poses_.push_back({t_s, pose, stamp_s});
  while (poses_.size() > 2 && t_s - poses_[1].t_s >= kStanding_s) poses_.pop_front();
  if (stage_ != Stage::standing || !stands()) {
    still_since_.reset();
  } else if (!still_since_) {
    still_since_ = poses_.front();
  }
}

double WristSweep::left_m() const { return (poses_.back().pose.translation_m - home_->translation_m).y; }

/// From the right to the left; then home.
double WristSweep::target_m() const {
  if (stage_ == Stage::returning) return 0.0;
  return options_.half_m * (2.0 * place_ / (options_.places - 1) - 1.0);
}

bool WristSweep::begin(double t_s) {
  if (poses_.empty() || t_s - poses_.back().t_s > options_.lost_s) return false;
  const Pose& now = poses_.back().pose;
  // Who moved it elsewhere since it was watched has another place in mind; not so an arm whose own driver
  // stopped it after its connection was lost.
  constexpr double kOwnStop_s = 1.0;
  if (left_at_ && !is_watched(t_s) &&
      norm(now.translation_m - left_at_->translation_m) >
          options_.speed_m_per_s * kOwnStop_s + options_.margin_m)
    home_.reset();
  if (!home_) home_ = now;
  farthest_m_ = std::max(options_.half_m, std::abs(left_m())) + options_.margin_m;
  stage_ = Stage::moving;
  place_ = 0;
  taken_.clear();
  done_.reset();
  failure_.reset();
  command_m_per_s_ = 0.0;
  commanded_at_s_ = allowed_at_s_ = obeyed_at_s_ = t_s;
  told_at_s_ = t_s;
  obeyed_at_m_ = stood_at_m_ = left_m();
  said_unasked_ = false;
  return true;
}

/// Whether the poses of the last quarter of a second are of one place.
bool WristSweep::stands() const {
  if (poses_.size() < 2 || poses_.back().t_s - poses_.front().t_s < kStanding_s) return false;
  return std::all_of(poses_.begin(), poses_.end(), [&](const Measured& measured) {
    return norm(measured.pose.translation_m - poses_.back().pose.translation_m) < kStill_m;
  });
}

/// The mean of the poses while it stands, since an arm's own measurement trembles.
WristSweep::Pose WristSweep::standing_pose() const {
  Pose mean = poses_.back().pose;
  Vec3 sum;
  for (const Measured& measured : poses_) sum += measured.pose.translation_m;
  mean.translation_m = (1.0 / static_cast<double>(poses_.size())) * sum;
  return mean;
}

void WristSweep::take_picture(double t_s, Image picture, std::optional<double> stamp_s) {
  if (stage_ != Stage::standing || !still_since_) return;
  // Without stamps a picture may be that old.
  constexpr double kOldest_s = 0.5;
  const bool is_of_now = stamp_s && still_since_->stamp_s ? *stamp_s >= *still_since_->stamp_s
                                                          : t_s >= still_since_->t_s + kOldest_s;
  if (!is_of_now) return;
  taken_.push_back({std::move(picture), standing_pose()});
  stage_ = ++place_ < options_.places ? Stage::moving : Stage::returning;
  obeyed_at_s_ = t_s;
  obeyed_at_m_ = left_m();
  if (stage_ == Stage::returning) done_ = std::exchange(taken_, {});
}

std::optional<std::vector<WristPicture>> WristSweep::take_pictures() {
  return std::exchange(done_, std::nullopt);
}
std::optional<std::string> WristSweep::take_failure() { return std::exchange(failure_, std::nullopt); }

void WristSweep::give_up(std::string sentence) {
  stage_ = Stage::idle;
  taken_.clear();
  failure_ = std::move(sentence);
}

std::optional<std::string> WristSweep::fault(double t_s) {
  constexpr double kLost_s = 2.0, kWaiting_s = 10.0, kBlocked_s = 2.0, kMoved_m = 0.001, kTurned = 0.035,
                   kStandingAtMost_s = 10.0;
  if (t_s - poses_.back().t_s > kLost_s) return "The arm is stopped: it does not say where it is.";
  const Pose& pose = poses_.back().pose;
  const Vec3 off = pose.translation_m - home_->translation_m;
  double turned = 0.0;
  for (std::size_t k = 0; k < pose.rotation.size(); ++k)
    turned = std::max(turned, std::abs(pose.rotation[k] - home_->rotation[k]));
  if (std::abs(off.y) > farthest_m_ || std::hypot(off.x, off.z) > options_.margin_m || turned > kTurned)
    return "The arm is stopped: it left the way on which it shall move sideways.";
  if (t_s - allowed_at_s_ > kWaiting_s)
    return "The near view is given up: the hand, the robot or its pictures were away for ten seconds.";
  const double way_m = std::abs(left_m() - obeyed_at_m_);
  if (command_m_per_s_ != 0.0) {
    if (way_m > kMoved_m) obeyed_at_s_ = t_s, obeyed_at_m_ = left_m();
    if (t_s - obeyed_at_s_ > kBlocked_s)
      return "The arm is stopped: it was told to move, and it stands. It may be blocked.";
  }
  if (moves_unasked(t_s)) return kMovesUnasked;
  if (stage_ == Stage::standing && t_s - standing_since_s_ > kStandingAtMost_s)
    return "The near view is given up: no picture of the wrist camera came.";
  return std::nullopt;
}

/// Whether it goes on for more than 1.5 s after it was told to stand: commands and poses may be late.
bool WristSweep::moves_unasked(double t_s) {
  constexpr double kBraking_s = 1.5, kMoved_m = 0.01;
  const double left_m = (standing_pose().translation_m - home_->translation_m).y;
  if (command_m_per_s_ != 0.0) told_at_s_ = t_s;
  if (t_s - told_at_s_ <= kBraking_s) stood_at_m_ = left_m;
  return std::abs(left_m - stood_at_m_) > kMoved_m && !std::exchange(said_unasked_, true);
}

double WristSweep::command(double t_s, bool may_move) {
  constexpr double kWatched_s = 10.0;
  const double dt_s = std::clamp(t_s - commanded_at_s_, 0.0, options_.lost_s);
  commanded_at_s_ = t_s;
  if (stage_ != Stage::idle) watched_until_s_ = t_s + kWatched_s;
  if (is_watched(t_s)) left_at_ = poses_.back().pose;
  if (stage_ == Stage::idle) {
    if (is_watched(t_s) && moves_unasked(t_s)) failure_ = kMovesUnasked;
    return command_m_per_s_ = 0.0;
  }
  if (may_move) allowed_at_s_ = t_s;
  if (auto sentence = fault(t_s)) {
    give_up(*std::move(sentence));
    return command_m_per_s_ = 0.0;
  }
  double wanted = 0.0;
  if (may_move && t_s - poses_.back().t_s <= options_.lost_s) wanted = towards_target(t_s);
  const double most =
      std::max(0.0, command_m_per_s_ * std::copysign(1.0, wanted)) + options_.growth_m_per_s2 * dt_s;
  const double before =
      std::exchange(command_m_per_s_, std::copysign(std::min(std::abs(wanted), most), wanted));
  // What moved before it was told to stand, and stood before it was told to move, is no fault.
  if ((before == 0.0) != (command_m_per_s_ == 0.0)) obeyed_at_s_ = t_s, obeyed_at_m_ = left_m();
  return command_m_per_s_;
}

/// The speed to the place that is next; 0 there.
double WristSweep::towards_target(double t_s) {
  constexpr double kGain_per_s = 2.0, kSlowest_m_per_s = 0.005;
  const double away_m = target_m() - left_m();
  if (stage_ == Stage::standing) return 0.0;
  if (std::abs(away_m) > kReached_m)
    return std::copysign(std::clamp(kGain_per_s * std::abs(away_m), kSlowest_m_per_s, options_.speed_m_per_s),
                         away_m);
  stage_ = stage_ == Stage::returning ? Stage::idle : Stage::standing;
  standing_since_s_ = t_s;
  still_since_.reset();
  return 0.0;
}

}  // namespace palpable::session
