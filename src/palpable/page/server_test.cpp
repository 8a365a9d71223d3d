// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/page/server.hpp"

#include "palpable/page/test_page.hpp"

#include <atomic>
#include <optional>
#include <string>

#include <gtest/gtest.h>

namespace palpable::page {
namespace {

TEST(PageServer, SendsTheSceneThenStatesAndHandlesMessages) {
  const ServedPage page;
  TestPage client(page);
  EXPECT_EQ(Json::parse(client.read())["type"], "hello");
  EXPECT_EQ(Json::parse(client.read())["laws"][0]["name"], "proxy");
  EXPECT_EQ(Json::parse(client.read())["type"], "scene");
  EXPECT_EQ(client.read().substr(0, 4), "PLP1");
  EXPECT_EQ(Json::parse(client.read())["type"], "settings");
  client.send(R"({"type":"pointer","probe":0,"x_m":0.03,"y_m":0,"press_m":0})");
  Json state = client.read_until("state");
  while (!state.is_null() && state["probes"][0]["x_m"] != 0.03) state = client.read_until("state");
  EXPECT_EQ(state["probes"][0]["x_m"], 0.03);
  const auto change = [](const std::string& law, int serial) {
    return R"({"type":"change","serial":)" + std::to_string(serial) + R"(,"law":")" + law +
           R"(","parameters":[],"height_factor":2})";
  };
  client.send(change("fly", 5));
  EXPECT_EQ(client.read_until("notice")["text"], "there is no such law");
  const Json refused = client.read_until("settings");
  EXPECT_EQ(refused["height_factor"], 0.0);
  EXPECT_EQ(refused["answers"], 5);
  client.send(change("proxy", 6));
  EXPECT_EQ(client.read_until("settings")["height_factor"], 2.0);
  client.send(R"({"type":"ask","serial":7,"what":"step","probe":0,"x_m":0,"y_m":0,"press_m":0,"part":0})");
  const Json words = client.read_until("words");
  EXPECT_EQ(words["serial"], 7);
  EXPECT_EQ(words["text"], "words on step");
}

TEST(PageServer, SendsOneStatePerSecondWhileNothingChanges) {
  const ServedPage page;
  TestPage client(page);
  const Json first = client.read_until("state");
  const Json second = client.read_until("state");
  // The host is called 60 times per second; its clock is the number of calls.
  EXPECT_GT(second["t_s"].get<double>() - first["t_s"].get<double>(), 10.0);
  client.send(R"({"type":"pointer","probe":0,"x_m":0.03,"y_m":0,"press_m":0})");
  EXPECT_EQ(client.read_until("state")["probes"][0]["x_m"], 0.03);
}

TEST(PageServer, ReportsWhichPageMovedAProbe) {
  const ServedPage page;
  const std::string cookie = cookie_of(page);
  TestPage first(page, cookie);
  TestPage second(page, cookie);
  const Json one = first.read_until("hello")["page"];
  const Json other = second.read_until("hello")["page"];
  EXPECT_NE(one, other);
  EXPECT_TRUE(first.read_until("state")["probes"][0]["page"].is_null());
  const auto comes = [](TestPage& client, const Json& mover) {
    for (Json state = client.read_until("state"); !state.is_null(); state = client.read_until("state"))
      if (state["probes"][0]["page"] == mover) return true;
    return false;
  };
  second.send(R"({"type":"pointer","probe":0,"x_m":0.01,"y_m":0,"press_m":0})");
  EXPECT_TRUE(comes(first, other));
  first.send(R"({"type":"pointer","probe":0,"x_m":0.02,"y_m":0,"press_m":0})");
  EXPECT_TRUE(comes(second, one));
}

/// Reads states until one says that this page moved the first probe.
void wait_until_moved(TestPage& client, const Json& mover) {
  while (client.read_until("state")["probes"][0]["page"] != mover) {
  }
}

TEST(PageServer, TellsOfARobotAndStopsItWhenThePageThatDrivesItIsHiddenOrClosed) {
  ServedPage page;
  page.host.has_robot = true;
  const std::string cookie = cookie_of(page);
  TestPage stays(page, cookie);
  EXPECT_EQ(stays.read_until("robot")["events"], 0);
  {
    TestPage drives(page, cookie);
    const Json number = drives.read_until("hello")["page"];
    stays.send(R"({"type":"visible","visible":false})");
    stays.send(R"({"type":"visible","visible":true})");
    drives.send(R"({"type":"pointer","probe":0,"x_m":0.01,"y_m":0,"press_m":0})");
    wait_until_moved(stays, number);
    EXPECT_EQ(page.host.robot_stops, 0) << "the page that was hidden does not drive it";
    drives.send(R"({"type":"visible","visible":false})");
    EXPECT_EQ(stays.read_until("robot")["events"], 1);
  }
  EXPECT_EQ(stays.read_until("robot")["events"], 2);
  EXPECT_EQ(page.host.commands, 0) << "a page that comes or goes starts nothing";
  {
    TestPage starts(page, cookie);
    starts.send(R"({"type":"robot_order","word":"start"})");
    starts.send(R"({"type":"visible","visible":false})");
    EXPECT_EQ(stays.read_until("robot")["events"], 3);
  }
}

TEST(PageServer, SendsWhatARobotSawTwiceASecondToPagesThatAreVisible) {
  ServedPage page;
  page.host.has_robot = true;
  const std::string cookie = cookie_of(page);
  TestPage sees(page, cookie);
  TestPage hidden(page, cookie);
  hidden.send(R"({"type":"visible","visible":false})");
  hidden.send(
      R"({"type":"ask","serial":1,"what":"position","probe":0,"x_m":0,"y_m":0,"press_m":0,"part":0})");
  EXPECT_EQ(hidden.read_until("words")["serial"], 1);
  int floors = 0;
  const int begin = page.host.floors;
  for (int k = 0; k < 3; ++k) floors += sees.read_until("robot_floor").empty() ? 0 : 1;
  EXPECT_EQ(floors, 3);
  EXPECT_LE(page.host.floors - begin, 4);
  hidden.send(
      R"({"type":"ask","serial":2,"what":"position","probe":0,"x_m":0,"y_m":0,"press_m":0,"part":0})");
  for (std::string frame = hidden.read(); !frame.empty(); frame = hidden.read()) {
    EXPECT_EQ(frame.find("robot_floor"), std::string::npos);
    if (frame.find(R"("serial":2)") != std::string::npos) break;
  }
}

TEST(PageServer, TellsWhereTheHeadIsOnlyToVisiblePagesThatFollowIt) {
  ServedPage page;
  const std::string cookie = cookie_of(page);
  TestPage other(page, cookie);
  {
    TestPage follows(page, cookie);
    follows.read_until("hello");
    EXPECT_FALSE(page.host.follows_head);
    follows.send(R"({"type":"follow_head","follows":true,"down_deg":12})");
    EXPECT_NEAR(double(follows.read_until("head")["place"]["z_m"]), 0.6, 1e-9);
    EXPECT_NEAR(double(follows.read_until("head")["age_s"]), 0.0, 1e-9);
    EXPECT_EQ(page.host.down_deg, 12.0);
    follows.send(R"({"type":"visible","visible":false})");
    page.host.follows_head.wait(true);
    follows.send(R"({"type":"visible","visible":true})");
    page.host.follows_head.wait(false);
    EXPECT_EQ(page.host.down_deg, 12.0);
  }
  page.host.follows_head.wait(true);
  EXPECT_FALSE(page.host.follows_head);
  other.send(R"({"type":"ask","serial":2,"what":"position","probe":0,"x_m":0,"y_m":0,"press_m":0,"part":0})");
  for (std::string frame = other.read(); !frame.empty(); frame = other.read()) {
    EXPECT_EQ(frame.find(R"("type":"head")"), std::string::npos);
    if (frame.find(R"("serial":2)") != std::string::npos) break;
  }
}

TEST(PageServer, LooksForNoHeadAfterTheLastPageIsClosed) {
  ServedPage page;
  {
    TestPage only(page, cookie_of(page));
    only.send(R"({"type":"follow_head","follows":true,"down_deg":0})");
    only.read_until("head");
  }
  page.host.follows_head.wait(true);
  EXPECT_FALSE(page.host.follows_head);
}

/// Waits until exactly these probes have been removed.
void wait_until_lifted(const FakeHost& host, int wanted) {
  for (int now = host.lifted; now != wanted; now = host.lifted) host.lifted.wait(now);
}

TEST(PageServer, LiftsOnlyTheProbesOfAPageThatDisconnects) {
  const ServedPage page;
  const std::string cookie = cookie_of(page);
  TestPage stays(page, cookie);
  stays.send(R"({"type":"pointer","probe":2,"x_m":0,"y_m":0,"press_m":0})");
  {
    TestPage leaves(page, cookie);
    leaves.send(R"({"type":"pointer","probe":0,"x_m":0,"y_m":0,"press_m":0})");
    leaves.send(R"({"type":"pointer","probe":1,"x_m":0,"y_m":0,"press_m":0})");
    leaves.send(R"({"type":"pointer","probe":4,"x_m":0,"y_m":0,"press_m":0})");
    leaves.send(R"({"type":"lift","probe":4})");
    wait_until_lifted(page.host, 1 << 4);
  }
  // Probe 4 was removed before; it may belong to another page by now.
  wait_until_lifted(page.host, (1 << 4) + (1 << 1));
  EXPECT_EQ(page.host.lifted & ((1 << 0) + (1 << 2)), 0) << "the hand, and the other page's probe";
  stays.send(R"({"type":"lift","probe":2})");
  wait_until_lifted(page.host, (1 << 4) + (1 << 1) + (1 << 2));
  // A probe that was removed twice would have been added twice.
  EXPECT_EQ(page.host.lifted, (1 << 4) + (1 << 1) + (1 << 2));
}

TEST(PageServer, ReportsThatAPortIsInUse) {
  const ServedPage page;
  FakeHost host;
  const std::atomic<bool> stop = false;
  ServeOptions options;
  options.port = page.port;
  const auto second = serve(host, options, stop);
  ASSERT_FALSE(second);
  EXPECT_EQ(second.error().code, ErrorCode::failed);
  EXPECT_EQ(second.error().reason, Reason::port_in_use);
  EXPECT_EQ(second.error().sentence(), "port " + std::to_string(page.port) + ": in use by another program");
}

TEST(PageServer, ReportsThatTheSessionHasEnded) {
  std::optional<TestPage> client;
  {
    const ServedPage page;
    client.emplace(page);
    ASSERT_EQ(Json::parse(client->read())["type"], "hello");
  }
  EXPECT_EQ(client->read_to_the_end().reason, "the session has ended");
}

}  // namespace
}  // namespace palpable::page
