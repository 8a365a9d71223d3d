// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/study/world/robot_server.hpp"

#include "palpable/core/net/web_socket.hpp"
#include "palpable/core/test_comes_true.hpp"
#include "palpable/study/world/robot_world.hpp"

#include <chrono>
#include <cmath>
#include <map>
#include <string>

#include <gtest/gtest.h>

namespace palpable::study {
namespace {

TEST(RobotWorld, FollowsItsCommandAndOdometryFollowsIt) {
  RobotWorld world(make_room(1), {}, {0.0, 0.0}, 1);
  world.command({0.1, 0.0});
  for (int k = 0; k < 10; ++k) {
    world.command({0.1, 0.0});
    world.advance(0.1);
  }
  EXPECT_NEAR(world.odometry().x_m, 0.1 - 0.1 * 0.1 / (2.0 * world.body().forward_m_per_s2), 2e-3);
  EXPECT_FALSE(world.has_touched());
  const auto before = world.pose();
  world.command({NAN, 0.0});
  world.advance(2.0);
  EXPECT_EQ(world.commanded(), WheelMotion{});
  EXPECT_EQ(world.motion(), WheelMotion{});
  // The command held on for a quarter of a second, and the wheels braked.
  EXPECT_LT(std::hypot(world.pose().x_m - before.x_m, world.pose().y_m - before.y_m), 0.04);
}

TEST(RobotWorld, StopsAtWhatItTouches) {
  RobotWorld world(make_room(1), {}, {}, 1);
  for (int k = 0; k < 200; ++k) {
    world.command({0.5, 0.0});
    world.advance(0.1);
  }
  EXPECT_TRUE(world.has_touched());
  EXPECT_FALSE(touches(world.room(), {world.pose().x_m, world.pose().y_m, 0.2, 0.75}));
}

TEST(RobotServer, SendsWhatIsSubscribedToAndTakesCommands) {
  const auto server = RobotServer::start({});
  ASSERT_TRUE(server);
  const auto socket =
      WebSocket::connect("127.0.0.1", std::to_string((*server)->port()), std::chrono::seconds(5), {});
  ASSERT_TRUE(socket) << socket.error().sentence();
  (*socket)->send(R"({"op":"subscribe","topic":"/camera/depth/image_rect_raw"})");
  (*socket)->send(R"({"op":"subscribe","topic":"/odom"})");
  (*socket)->send("rubbish");
  (*socket)->send(R"({"op":"publish","topic":"/cmd_vel","msg":{"linear":{"x":0.1},"angular":{"z":0.5}}})");
  std::map<std::string, int> heard;
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(20);
  while (std::chrono::steady_clock::now() < end && (heard["16UC1"] < 2 || heard["/odom"] < 2)) {
    const auto text = (*socket)->receive(end);
    ASSERT_TRUE(text);
    if (!*text) continue;
    for (const auto* part : {"16UC1", "/odom", "rgb8"})
      heard[part] += (*text)->find(part) != std::string::npos ? 1 : 0;
  }
  EXPECT_GE(heard["16UC1"], 2);
  EXPECT_GE(heard["/odom"], 2);
  EXPECT_EQ(heard["rgb8"], 0);
  // Pictures may overtake the command on a busy machine.
  EXPECT_TRUE(comes_true([&] { return (*server)->commands() == 1U; }));
}

}  // namespace
}  // namespace palpable::study
