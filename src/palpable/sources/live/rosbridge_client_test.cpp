// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sources/live/rosbridge_client.hpp"

#include "palpable/sources/live/test_ros_messages.hpp"
#include "palpable/sources/live/test_rosbridge_server.hpp"

#include <gtest/gtest.h>

namespace palpable::sources {
namespace {

using std::chrono::milliseconds;
auto in_ten_seconds() { return RosbridgeClient::Clock::now() + std::chrono::seconds(10); }

RosbridgeOptions options_for(const TestRosbridgeServer& server) {
  RosbridgeOptions options;
  options.host = "127.0.0.1";
  options.port = std::to_string(server.port());
  options.topics = {"/battery", "/depth"};
  options.publications = {{"/cmd_vel", "geometry_msgs", "Twist"}};
  options.retry = milliseconds(10);
  return options;
}

std::string battery(const char* charge, const char* seconds) {
  return ros_published(
      "/battery", fmt::format(R"({{"header":{{"stamp":{{"{}":1}}}},"percentage":{}}})", seconds, charge));
}

/// A sentence of `next`, within ten seconds.
template <class Next>
std::string sentence_of(Next next) {
  for (const auto end = in_ten_seconds(); RosbridgeClient::Clock::now() < end;
       std::this_thread::sleep_for(milliseconds(2)))
    if (auto words = next()) return *words;
  return {};
}

TEST(RosbridgeClient, SubscribesAndKeepsTheNewestOfEachTopic) {
  TestRosbridgeServer server;
  const auto client = RosbridgeClient::open(options_for(server));
  ASSERT_TRUE(client);
  EXPECT_TRUE(server.has_heard(R"("op":"subscribe","queue_length":1,"topic":"/depth")") ||
              server.has_heard(R"("topic":"/depth")"));
  server.send(battery("0.25", "secs"));
  const auto newest = (*client)->wait(0, in_ten_seconds());
  ASSERT_TRUE(newest && *newest);
  EXPECT_EQ(std::get<RosBattery>((*newest)->message.body).charge, 0.25);
  EXPECT_FALSE((*client)->take(0));
  EXPECT_FALSE((*client)->take(1));
}

TEST(RosbridgeClient, AsksForATopicOnDemandAlone) {
  TestRosbridgeServer server;
  auto options = options_for(server);
  options.on_demand = {1};
  const auto client = RosbridgeClient::open(std::move(options));
  ASSERT_TRUE(client);
  (*client)->subscribe_to(0);
  EXPECT_TRUE(server.has_heard(R"("topic":"/battery")"));
  EXPECT_FALSE(server.has_heard_by_now(R"("topic":"/depth")"));
  (*client)->subscribe_to(1);
  EXPECT_TRUE(server.has_heard(R"("topic":"/depth")"));
  (*client)->unsubscribe_from(1);
  EXPECT_TRUE(server.has_heard(R"("op":"unsubscribe","topic":"/depth")"));
}

TEST(RosbridgeClient, PublishesWithTheTypeNameOfTheServersVersion) {
  for (const bool is_ros2 : {false, true}) {
    TestRosbridgeServer server;
    const auto client = RosbridgeClient::open(options_for(server));
    ASSERT_TRUE(client);
    server.send(battery("0.25", is_ros2 ? "sec" : "secs"));
    ASSERT_TRUE((*client)->wait(0, in_ten_seconds()));
    EXPECT_TRUE((*client)->publish(0, R"({"linear":{"x":0.5}})"));
    EXPECT_TRUE(server.has_heard(is_ros2 ? R"("geometry_msgs/msg/Twist")" : R"("geometry_msgs/Twist")"));
    EXPECT_TRUE(server.has_heard(R"({"op":"publish","topic":"/cmd_vel","msg":{"linear":{"x":0.5}}})"));
  }
}

TEST(RosbridgeClient, SaysALossOnceAndComesBack) {
  TestRosbridgeServer server;
  const auto client = RosbridgeClient::open(options_for(server));
  ASSERT_TRUE(client);
  server.send(battery("0.25", "secs"));
  ASSERT_TRUE((*client)->wait(0, in_ten_seconds()));
  server.hang_up();
  const auto loss = sentence_of([&] { return (*client)->loss(); });
  EXPECT_NE(loss.find("was lost: it closed the connection"), std::string::npos) << loss;
  server.send(battery("0.5", "secs"));
  const auto again = (*client)->wait(0, in_ten_seconds());
  ASSERT_TRUE(again && *again);
  EXPECT_EQ((*again)->number, 1U);
  EXPECT_EQ((*client)->losses(), 1U);
  EXPECT_FALSE((*client)->loss());
}

TEST(RosbridgeClient, LeavesOutWhatItCannotUseAndSaysSoOnce) {
  TestRosbridgeServer server;
  const auto client = RosbridgeClient::open(options_for(server));
  ASSERT_TRUE(client);
  server.send("rubbish");
  server.send(ros_published("/other", R"({"percentage":1})"));
  server.send(battery("\"full\"", "secs"));
  server.send(battery("0.75", "secs"));
  const auto newest = (*client)->wait(0, in_ten_seconds());
  ASSERT_TRUE(newest && *newest);
  EXPECT_EQ(std::get<RosBattery>((*newest)->message.body).charge, 0.75);
  EXPECT_NE((*client)->notice().value_or("").find("such messages are left out"), std::string::npos);
  EXPECT_FALSE((*client)->notice());
}

TEST(RosbridgeClient, LosesAServerThatFloodsItOrIsSilent) {
  TestRosbridgeServer server;
  auto options = options_for(server);
  options.most_per_s = 100;
  options.retry = std::chrono::seconds(60);
  const auto client = RosbridgeClient::open(options);
  ASSERT_TRUE(client);
  for (int n = 0; n < 1000; ++n) server.send(battery("0.5", "secs"));
  const auto flood = sentence_of([&] { return (*client)->loss(); });
  EXPECT_NE(flood.find("sends more than 100 messages a second"), std::string::npos) << flood;
  EXPECT_FALSE((*client)->is_connected());
  EXPECT_FALSE((*client)->publish(0, "{}"));

  TestRosbridgeServer quiet;
  options = options_for(quiet);
  options.silence = milliseconds(50);
  options.retry = std::chrono::seconds(60);
  const auto waiting = RosbridgeClient::open(options);
  ASSERT_TRUE(waiting);
  const auto lost = (*waiting)->wait(0, in_ten_seconds());
  ASSERT_FALSE(lost);
  EXPECT_NE(lost.error().message.find("has sent nothing"), std::string::npos);
}

TEST(RosbridgeClient, IsNotThereWithoutAServer) {
  RosbridgeOptions options;
  options.host = "127.0.0.1";
  options.port = "1";
  const auto client = RosbridgeClient::open(options);
  ASSERT_FALSE(client);
  EXPECT_EQ(client.error().code, ErrorCode::invalid_input);
  EXPECT_EQ(client.error().place, "ros://127.0.0.1:1");
}

}  // namespace
}  // namespace palpable::sources
