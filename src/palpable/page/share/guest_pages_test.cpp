// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// Guests of a shared touch: one-time links over TLS, roles, presence, and being shown out.
#include "palpable/page/share/test_guests.hpp"

#include <algorithm>
#include <array>
#include <set>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <openssl/evp.h>
#include <openssl/x509.h>

namespace palpable::page {
namespace {

using testing::HasSubstr;

// A question that each page may ask; its answer comes after those of all earlier messages.
constexpr const char* kQuestion =
    R"({"type":"ask","serial":7,"what":"position","probe":0,"x_m":0,"y_m":0,"press_m":0,"part":0})";

std::string pointer_of(int probe) {
  return R"({"type":"pointer","probe":)" + std::to_string(probe) + R"(,"x_m":0,"y_m":0,"press_m":0})";
}

// Every kind of message but the questions and `visible`.
const std::vector<std::string> kCommands = {
    pointer_of(0),
    R"({"type":"lift","probe":1})",
    R"({"type":"change","serial":1,"law":"proxy","parameters":[],"height_factor":2})",
    R"({"type":"edit","serial":1,"label":0,"material":{"stiffness_N_per_m":1,"damping_Ns_per_m":null,"friction":null,"stickiness":null,"texture":null}})",
    R"({"type":"save"})",
    R"({"type":"pause","paused":true})",
    R"({"type":"recentre"})",
    R"({"type":"robot_order","word":"start"})",
    R"({"type":"robot_order","word":"drive"})",
    R"({"type":"follow_head","follows":true,"down_deg":0})",
    R"({"type":"move_explorer","x_m":0,"y_m":0,"heading_deg":0})",
    R"({"type":"name","list":1,"place":null,"name":"a","sentence":"","x_m":0,"y_m":0})",
    R"({"type":"unname","list":1,"place":0})",
    R"({"type":"undo_name","redo":false})",
    R"({"type":"find","probe":0,"list":1,"place":0,"x_m":0,"y_m":0})",
    R"({"type":"invite","role":"touch"})",
    R"({"type":"withdraw"})",
    R"({"type":"show_out","guest":1})"};

// Reads until the words that answer `kQuestion`, and returns the sentences of the notices before.
template <class Page>
std::vector<std::string> notices_before_the_answer(Page& page) {
  page.send(kQuestion);
  std::vector<std::string> texts;
  for (std::string frame = page.read(); !frame.empty(); frame = page.read()) {
    const Json json = Json::parse(frame, nullptr, false);
    if (!json.is_object()) continue;
    if (json["type"] == "words") return texts;
    if (json["type"] == "notice") texts.push_back(json["text"]);
  }
  ADD_FAILURE() << "the page was closed";
  return texts;
}

// Reads until the sharing is as `wanted`.
template <class Wanted>
Json sharing_until(TestPage& page, Wanted wanted) {
  for (Json json = page.read_until("sharing"); json.is_object() && !json.empty();
       json = page.read_until("sharing"))
    if (wanted(json)) return json;
  ADD_FAILURE() << "the page was closed";
  return {};
}

std::string presence_of(const Json& sharing, std::size_t guest = 0) {
  return sharing["guests"].size() <= guest ? "" : sharing["guests"][guest]["presence"].get<std::string>();
}

// Asks for another link of this role on a page of this machine.
std::string invite(SharedPage& shared, TestPage& host, const std::string& role) {
  host.send(R"({"type":"invite","role":")" + role + R"("})");
  return shared.next_token();
}

TEST(SharedTouch, LetsAGuestInByTheCertificateThatItShows) {
  SharedPage shared;
  boost::asio::io_context context;
  ssl::stream<tcp::socket> stream(context, shared.trust);
  stream.next_layer().connect(tcp::endpoint(boost::asio::ip::address_v4::loopback(), shared.guests.port));
  stream.handshake(ssl::stream_base::client);
  EXPECT_STREQ(SSL_get_version(stream.native_handle()), "TLSv1.3");
  X509* shown = SSL_get1_peer_certificate(stream.native_handle());
  std::array<unsigned char, 32> bytes{};
  ASSERT_EQ(X509_digest(shown, EVP_sha256(), bytes.data(), nullptr), 1);
  X509_free(shown);
  std::string fingerprint;
  for (const unsigned byte : bytes) {
    constexpr std::string_view kDigits = "0123456789ABCDEF";
    if (!fingerprint.empty()) fingerprint += ':';
    fingerprint += {kDigits[byte >> 4U], kDigits[byte & 15U]};
  }
  EXPECT_EQ(fingerprint, shared.fingerprint());
  const Response page = exchange(stream, shared.guests.port, http::verb::get, "/", {}, {});
  EXPECT_EQ(page.result_int(), 200U);
  EXPECT_THAT(std::string(page["Content-Security-Policy"]), HasSubstr("default-src 'self'"));
}

TEST(SharedTouch, ALinkLetsOneDeviceInOnce) {
  SharedPage shared;
  const std::string cookie = shared.join(shared.token);
  ASSERT_FALSE(cookie.empty());
  EXPECT_TRUE(shared.join(shared.token).empty());
  EXPECT_THAT(shared.refusal, HasSubstr("used already"));
  GuestPage guest(shared, cookie);
  const Json hello = guest.read_until("hello");
  EXPECT_EQ(hello["guest"]["name"], "Phone 1");
  EXPECT_EQ(hello["guest"]["role"], "touch");
  EXPECT_EQ(hello["guest"]["probe"], 8);
  EXPECT_FALSE(hello["pointer_moves"]);
}

TEST(SharedTouch, TheCookieIsSentOverTlsOnly) {
  SharedPage shared;
  const Response response = shared.ask_as_guest(http::verb::post, "/session", shared.token);
  EXPECT_THAT(std::string(response[http::field::set_cookie]),
              testing::AllOf(HasSubstr("; SameSite=Strict; HttpOnly; Secure"), HasSubstr("Path=/")));
}

TEST(SharedTouch, ALinkExpires) {
  SharedPage shared;
  TestPage host(shared.page);
  EXPECT_EQ(host.read_until("sharing")["invitation"]["minutes"], 10);
  shared.now_s = 1601.0;
  sharing_until(host, [](const Json& now) { return now["invitation"].is_null(); });
  EXPECT_TRUE(shared.join(shared.token).empty());
  EXPECT_THAT(shared.refusal, HasSubstr("expired"));
}

TEST(SharedTouch, ThePagesOfThisMachineShowTheLinkAndItsCode) {
  SharedPage shared;
  TestPage host(shared.page);
  const Json sharing = host.read_until("sharing");
  EXPECT_EQ(sharing["address"], shared.origin() + "/");
  EXPECT_EQ(sharing["fingerprint"], shared.fingerprint());
  EXPECT_EQ(sharing["invitation"]["link"], shared.origin() + "/#" + shared.token);
  const auto side = sharing["invitation"]["side"].get<std::size_t>();
  EXPECT_EQ(sharing["invitation"]["code"].get<std::string>().size(), side * side);
}

TEST(SharedTouch, HostsAndOriginsOfTheTwoPortsAreKeptApart) {
  SharedPage shared;
  const std::string cookie = shared.join(shared.token);
  const std::string here = "127.0.0.1:" + std::to_string(shared.page.port);
  EXPECT_EQ(shared.ask_as_guest(http::verb::get, "/", {}, {{http::field::host, here}}).result_int(), 403U);
  EXPECT_EQ(
      shared.ask_as_guest(http::verb::get, "/", {}, {{http::field::host, "rebound.example"}}).result_int(),
      403U);
  EXPECT_EQ(shared.upgrade_status_of_guest(cookie, shared.page.own_origin()), 403U);
  EXPECT_EQ(shared.upgrade_status_of_guest(cookie, "http://127.0.0.1:" + std::to_string(shared.guests.port)),
            403U);
  EXPECT_EQ(shared.upgrade_status_of_guest(cookie, {}), 403U);
  EXPECT_EQ(shared.upgrade_status_of_guest({}, shared.origin()), 401U);
  EXPECT_EQ(shared.upgrade_status_of_guest(cookie, shared.origin()), 101U);
  // The guest's secret is none on the page's own port, whatever the cookie is called there.
  const std::string secret = cookie.substr(cookie.find('='));
  EXPECT_EQ(upgrade_status(shared.page, "palpable_" + std::to_string(shared.page.port) + secret,
                           shared.page.own_origin()),
            401U);
  // Nor is the printed token one for guests, or a guest's link one for the page.
  EXPECT_EQ(shared.ask_as_guest(http::verb::post, "/session", shared.page.token).result_int(), 403U);
}

TEST(SharedTouch, WhoLooksChangesNothing) {
  SharedPage shared;
  TestPage host(shared.page);
  GuestPage guest(shared, shared.join(invite(shared, host, "look")));
  EXPECT_EQ(guest.read_until("hello")["guest"]["role"], "look");
  for (const std::string& command : kCommands) {
    guest.send(command);
    EXPECT_THAT(notices_before_the_answer(guest),
                testing::ElementsAre("Only the person who shares the scene can do that."))
        << command;
  }
  EXPECT_EQ(shared.page.host.moves, 0);
  EXPECT_EQ(shared.page.host.commands, 0);
  EXPECT_EQ(shared.page.host.lifted, 0);
  EXPECT_EQ(shared.page.host.asked, 9);
  EXPECT_FALSE(guest.read_until("state").empty());
}

TEST(SharedTouch, WhoTouchesMovesOnlyItsOwnProbe) {
  SharedPage shared;
  GuestPage guest(shared, shared.join(shared.token));
  for (const std::string& command : kCommands) guest.send(command);
  guest.send(pointer_of(7));
  EXPECT_THAT(notices_before_the_answer(guest), testing::SizeIs(kCommands.size() + 1));
  EXPECT_EQ(shared.page.host.moves, 0);
  EXPECT_EQ(shared.page.host.commands, 0);
  guest.send(pointer_of(8));
  guest.send(R"({"type":"find","probe":8,"list":1,"place":0,"x_m":0,"y_m":0})");
  EXPECT_THAT(notices_before_the_answer(guest), testing::IsEmpty());
  EXPECT_EQ(shared.page.host.moves, 1);
  EXPECT_EQ(shared.page.host.moved, 8);
  EXPECT_EQ(shared.page.host.commands, 1);
  EXPECT_EQ(shared.page.host.asked, 8);
}

TEST(SharedTouch, AGuestWhoOnlyLooksStopsARobotAtOnceAndSeesIt) {
  SharedPage shared;
  shared.page.host.has_robot = true;
  TestPage host(shared.page);
  GuestPage guest(shared, shared.join(invite(shared, host, "look")));
  EXPECT_EQ(guest.read_until("robot")["events"], 0);
  guest.send(R"({"type":"robot_order","word":"stop"})");
  EXPECT_EQ(guest.read_until("robot")["events"], 1);
  EXPECT_EQ(shared.page.host.robot_stops, 1);
}

TEST(SharedTouch, GuestsAreNotToldWhatMayNameFiles) {
  SharedPage shared;
  TestPage host(shared.page);
  GuestPage guest(shared, shared.join(shared.token));
  guest.read_until("hello");
  host.send(R"({"type":"save"})");
  std::set<std::string> said;
  for (int k = 0; k < 2; ++k) said.insert(host.read_until("notice").value("text", ""));
  EXPECT_EQ(said, (std::set<std::string>{"Phone 1 has joined, and touches with probe 9.", "saved"}));
  EXPECT_THAT(notices_before_the_answer(guest), testing::IsEmpty());
}

TEST(SharedTouch, AGuestThatIsShownOutCannotComeBack) {
  SharedPage shared;
  TestPage host(shared.page);
  const std::string cookie = shared.join(shared.token);
  GuestPage guest(shared, cookie);
  guest.read_until("hello");
  guest.send(pointer_of(8));
  EXPECT_THAT(notices_before_the_answer(guest), testing::IsEmpty());
  host.send(R"({"type":"show_out","guest":1})");
  EXPECT_EQ(guest.read_to_the_end().reason, "shown out");
  sharing_until(host, [](const Json& now) { return now["guests"].empty(); });
  EXPECT_EQ(shared.page.host.lifted, 1 << 8);
  EXPECT_EQ(shared.upgrade_status_of_guest(cookie, shared.origin()), 401U);
  EXPECT_EQ(
      shared.ask_as_guest(http::verb::get, "/session", {}, {{http::field::cookie, cookie}}).result_int(),
      401U);
  EXPECT_TRUE(shared.join(shared.token).empty());
  // Another guest has another number and another secret.
  GuestPage next(shared, shared.join(invite(shared, host, "touch")));
  EXPECT_EQ(next.read_until("hello")["guest"]["guest"], 2);
}

TEST(SharedTouch, APhoneThatSleepsLeavesNoProbeAndComesBack) {
  SharedPage shared;
  TestPage host(shared.page);
  const std::string cookie = shared.join(shared.token);
  {
    GuestPage guest(shared, cookie);
    guest.read_until("hello");
    sharing_until(host, [](const Json& now) { return presence_of(now) == "here"; });
    guest.send(pointer_of(8));
    guest.send(R"({"type":"visible","visible":false})");
    sharing_until(host, [](const Json& now) { return presence_of(now) == "asleep"; });
    EXPECT_EQ(shared.page.host.lifted, 1 << 8);
    guest.send(R"({"type":"visible","visible":true})");
    guest.send(pointer_of(8));
    sharing_until(host, [](const Json& now) { return presence_of(now) == "here"; });
  }
  sharing_until(host, [](const Json& now) { return presence_of(now) == "away"; });
  EXPECT_EQ(shared.page.host.lifted, 2 << 8) << "lifted again";
  GuestPage again(shared, cookie);
  EXPECT_EQ(again.read_until("hello")["guest"]["guest"], 1);
  sharing_until(host, [](const Json& now) { return presence_of(now) == "here"; });
}

TEST(SharedTouch, AGuestsSecondPageTakesThePlaceOfTheFirst) {
  SharedPage shared;
  TestPage host(shared.page);
  const std::string cookie = shared.join(shared.token);
  GuestPage first(shared, cookie);
  first.read_until("hello");
  first.send(pointer_of(8));
  EXPECT_THAT(notices_before_the_answer(first), testing::IsEmpty());
  GuestPage second(shared, cookie);
  EXPECT_EQ(second.read_until("hello")["guest"]["probe"], 8);
  EXPECT_EQ(first.read_to_the_end().reason, "opened in another tab");
  second.send(pointer_of(8));
  EXPECT_THAT(notices_before_the_answer(second), testing::IsEmpty());
  EXPECT_EQ(shared.page.host.lifted, 1 << 8) << "lifted once, when the first page ended";
  const Json now = sharing_until(host, [](const Json& one) { return presence_of(one) == "here"; });
  EXPECT_EQ(now["guests"].size(), 1U);
}

TEST(SharedTouch, TwoPersonsTouchWithDifferentProbes) {
  SharedPage shared;
  TestPage host(shared.page);
  GuestPage first(shared, shared.join(shared.token));
  GuestPage second(shared, shared.join(invite(shared, host, "touch")));
  EXPECT_EQ(first.read_until("hello")["guest"]["probe"], 8);
  EXPECT_EQ(second.read_until("hello")["guest"]["probe"], 7);
  second.send(pointer_of(8));
  EXPECT_THAT(notices_before_the_answer(second), testing::Contains(HasSubstr("Only the person who shares")));
  EXPECT_EQ(shared.page.host.moves, 0);
}

TEST(GuestPages, AreServedAtBothVersionsOfTheInternetProtocol) {
  const auto own = network_addresses();
  const auto six = ip_address("::1").value();
  if (std::none_of(own.begin(), own.end(), [&](const auto& one) { return one.address == six; }))
    GTEST_SKIP() << "this computer has no loopback of version 6";
  SharedPage shared({}, 8, {"127.0.0.1", "::1"});
  const std::string host = "[::1]:" + std::to_string(shared.guests.port);
  EXPECT_EQ(shared.other_link, "https://" + host + "/#" + shared.token);
  const auto join = [&](const std::string& to, const std::string& from) {
    return shared.status_over_version_6(http::verb::post, "/session", shared.token, to, from);
  };
  EXPECT_EQ(join("localhost:" + std::to_string(shared.guests.port), "https://" + host), 403U);
  EXPECT_EQ(join("[::2]:" + std::to_string(shared.guests.port), "https://" + host), 403U);
  EXPECT_EQ(join(host, "https://evil.example"), 403U);
  EXPECT_EQ(join(host, "https://" + host), 204U);
  // One link, whichever address is used.
  EXPECT_EQ(join(host, "https://" + host), 403U);
}

}  // namespace
}  // namespace palpable::page
