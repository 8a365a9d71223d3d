// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// Access: token, cookie, hosts, limits and floods.
#include "palpable/page/server.hpp"
#include "palpable/page/test_page.hpp"

#include <memory>
#include <regex>
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

TEST(PageServer, ServesThePageWithSecurityHeaders) {
  const ServedPage page;
  const Response response = ask(page, http::verb::get, "/");
  EXPECT_EQ(response.result_int(), 200U);
  EXPECT_NE(std::string(response["Content-Security-Policy"]).find("default-src 'self'"), std::string::npos);
  EXPECT_EQ(std::string(response["Content-Security-Policy"]).find("wasm"), std::string::npos);
  EXPECT_EQ(response["X-Content-Type-Options"], "nosniff");
  EXPECT_EQ(response["Cache-Control"], "no-store");
  EXPECT_EQ(ask(page, http::verb::head, "/nothing").result_int(), 404U);
}

TEST(PageServer, LetsOnlyTheWorkerThatFindsFacesCompileWebAssembly) {
  const ServedPage page;
  const auto named = [&](const std::string& path, const char* pattern) {
    const std::string text = ask(page, http::verb::get, path).body();
    std::smatch found;
    return std::regex_search(text, found, std::regex(pattern)) ? found.str() : std::string();
  };
  const std::string script = named("/", "/assets/index-[^\"]+[.]js");
  ASSERT_FALSE(script.empty());
  const std::string worker = "/assets/" + named(script, "face_worker-[-_A-Za-z0-9]+[.]js");
  const auto policy = [&](const std::string& path) {
    const Response response = ask(page, http::verb::get, path);
    EXPECT_EQ(response.result_int(), 200U) << path;
    return std::string(response["Content-Security-Policy"]);
  };
  EXPECT_NE(policy(worker).find("script-src 'self' 'wasm-unsafe-eval'"), std::string::npos);
  EXPECT_EQ(policy(script).find("wasm"), std::string::npos);
}

TEST(PageServer, AcceptsTheTokenOfOneBrowserOnce) {
  const ServedPage page;
  EXPECT_EQ(ask(page, http::verb::post, "/session", "wrong").result_int(), 403U);
  EXPECT_FALSE(cookie_of(page).empty());
  EXPECT_EQ(ask(page, http::verb::post, "/session", page.token).result_int(), 403U);
}

TEST(PageServer, RefusesForeignHostsAndOrigins) {
  const ServedPage page;
  EXPECT_EQ(ask(page, http::verb::get, "/", {}, {{http::field::host, "rebound.example"}}).result_int(), 403U);
  EXPECT_EQ(
      ask(page, http::verb::post, "/session", page.token, {{http::field::origin, "http://evil.example"}})
          .result_int(),
      403U);
  const std::string cookie = cookie_of(page);
  EXPECT_EQ(upgrade_status(page, cookie, "http://evil.example"), 403U);
  EXPECT_EQ(upgrade_status(page, cookie, {}), 403U);
  EXPECT_EQ(upgrade_status(page, cookie, page.own_origin(), "rebound.example"), 403U);
  EXPECT_EQ(upgrade_status(page, {}, page.own_origin()), 401U);
  EXPECT_EQ(upgrade_status(page, cookie + "0", page.own_origin()), 401U);
  EXPECT_EQ(upgrade_status(page, cookie, page.own_origin()), 101U);
}

TEST(PageServer, DisconnectsAPageAfterAnInvalidMessageWithAReason) {
  const ServedPage page;
  const std::string cookie = cookie_of(page);
  TestPage text(page, cookie);
  text.send("not json");
  auto reason = text.read_to_the_end();
  EXPECT_EQ(reason.code, websocket::close_code::policy_error);
  EXPECT_EQ(reason.reason, "the message is not a JSON object, or too deep");
  TestPage binary(page, cookie);
  binary.send("PLP1", true);
  EXPECT_EQ(binary.read_to_the_end().code, websocket::close_code::unknown_data);
  TestPage big(page, cookie);
  big.send(std::string(100000, ' '));
  // The server refuses the request by its length and closes the connection with the rest unread. If the
  // kernel answers with a reset, the reason does not arrive, but the end of the connection does.
  EXPECT_THAT(big.read_to_the_end().code,
              testing::AnyOf(websocket::close_code::too_big, websocket::close_code::none));
  TestPage after(page, cookie);
  after.send("not json");
  EXPECT_EQ(after.read_to_the_end().code, websocket::close_code::policy_error);
}

TEST(PageServer, DropsAFloodThenDisconnectsIt) {
  ServeOptions options;
  options.rate = {.per_s = 100, .burst = 20, .most_drops = 100};
  const ServedPage page(options);
  TestPage client(page);
  for (int i = 0; i < 2000 && !client.failed(); ++i)
    client.send(R"({"type":"pointer","probe":0,"x_m":0,"y_m":0,"press_m":0})");
  EXPECT_EQ(client.read_to_the_end().reason, "too many messages");
  EXPECT_LT(page.host.moves, 1000);
}

TEST(PageServer, ReportsTheLimitToAPageBeyondIt) {
  ServeOptions options;
  options.most_clients = 1;
  const ServedPage page(options);
  const std::string cookie = cookie_of(page);
  {
    TestPage first(page, cookie);
    ASSERT_EQ(Json::parse(first.read())["type"], "hello");
    EXPECT_EQ(upgrade_status(page, cookie, page.own_origin()), 503U);
    const auto refused = ask(page, http::verb::get, "/session", {}, {{http::field::cookie, cookie}});
    EXPECT_EQ(refused.result_int(), 503U);
    EXPECT_EQ(refused.body(),
              "This session is open in 1 pages already, which is the limit: close one of them.");
    EXPECT_EQ(ask(page, http::verb::get, "/session").result_int(), 401U) << "strangers learn nothing of it";
  }
}

TEST(PageServer, SurvivesInvalidHttp) {
  const ServedPage page;
  for (const std::string& junk :
       {std::string("\r\n\r\n"), std::string(20000, 'x'), std::string("GET / HTTP/9.9\r\n\r\n"),
        "GET / HTTP/1.1\r\nX: " + std::string(20000, 'y') + "\r\n\r\n",
        std::string("POST /session HTTP/1.1\r\nContent-Length: 99999999\r\n\r\n")}) {
    asio::io_context context;
    tcp::socket socket(context);
    socket.connect(tcp::endpoint(asio::ip::address_v4::loopback(), page.port));
    beast::error_code error;
    asio::write(socket, asio::buffer(junk), error);
    socket.shutdown(tcp::socket::shutdown_send, error);
    std::string answer;
    asio::read(socket, asio::dynamic_buffer(answer), error);
  }
  EXPECT_EQ(ask(page, http::verb::get, "/").result_int(), 200U);
}

/// A connection that sends nothing.
class SilentConnection {
 public:
  explicit SilentConnection(const ServedPage& page) {
    socket_.connect(tcp::endpoint(asio::ip::address_v4::loopback(), page.port));
  }

 private:
  asio::io_context context_;
  tcp::socket socket_{context_};
};

TEST(PageServer, AdmitsTheBrowserWhileStrangersHoldAllConnections) {
  ServeOptions options;
  options.most_connections = 8;
  const ServedPage page(options);
  std::vector<std::unique_ptr<SilentConnection>> strangers;
  for (int k = 0; k < 20; ++k) strangers.push_back(std::make_unique<SilentConnection>(page));
  EXPECT_EQ(ask(page, http::verb::get, "/").result_int(), 200U);
  const std::string cookie = cookie_of(page);
  for (int k = 0; k < 20; ++k) strangers.push_back(std::make_unique<SilentConnection>(page));
  TestPage client(page, cookie);
  EXPECT_EQ(Json::parse(client.read())["type"], "hello");
  for (int k = 0; k < 20; ++k) strangers.push_back(std::make_unique<SilentConnection>(page));
  client.send(R"({"type":"ask","serial":7,"what":"step","probe":0,"x_m":0,"y_m":0,"press_m":0,"part":0})");
  EXPECT_EQ(client.read_until("words")["serial"], 7);
}

TEST(PageServer, KeepsAConnectionWithTheCookieWhileStrangersCome) {
  ServeOptions options;
  options.most_connections = 4;
  const ServedPage page(options);
  const std::string cookie = cookie_of(page);
  HttpConnection browser(page);
  EXPECT_EQ(browser.ask(http::verb::get, "/session", cookie), 204U);
  std::vector<std::unique_ptr<SilentConnection>> strangers;
  for (int k = 0; k < 20; ++k) strangers.push_back(std::make_unique<SilentConnection>(page));
  EXPECT_EQ(browser.ask(http::verb::get, "/session", cookie), 204U);
}

TEST(PageServer, RefusesTooManyUpgradesInAShortTime) {
  ServeOptions options;
  options.upgrade_rate = {.per_s = 1e-6, .burst = 3, .most_drops = 0};
  const ServedPage page(options);
  const std::string cookie = cookie_of(page);
  // Refusals of unauthorised clients do not count.
  for (int k = 0; k < 10; ++k) EXPECT_EQ(upgrade_status(page, {}, page.own_origin()), 401U);
  for (int k = 0; k < 3; ++k) EXPECT_EQ(upgrade_status(page, cookie, page.own_origin()), 101U);
  EXPECT_EQ(upgrade_status(page, cookie, page.own_origin()), 429U);
}

TEST(PageServer, DisconnectsAPageThatSendsTooManyPings) {
  ServeOptions options;
  options.ping_rate = {.per_s = 1e-6, .burst = 5, .most_drops = 0};
  const ServedPage page(options);
  const std::string cookie = cookie_of(page);
  TestPage few(page, cookie);
  for (int k = 0; k < 5; ++k) few.ping();
  few.send(R"({"type":"ask","serial":7,"what":"step","probe":0,"x_m":0,"y_m":0,"press_m":0,"part":0})");
  EXPECT_EQ(few.read_until("words")["serial"], 7);
  TestPage many(page, cookie);
  for (int k = 0; k < 200 && !many.failed(); ++k) many.ping();
  EXPECT_EQ(many.read_to_the_end().reason, "too many pings");
}

}  // namespace
}  // namespace palpable::page
