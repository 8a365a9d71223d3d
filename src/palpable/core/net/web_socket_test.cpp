// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/core/net/web_socket.hpp"

#include "palpable/core/files/byte_reader.hpp"

#include <array>
#include <thread>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace palpable {
namespace {

using std::chrono::milliseconds;
constexpr milliseconds kLong{5000};

auto in(milliseconds time) { return std::chrono::steady_clock::now() + time; }

/// Waits for a connection.
TcpStream accepted(TcpListener& listener) {
  wait_for_any(std::array{listener.descriptor()}, kLong);
  return *listener.accept();
}

struct Ends {
  std::unique_ptr<WebSocket> client, server;
};

Ends connected(const WebSocket::Limits& limits = {}) {
  auto listener = *TcpListener::open("127.0.0.1", 0);
  Ends ends;
  std::thread serving([&] { ends.server = *WebSocket::accept(accepted(listener), kLong, limits); });
  ends.client = *WebSocket::connect("127.0.0.1", std::to_string(listener.port()), kLong, limits);
  serving.join();
  return ends;
}

TEST(WebSocket, CarriesMessagesBothWaysInTheirOrder) {
  auto ends = connected();
  const std::string large(300'000, 'x');
  EXPECT_TRUE(ends.client->send("first"));
  EXPECT_TRUE(ends.client->send(large));
  EXPECT_TRUE(ends.server->send("answer"));
  std::vector<std::string> heard;
  for (int n = 0; n < 5000 && heard.size() < 2; ++n) {
    // A message larger than the system's buffers moves while both ends run.
    const auto answer = ends.client->receive(in(milliseconds(1)));
    ASSERT_TRUE(answer);
    if (*answer) {
      EXPECT_EQ(**answer, "answer");
    }
    auto message = ends.server->receive(in(milliseconds(1)));
    ASSERT_TRUE(message);
    if (*message) heard.push_back(**std::move(message));
  }
  EXPECT_EQ(heard, (std::vector<std::string>{"first", large}));
  EXPECT_EQ(ends.client->unsent_bytes(), 0U);
}

TEST(WebSocket, KeepsNoMoreForAPeerThatDoesNotRead) {
  auto ends = connected({1000, 1000});
  EXPECT_TRUE(ends.client->send(std::string(900, 'x')));
  EXPECT_FALSE(ends.client->send(std::string(101, 'x')));
  EXPECT_EQ(ends.client->unsent_bytes(), 900U);
}

TEST(WebSocket, IsLostByAMessageThatIsTooLong) {
  auto ends = connected({1024, 4096});
  EXPECT_TRUE(ends.client->send(std::string(2000, 'x')));
  const auto nothing = ends.client->receive(in(milliseconds(50)));
  const auto lost = ends.server->receive(in(kLong));
  ASSERT_FALSE(lost);
  EXPECT_EQ(lost.error().message, "sends a message of more than 1 KiB");
  EXPECT_FALSE(ends.server->send("more"));
}

TEST(WebSocket, SendsWhatWaitsBeforeItCloses) {
  auto ends = connected();
  EXPECT_TRUE(ends.client->send("last"));
  std::thread closing([&] { ends.client->close(kLong); });
  const auto last = ends.server->receive(in(kLong));
  const auto lost = ends.server->receive(in(kLong));
  closing.join();
  ASSERT_TRUE(last && *last);
  EXPECT_EQ(**last, "last");
  ASSERT_FALSE(lost);
  EXPECT_EQ(lost.error().message, "closed the connection");
}

TEST(WebSocket, IsNotOpenedByAnotherProgramsPort) {
  auto listener = *TcpListener::open("127.0.0.1", 0);
  std::thread other([&] {
    auto stream = accepted(listener);
    stream.send(as_bytes("SSH-2.0-x\r\n\r\n"));
    stream.close_after_sending(milliseconds(200));
  });
  const auto socket = WebSocket::connect("127.0.0.1", std::to_string(listener.port()), kLong, {});
  other.join();
  ASSERT_FALSE(socket);
  EXPECT_NE(socket.error().message.find("opens no WebSocket ("), std::string::npos);
}

}  // namespace
}  // namespace palpable
