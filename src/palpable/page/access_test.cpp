// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/page/access.hpp"

#include "palpable/page/http.hpp"

#include <gtest/gtest.h>

namespace palpable::page {
namespace {

constexpr std::uint16_t kPort = 4711;
const OwnNames kOwn = loopback_names(kPort);

Request own_request(std::string_view method, std::string_view target) {
  return {method, target, "127.0.0.1:4711", "http://127.0.0.1:4711", {}, {}};
}

TEST(Access, CreatesLongAndDifferentSecrets) {
  const auto a = random_secret();
  const auto b = random_secret();
  ASSERT_TRUE(a && b);
  EXPECT_EQ(a->size(), 32U);
  EXPECT_NE(*a, *b);
}

TEST(Access, ComparesWholeSecrets) {
  EXPECT_TRUE(same_secret("abc", "abc"));
  EXPECT_FALSE(same_secret("abc", "abd"));
  EXPECT_FALSE(same_secret("abc", "ab"));
  EXPECT_FALSE(same_secret("", ""));
}

TEST(Access, FindsItsCookieAmongOthers) {
  EXPECT_EQ(cookie_value("a=1; palpable_4711=xyz; b=2", "palpable_4711"), "xyz");
  EXPECT_EQ(cookie_value("palpable_4711=xyz", "palpable_4711"), "xyz");
  EXPECT_EQ(cookie_value("palpable_47110=xyz", "palpable_4711"), "");
  EXPECT_EQ(cookie_value("xpalpable_4711=xyz", "palpable_4711"), "");
  EXPECT_EQ(cookie_value(";;=; =", "palpable_4711"), "");
}

TEST(Access, AcceptsOnlyItsOwnHost) {
  EXPECT_TRUE(is_own_host("127.0.0.1:4711", kOwn));
  EXPECT_TRUE(is_own_host("localhost:4711", kOwn));
  EXPECT_FALSE(is_own_host("127.0.0.1", kOwn));
  EXPECT_FALSE(is_own_host("127.0.0.1:80", kOwn));
  EXPECT_FALSE(is_own_host("evil.example:4711", kOwn));
  EXPECT_FALSE(is_own_host("127.0.0.1:4711.evil.example", kOwn));
  EXPECT_FALSE(is_own_host("", kOwn));
  EXPECT_TRUE(is_own_origin("http://localhost:4711", kOwn));
  EXPECT_FALSE(is_own_origin("https://localhost:4711", kOwn));
  EXPECT_FALSE(is_own_origin("null", kOwn));
}

TEST(Access, AcceptsOnlyTheAddressOfGuestsForThem) {
  const OwnNames names = guest_names({"192.168.1.20", "fd00::2"}, kPort);
  EXPECT_TRUE(is_own_host("192.168.1.20:4711", names));
  EXPECT_FALSE(is_own_host("127.0.0.1:4711", names));
  EXPECT_FALSE(is_own_host("192.168.1.20", names));
  EXPECT_TRUE(is_own_host("[fd00::2]:4711", names));
  EXPECT_FALSE(is_own_host("fd00::2:4711", names));
  EXPECT_FALSE(is_own_host("[fd00::3]:4711", names));
  EXPECT_TRUE(is_own_origin("https://[fd00::2]:4711", names));
  EXPECT_FALSE(is_own_origin("http://[fd00::2]:4711", names));
  EXPECT_TRUE(is_own_origin("https://192.168.1.20:4711", names));
  EXPECT_FALSE(is_own_origin("http://192.168.1.20:4711", names));
}

TEST(Access, AcceptsTheTokenOnceAndThenTheCookie) {
  RequestHandler front(SessionAccess("the-token", "the-secret"), kPort);
  Request request = own_request("POST", "/session");
  request.body = "another";
  EXPECT_EQ(front.answer(request).status, 403U);
  request.body = "the-token";
  const Reply reply = front.answer(request);
  EXPECT_EQ(reply.status, 204U);
  EXPECT_EQ(reply.set_cookie, "palpable_4711=the-secret; Path=/; SameSite=Strict; HttpOnly");
  EXPECT_EQ(front.answer(request).status, 403U);
  request.cookies = "palpable_4711=the-secret";
  EXPECT_EQ(front.answer(request).status, 204U);
  request.method = "GET";
  EXPECT_EQ(front.answer(request).status, 204U);
  request.cookies = "palpable_4711=the-secre";
  EXPECT_EQ(front.answer(request).status, 401U);
}

TEST(Access, RefusesOtherHostsAndOriginsForEveryTarget) {
  RequestHandler front(SessionAccess("the-token", "the-secret"), kPort);
  for (const char* target : {"/", "/session", "/socket"}) {
    Request request = own_request("GET", target);
    request.host = "rebound.example:4711";
    EXPECT_EQ(front.answer(request).status, 403U);
    request = own_request("GET", target);
    request.origin = "http://evil.example";
    EXPECT_EQ(front.answer(request).status, 403U);
  }
}

TEST(Access, AcceptsAWebSocketOnlyWithOriginAndCookie) {
  const RequestHandler front(SessionAccess("the-token", "the-secret"), kPort);
  Request request = own_request("GET", "/socket");
  EXPECT_EQ(front.check_upgrade(request).status, 401U);
  request.cookies = "palpable_4711=the-secret";
  EXPECT_EQ(front.check_upgrade(request).status, 101U);
  request.origin = {};
  EXPECT_EQ(front.check_upgrade(request).status, 403U);
  request.origin = "http://127.0.0.1:4712";
  EXPECT_EQ(front.check_upgrade(request).status, 403U);
  request = own_request("GET", "/elsewhere");
  EXPECT_EQ(front.check_upgrade(request).status, 404U);
}

TEST(Access, ServesThePageAndNothingElse) {
  RequestHandler front(SessionAccess("the-token", "the-secret"), kPort);
  const Reply page = front.answer(own_request("GET", "/"));
  EXPECT_EQ(page.status, 200U);
  EXPECT_EQ(page.media_type, "text/html; charset=utf-8");
  EXPECT_NE(page.body.find("<!doctype html>"), std::string::npos);
  EXPECT_EQ(front.answer(own_request("GET", "/../etc/passwd")).status, 404U);
  EXPECT_EQ(front.answer(own_request("DELETE", "/")).status, 405U);
  EXPECT_EQ(front.answer(own_request("GET", "/socket")).status, 426U);
}

}  // namespace
}  // namespace palpable::page
