// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// A simulated robot on a real WebSocket, its live source, and a touch.
#include "palpable/cli/commands/touch/touch_robot.hpp"

#include "palpable/core/test_comes_true.hpp"
#include "palpable/describe/sound_words.hpp"
#include "palpable/session/touch/live_feed.hpp"
#include "palpable/session/touch/touch_session.hpp"

#include <chrono>
#include <cmath>
#include <functional>
#include <memory>
#include <mutex>
#include <numbers>
#include <optional>
#include <string>
#include <string_view>

#include <gtest/gtest.h>

namespace palpable::cli {
namespace {

constexpr Vec3 kLeft{-0.03, 0.0, 0.0};

/// A touch of the simulated robot by the page's pointer.
class RobotTouch : public testing::Test {
 protected:
  void open(const std::string& address) {
    auto started = start_sample_robot(address);
    ASSERT_TRUE(started) << started.error().sentence();
    robot_ = *std::move(started);
    auto source = session::open_live_source(robot_.address, {}, {});
    ASSERT_TRUE(source) << source.error().sentence();
    auto feed = session::LiveFeed::open(*std::move(source), {}, {});
    ASSERT_TRUE(feed) << feed.error().sentence();
    feed_ = *std::move(feed);
    auto session = session::TouchSession::open(feed_->first_scene(), {}, "pointer:", {});
    ASSERT_TRUE(session) << session.error().sentence();
    session_ = *std::move(session);
    feed_->start(*session_, [this](const std::string& words, session::LiveSubject) {
      const std::lock_guard lock(mutex_);
      said_ += words + "\n";
    });
  }
  void TearDown() override {
    if (feed_) feed_->stop();
  }
  /// The pointer is held there until the condition holds, for 20 s at most.
  bool held_at(Vec3 place_m, const std::function<bool()>& condition) {
    return comes_true([&] {
      session_->move_pointer(Point<SceneFrame>{place_m});
      return condition();
    });
  }
  std::string said() const {
    const std::lock_guard lock(mutex_);
    return said_;
  }
  bool says(std::string_view words) const { return said().find(words) != std::string::npos; }
  /// The robot is started, and asked for the near view, until its arm moves: on a machine that stands still
  /// now and then, the robot is stopped again.
  bool arm_moves() {
    return held_at({}, [&] {
      auto& robot = *feed_->robot();
      if (!robot.statistics().is_started) robot.request_start();
      robot.request_view(session::RobotView::near);
      return robot_.server->arm_m_per_s() != 0.0;
    });
  }
  bool moves() const {
    return robot_.server->commanded() != study::WheelMotion{} || robot_.server->arm_m_per_s() != 0.0;
  }
  /// Pictures come; starts it, again where a busy machine has stopped it, and holds the pointer in the middle
  /// and then there until it turns.
  bool turns_at(Vec3 place_m) {
    robot_.server->set_link({10.0, 0.0, 0.0, 0.0});
    return comes_true([&] {
      const auto state = feed_->robot()->state();
      // It moves only after the hand was in the middle.
      const bool may_move = state.is_started && state.limit != session::DriveLimit::off_centre;
      session_->move_pointer(Point<SceneFrame>{may_move ? place_m : Vec3{}});
      if (!state.is_started) feed_->robot()->request_start();
      return may_move && robot_.server->commanded().turn_rad_per_s * place_m.x < 0.0;
    });
  }
  /// Whether a robot that turns, or whose arm moves, is stopped by that, with these words. Tried again where
  /// a busy machine stopped it for another reason just before.
  bool is_stopped_by(const std::function<void()>& act, std::string_view words, bool by_arm = false) {
    const Vec3 place_m = by_arm ? Vec3{} : kLeft;
    for (int attempt = 0; attempt < 5; ++attempt) {
      if (!(by_arm ? arm_moves() : turns_at(kLeft))) return false;
      act();
      if (!held_at(place_m, [&] { return !feed_->robot()->statistics().is_started; })) return false;
      if (comes_true([&] { return says(words); }, std::chrono::seconds(1)))
        return held_at(place_m, [&] { return !moves(); });
    }
    return false;
  }

  SampleRobot robot_;
  std::unique_ptr<session::TouchSession> session_;
  std::unique_ptr<session::LiveFeed> feed_;
  mutable std::mutex mutex_;
  std::string said_;
};

TEST_F(RobotTouch, SendsNothingBeforeAPersonStartsAndStopsWhenTheyStop) {
  open("robot:sample?fps=10&mode=look&sound=0");
  const Vec3 right{0.03, 0.0, 0.0};
  EXPECT_TRUE(held_at(right, [&] { return session_->law_in_use() == haptics::Law::rolling; }));
  EXPECT_EQ(robot_.server->commands(), 0U);
  EXPECT_EQ(feed_->robot()->state().event, session::RobotEvent::none);
  EXPECT_TRUE(turns_at(right)) << said();
  EXPECT_TRUE(is_stopped_by([&] { feed_->robot()->request_stop(); }, "The robot is stopped.")) << said();
  const auto state = feed_->robot()->state();
  EXPECT_FALSE(state.is_started);
  EXPECT_EQ(state.event, session::RobotEvent::stopped);
  EXPECT_GE(state.events, 2U);
  EXPECT_EQ(state.view, session::RobotView::wide);
  // Stated once a second.
  EXPECT_TRUE(
      comes_true([&] { return std::abs(feed_->robot()->state().battery.value_or(0.0) - 0.8) < 1e-6; }));
  EXPECT_NE(feed_->robot()->floor(), nullptr);
  EXPECT_FALSE(robot_.server->has_touched());
}

TEST_F(RobotTouch, StandsWhenTheHandIsReleased) {
  open("robot:sample?fps=10&mode=look&sound=0");
  EXPECT_TRUE(turns_at(kLeft)) << said();
  // Nobody moves the pointer any more.
  EXPECT_TRUE(comes_true([&] { return !moves(); }));
  EXPECT_TRUE(turns_at(kLeft)) << said();
}

TEST_F(RobotTouch, StandsWhenPicturesDoNotCome) {
  open("robot:sample?fps=10&mode=look&sound=0");
  const auto end_pictures = [&] { robot_.server->set_link({10.0, 0.0, 0.0, 1.0}); };
  EXPECT_TRUE(is_stopped_by(end_pictures, "no picture of its camera")) << said();
  EXPECT_TRUE(turns_at(kLeft)) << said();
}

// Its own driver stops a robot whose link is gone.
TEST_F(RobotTouch, StandsAfterALostLink) {
  open("robot:sample?fps=10&mode=look&sound=0");
  EXPECT_TRUE(is_stopped_by([&] { robot_.server->hang_up(); }, "its connection was lost")) << said();
}

TEST_F(RobotTouch, HearsWhereSomebodySpeaksAndMarksIt) {
  open("robot:sample?fps=20&mode=touch");
  // As the robot stands: x and y of the room's floor.
  const auto pose = robot_.server->pose();
  const auto source = robot_.server->sound_source().v;
  const double azimuth_rad = pose.heading_rad - std::atan2(source.y - pose.y_m, source.x - pose.x_m);
  const auto expected =
      "A sound " + describe::sound_words(azimuth_rad * 180.0 / std::numbers::pi, std::nullopt);
  EXPECT_TRUE(held_at({}, [&] { return says(expected); })) << azimuth_rad * 180.0 / std::numbers::pi << "\n"
                                                           << said();
  EXPECT_GE(feed_->robot()->statistics().sounds, 1U);
  const auto& materials = session_->scene()->materials;
  EXPECT_EQ(materials.back().name, "a sound comes from here");
}

TEST_F(RobotTouch, CanLeaveTheMarkAndTheSoundOut) {
  open("robot:sample?fps=20&mode=touch&sound-marker=0&sound=0");
  for (const auto& material : session_->scene()->materials)
    EXPECT_NE(material.name, "a sound comes from here");
  EXPECT_EQ(feed_->robot()->statistics().sounds, 0U);
}

TEST_F(RobotTouch, SweepsItsArmForTheNearViewAfterAStartOnly) {
  open("robot:sample?fps=20&mode=touch&sound=0");
  EXPECT_TRUE(session::obey("near", *feed_->robot()));
  EXPECT_TRUE(held_at({}, [&] { return says("start the robot first"); })) << said();
  EXPECT_EQ(robot_.server->arm_commands(), 0U);
  ASSERT_TRUE(arm_moves()) << said();
  // Nobody moves the pointer any more.
  EXPECT_TRUE(comes_true([&] { return robot_.server->arm_m_per_s() == 0.0; }));
  EXPECT_TRUE(is_stopped_by([&] { robot_.server->hang_up(); }, "its connection was lost", true)) << said();
  // 3 cm, and what its own driver lets it go on for after a lost connection.
  EXPECT_LT(std::abs(robot_.server->arm_m()), 0.055);
  EXPECT_FALSE(robot_.server->has_touched());
}

TEST_F(RobotTouch, IsTouchedWithTheLawOfPicturesInTheModeTouch) {
  open("robot:sample?fps=20");
  EXPECT_TRUE(held_at({}, [&] { return session_->law_in_use() == haptics::Law::rolling; }));
  EXPECT_TRUE(session::obey("touch", *feed_->robot()));
  EXPECT_TRUE(held_at({}, [&] { return session_->law_in_use() == haptics::Law::proxy; }));
  EXPECT_FALSE(session::obey("jump", *feed_->robot()));
  EXPECT_EQ(robot_.server->commands(), 0U);
}

/// The depth of its two cameras beside the truth of the room.
TEST(SampleRobot, SeesDepthWithAStereoPair) {
  const auto robot = start_sample_robot("robot:sample?eyes=stereo&fps=5&seed=3&sound=0");
  ASSERT_TRUE(robot) << robot.error().sentence();
  const auto source = session::open_live_source(robot->address, {}, {});
  ASSERT_TRUE(source) << source.error().sentence();
  std::optional<session::LiveFrame> frame;
  EXPECT_TRUE(comes_true([&] {
    auto taken = (*source)->take(std::chrono::steady_clock::now() + std::chrono::seconds(1));
    if (taken && *taken) frame = **std::move(taken);
    return frame && frame->world_from_camera;
  }));
  ASSERT_TRUE(frame && frame->depth.camera);
  const study::RobotBody body;
  study::RobotWorld world(study::make_room(3), body, {}, 3);
  world.place(robot->server->pose());
  const auto truth_m = world.view(*frame->depth.camera, {}).depth_m;
  int known = 0, right = 0;
  for (std::size_t k = 0; k < truth_m.count(); ++k) {
    const double z = frame->depth.depth_m.values()[k], truth = truth_m.values()[k];
    if (!std::isfinite(z) || truth > 2.5) continue;
    ++known;
    // A pixel of disparity.
    right += std::abs(z - truth) < truth * truth / (frame->depth.camera->fx * body.baseline_m) ? 1 : 0;
  }
  EXPECT_GT(known, 0.3 * static_cast<double>(truth_m.count()));
  EXPECT_GT(right, 0.9 * known);
  // By its odometry, which begins at 0.
  EXPECT_NEAR(frame->world_from_camera->translation_m.z, body.camera_height_m, 1e-9);
  EXPECT_NEAR(frame->world_from_camera->translation_m.x, body.camera_forward_m, 1e-6);
}

TEST_F(RobotTouch, DrivesByAStereoPair) {
  open("robot:sample?eyes=stereo&fps=5&mode=look&sound=0");
  EXPECT_TRUE(turns_at(kLeft)) << said();
  EXPECT_FALSE(robot_.server->has_touched());
}

TEST(SampleRobot, RefusesOptionsOutOfRange) {
  for (const auto* wrong :
       {"robot:sample?loss=2", "robot:sample?eyes=three", "robot:sample?fps=0", "robot:sample?port=1"})
    EXPECT_EQ(start_sample_robot(wrong).error().code, ErrorCode::usage) << wrong;
  EXPECT_FALSE(is_sample_robot("robot:sampler:9090"));
}

}  // namespace
}  // namespace palpable::cli
