// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// Who may touch with a shared device: tokens, refusals, and those who come back.
#include "palpable/device/remote/test_remote_host.hpp"

#include <string_view>

namespace palpable::device {
namespace {

TEST_F(RemoteHostTest, TakesATokenOnce) {
  const std::string first = url();
  {
    auto device = open_device(first, {});
    ASSERT_TRUE(device);
    const auto second = open_device(first, {});
    ASSERT_FALSE(second);
    EXPECT_NE(second.error().message.find("used already"), std::string::npos) << second.error().message;
  }
  EXPECT_TRUE(has_news("has ended"));
  const auto late = open_device(first, {});
  ASSERT_FALSE(late);
  EXPECT_EQ(late.error().code, ErrorCode::device);
  std::this_thread::sleep_for(RemoteHost::kWrongTokenWait);
  EXPECT_NE(url(), first);
  EXPECT_TRUE(connect());
}

TEST_F(RemoteHostTest, RefusesWhoIsNoClient) {
  const std::string wrong(kSecret_bytes, '0');
  auto stream = raw();
  const auto answer = answer_to(stream, hello_message(wrong));
  ASSERT_TRUE(answer);
  EXPECT_EQ(parse_refused(*answer), Refusal::wrong_token);
  EXPECT_TRUE(has_news("token is wrong"));
  auto web = raw();
  const std::string_view request = "GET / HTTP/1.1\r\nHost: x\r\n\r\n";
  const auto to_web = answer_to(web, std::as_bytes(std::span(request)));
  ASSERT_TRUE(to_web);
  EXPECT_EQ(parse_refused(*to_web), Refusal::not_understood);
  EXPECT_TRUE(has_news("is no Palpable"));
  auto next = raw();
  auto other_version = hello_message(host_->token());
  other_version[2] = std::byte{7};
  next.send(other_version);
  EXPECT_TRUE(has_news("another version"));
  auto silent = raw();
  EXPECT_TRUE(has_news("no token in time"));
  // And the next one who has the token is served.
  EXPECT_TRUE(connect());
}

TEST_F(RemoteHostTest, LetsAClientComeBackToItsSession) {
  std::string secret;
  {
    auto stream = raw();
    const auto answer = answer_to(stream, hello_message(host_->token()));
    const auto welcome = answer ? parse_welcome(*answer) : std::nullopt;
    ASSERT_TRUE(welcome);
    secret = welcome->secret;
    EXPECT_TRUE(exchange_->connected);
    stream.send(surface_message(a_plane()));
    ASSERT_TRUE(surface_comes());
  }
  EXPECT_TRUE(has_news("The connection is broken"));
  EXPECT_FALSE(exchange_->connected);
  auto again = raw();
  const auto answer = answer_to(again, hello_message(secret));
  ASSERT_TRUE(answer && parse_welcome(*answer));
  EXPECT_TRUE(has_news("connected again"));
  EXPECT_TRUE(exchange_->connected);
  // A connection that is still open here, but silent, is replaced.
  std::this_thread::sleep_for(milliseconds(150));
  auto third = raw();
  const auto to_third = answer_to(third, hello_message(secret));
  EXPECT_TRUE(to_third && parse_welcome(*to_third));
}

TEST_F(RemoteHostTest, AClientThatWasGoneBeforeItsFirstMessageMayUseTheTokenAgain) {
  const std::string first = host_->token();
  {
    auto stream = raw();
    const auto answer = answer_to(stream, hello_message(first));
    ASSERT_TRUE(answer && parse_welcome(*answer));
  }
  // It may not have got the answer, and so cannot come back.
  EXPECT_TRUE(has_news("The connection is broken"));
  auto stream = raw();
  const auto answer = answer_to(stream, hello_message(first));
  EXPECT_TRUE(answer && parse_welcome(*answer));
}

TEST_F(RemoteHostTest, SilentConnectionsDoNotHoldAClientOff) {
  std::vector<TcpStream> silent;
  for (std::size_t k = 0; k < 2 * RemoteHost::kMostVisitors; ++k) silent.push_back(raw());
  const auto device = connect();
  EXPECT_TRUE(device) << device.error().sentence();
  EXPECT_TRUE(has_news("it sent no token while others came"));
}

}  // namespace
}  // namespace palpable::device
