// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// Hostile devices at the port of guests, and too many of them: limits hold, and the page of this machine
// stays reachable.
#include "palpable/page/share/test_guests.hpp"

#include <memory>
#include <string>
#include <vector>

#include <boost/asio/read.hpp>
#include <boost/asio/write.hpp>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace palpable::page {
namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
using testing::HasSubstr;

constexpr const char* kProbeQuestion =
    R"({"type":"ask","serial":7,"what":"probe","probe":0,"x_m":0,"y_m":0,"press_m":0,"part":0})";

/// A connection to the port of guests without TLS.
class RawConnection {
 public:
  explicit RawConnection(const SharedPage& shared) {
    socket_.connect(tcp::endpoint(asio::ip::address_v4::loopback(), shared.guests.port));
  }
  void send(const std::string& bytes) {
    beast::error_code error;
    asio::write(socket_, asio::buffer(bytes), error);
  }
  // What is answered before the server closes the connection.
  std::string read_to_the_end() {
    beast::error_code error;
    std::string answer;
    asio::read(socket_, asio::dynamic_buffer(answer), error);
    return answer;
  }

 private:
  asio::io_context context_;
  tcp::socket socket_{context_};
};

unsigned status_of_the_own_page(const SharedPage& shared) {
  return ask(shared.page, http::verb::get, "/").result_int();
}

TEST(SharedTouchLimits, ClosesWhatIsNotTls) {
  SharedPage shared;
  for (const std::string& bytes :
       {std::string("GET / HTTP/1.1\r\nHost: 127.0.0.1\r\n\r\n"), std::string(20000, '\xff'),
        std::string("\x16\x03\x01\xff\xff", 5) + std::string(70000, 'x'), std::string("SSH-2.0-x\r\n")}) {
    RawConnection connection(shared);
    connection.send(bytes);
    EXPECT_THAT(connection.read_to_the_end(), testing::Not(HasSubstr("HTTP/1")));
  }
  EXPECT_FALSE(shared.join(shared.token).empty());
  EXPECT_EQ(status_of_the_own_page(shared), 200U);
}

TEST(SharedTouchLimits, EndsASlowHandshake) {
  ServeOptions options;
  options.handshake_timeout_s = 0.1;
  SharedPage shared(options);
  RawConnection silent(shared);
  RawConnection slow(shared);
  // The beginning of a ClientHello.
  slow.send(std::string("\x16\x03\x01\x02\x00\x01\x00", 7));
  EXPECT_EQ(silent.read_to_the_end(), "");
  EXPECT_EQ(slow.read_to_the_end(), "");
}

TEST(SharedTouchLimits, HoldsAgainstTwoHundredConnections) {
  ServeOptions options;
  options.handshake_rate = {.per_s = 1000, .burst = 1000, .most_drops = 0};
  SharedPage shared(options);
  TestPage host(shared.page);
  GuestPage guest(shared, shared.join(shared.token));
  std::vector<std::unique_ptr<RawConnection>> strangers;
  for (int k = 0; k < 200; ++k) strangers.push_back(std::make_unique<RawConnection>(shared));
  EXPECT_EQ(status_of_the_own_page(shared), 200U);
  guest.send(kProbeQuestion);
  EXPECT_EQ(guest.read_until("words")["serial"], 7);
  host.send(kProbeQuestion);
  EXPECT_EQ(host.read_until("words")["serial"], 7);
  // Of one address eight are open: all others have been closed.
  for (int k = 0; k < 190; ++k) EXPECT_EQ(strangers[static_cast<std::size_t>(k)]->read_to_the_end(), "");
}

TEST(SharedTouchLimits, DropsHandshakesBeyondTheirRate) {
  ServeOptions options;
  options.handshake_rate = {.per_s = 1e-6, .burst = 3, .most_drops = 0};
  SharedPage shared(options);
  for (int k = 0; k < 3; ++k) EXPECT_EQ(shared.ask_as_guest(http::verb::get, "/").result_int(), 200U);
  RawConnection beyond(shared);
  EXPECT_EQ(beyond.read_to_the_end(), "");
  EXPECT_EQ(status_of_the_own_page(shared), 200U);
}

TEST(SharedTouchLimits, TheOwnPagesHaveTheirFourPlacesBesideTheGuests) {
  SharedPage shared({}, 2);
  const std::string own = cookie_of(shared.page);
  TestPage host(shared.page, own);
  GuestPage first(shared, shared.join(shared.token));
  host.send(R"({"type":"invite","role":"look"})");
  GuestPage second(shared, shared.join(shared.next_token()));
  first.read_until("hello");
  second.read_until("hello");
  const TestPage more[] = {TestPage(shared.page, own), TestPage(shared.page, own),
                           TestPage(shared.page, own)};
  EXPECT_EQ(upgrade_status(shared.page, own, shared.page.own_origin()), 503U);
  static_cast<void>(more);
  // A third guest has no place, and no link is made for it.
  host.send(R"({"type":"invite","role":"look"})");
  std::string level;
  while (level != "answer") {
    const Json notice = host.read_until("notice");
    ASSERT_TRUE(notice.is_object());
    level = notice["level"];
  }
}

TEST(SharedTouchLimits, ALinkForWhichThereIsNoPlaceIsNotUsedUp) {
  SharedPage shared({}, 1);
  TestPage host(shared.page);
  const auto wait_for_guests = [&](const std::string& presence) {
    for (Json now = host.read_until("sharing"); !now.empty(); now = host.read_until("sharing"))
      if (now["guests"].empty() ? presence.empty() : now["guests"][0]["presence"] == presence) return;
    ADD_FAILURE() << "the page was closed";
  };
  const std::string cookie = shared.join(shared.token);
  GuestPage(shared, cookie).read_until("hello");
  wait_for_guests("away");
  shared.now_s = 1031.0;
  // The guest that is away would lose its place, but it comes back before the link is used.
  host.send(R"({"type":"invite","role":"look"})");
  const std::string token = shared.next_token();
  GuestPage back(shared, cookie);
  wait_for_guests("here");
  EXPECT_TRUE(shared.join(token).empty());
  EXPECT_THAT(shared.refusal, HasSubstr("which is the limit"));
  host.send(R"({"type":"show_out","guest":1})");
  wait_for_guests("");
  EXPECT_FALSE(shared.join(token).empty());
}

TEST(SharedTouchLimits, AGuestsFloodOfQuestionsIsNotAnswered) {
  ServeOptions options;
  options.question_rate = {.per_s = 1e-6, .burst = 5, .most_drops = 100};
  SharedPage shared(options);
  GuestPage guest(shared, shared.join(shared.token));
  for (int k = 0; k < 200 && !guest.failed(); ++k) guest.send(kProbeQuestion);
  int answers = 0;
  while (!guest.read_until("words").empty()) ++answers;
  EXPECT_EQ(answers, 5);
  EXPECT_EQ(status_of_the_own_page(shared), 200U);
}

TEST(SharedTouchLimits, AGuestsFloodOfMovesIsDroppedAndThenEndsItsPage) {
  ServeOptions options;
  options.rate = {.per_s = 100, .burst = 20, .most_drops = 100};
  SharedPage shared(options);
  GuestPage guest(shared, shared.join(shared.token));
  for (int k = 0; k < 2000 && !guest.failed(); ++k)
    guest.send(R"({"type":"pointer","probe":8,"x_m":0,"y_m":0,"press_m":0})");
  EXPECT_EQ(guest.read_to_the_end().reason, "too many messages");
  EXPECT_LT(shared.page.host.moves, 1000);
}

}  // namespace
}  // namespace palpable::page
