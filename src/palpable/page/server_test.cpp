// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/page/server.hpp"

#include <future>
#include <optional>
#include <thread>

#include <boost/asio/connect.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/read.hpp>
#include <boost/asio/write.hpp>
#include <boost/beast/core/buffers_to_string.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/core/tcp_stream.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace palpable::page {
namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = boost::beast::http;
namespace websocket = boost::beast::websocket;
using tcp = boost::asio::ip::tcp;
using Json = nlohmann::json;

// A host without a servo that records messages. Used by the server's thread, then read by the test.
class FakeHost final : public PageHost {
 public:
  FakeHost() {
    auto scene = std::make_shared<PageScene>();
    scene->about.scene = 1;
    scene->about.name = "test";
    scene->height_m = Raster<float>(4, 3, 0.001F);
    scene_ = scene;
  }
  protocol::Hello hello() const override {
    return {protocol::kVersion, 0, "test", "pointer", true, 1, false};
  }
  protocol::Laws laws() const override { return {{{"proxy", "Surface", {}, true, true}}}; }
  std::shared_ptr<const PageScene> scene() override { return scene_; }
  protocol::Settings settings() override { return settings_; }
  protocol::Materials materials() override { return materials_; }
  protocol::State state() override {
    protocol::State state;
    state.t_s = ++states;
    state.probes.emplace_back().x_m = pointer_.x_m;
    return state;
  }
  void update() override {}
  void move(const protocol::Pointer& pointer) override {
    pointer_ = pointer;
    ++moves;
  }
  void lift(const protocol::Lift& probe) override {
    lifted += 1 << probe.probe;
    lifted.notify_all();
  }
  void change(const protocol::Change& change) override {
    settings_.answers = change.serial;
    if (change.law == "proxy") {
      settings_.exaggeration = change.exaggeration;
    } else {
      notice_ = protocol::Notice{"warning", "there is no such law"};
    }
  }
  void edit(const protocol::Edit& edit) override { settings_.answers = materials_.answers = edit.serial; }
  void save() override { notice_ = protocol::Notice{"info", "saved"}; }
  void pause(bool paused) override { settings_.paused = paused; }
  void recentre() override {}
  void stand(const protocol::Stand&) override {}
  std::string answer(const protocol::Ask& ask) override { return "words on " + ask.what; }
  std::optional<protocol::Notice> next_notice() override { return std::exchange(notice_, std::nullopt); }

  std::atomic<int> moves = 0;
  /// How often state() was called.
  std::atomic<int> states = 0;
  /// Bit k is set if probe k was lifted.
  std::atomic<int> lifted = 0;

 private:
  std::shared_ptr<const PageScene> scene_;
  protocol::Settings settings_;
  protocol::Materials materials_;
  protocol::Pointer pointer_;
  std::optional<protocol::Notice> notice_;
};

// A server on its own thread for the duration of a test.
class ServedPage {
 public:
  explicit ServedPage(ServeOptions options = {}) {
    std::promise<std::string> ready;
    options.on_ready = [&](const std::string& where) { ready.set_value(where); };
    thread_ = std::thread([this, options] { result_ = serve(host, options, stop_); });
    address = ready.get_future().get();
    const auto colon = address.rfind(':');
    const auto slash = address.find('/', colon);
    port = static_cast<std::uint16_t>(std::stoi(address.substr(colon + 1, slash - colon - 1)));
    token = address.substr(address.find('#') + 1);
  }
  ~ServedPage() {
    stop_ = true;
    thread_.join();
    EXPECT_TRUE(result_);
  }
  ServedPage(const ServedPage&) = delete;
  ServedPage& operator=(const ServedPage&) = delete;

  std::string own_origin() const { return "http://127.0.0.1:" + std::to_string(port); }

  FakeHost host;
  std::string address;
  std::string token;
  std::uint16_t port = 0;

 private:
  std::atomic<bool> stop_ = false;
  Result<void> result_;
  std::thread thread_;
};

using Response = http::response<http::string_body>;

using Headers = std::vector<std::pair<http::field, std::string>>;

Response ask(const ServedPage& page, http::verb method, const std::string& target,
             const std::string& body = {}, const Headers& headers = {}) {
  asio::io_context context;
  beast::tcp_stream stream(context);
  stream.connect(tcp::endpoint(asio::ip::address_v4::loopback(), page.port));
  http::request<http::string_body> request(method, target, 11);
  request.set(http::field::host, "127.0.0.1:" + std::to_string(page.port));
  for (const auto& [name, value] : headers)
    if (!value.empty()) request.set(name, value);
  request.body() = body;
  request.prepare_payload();
  http::write(stream, request);
  beast::flat_buffer buffer;
  http::response_parser<http::string_body> parser;
  parser.skip(method == http::verb::head);
  http::read(stream, buffer, parser);
  return parser.release();
}

// The status of the server's answer to a WebSocket request.
unsigned upgrade_status(const ServedPage& page, const std::string& cookie, const std::string& origin,
                        const std::string& host = {}) {
  return ask(page, http::verb::get, "/socket", {},
             {{http::field::cookie, cookie},
              {http::field::origin, origin},
              {http::field::host, host},
              {http::field::connection, "Upgrade"},
              {http::field::upgrade, "websocket"},
              {http::field::sec_websocket_version, "13"},
              {http::field::sec_websocket_key, "dGhlIHNhbXBsZSBub25jZQ=="}})
      .result_int();
}

std::string cookie_of(const ServedPage& page) {
  const Response response = ask(page, http::verb::post, "/session", page.token);
  EXPECT_EQ(response.result_int(), 204U);
  const std::string header(response[http::field::set_cookie]);
  return header.substr(0, header.find(';'));
}

// A minimal client in place of a page.
class TestPage {
 public:
  explicit TestPage(const ServedPage& page) : TestPage(page, cookie_of(page)) {}
  TestPage(const ServedPage& page, const std::string& cookie) {
    socket_.next_layer().connect(tcp::endpoint(asio::ip::address_v4::loopback(), page.port));
    socket_.set_option(websocket::stream_base::decorator([&](websocket::request_type& request) {
      request.set(http::field::origin, page.own_origin());
      request.set(http::field::cookie, cookie);
    }));
    socket_.handshake("127.0.0.1:" + std::to_string(page.port), "/socket");
  }
  void send(const std::string& text, bool binary = false) {
    socket_.binary(binary);
    beast::error_code error;
    socket_.write(asio::buffer(text), error);
    failed_ = failed_ || error;
  }
  bool failed() const { return failed_; }
  // The next frame; empty once the socket is closed.
  std::string read() {
    beast::flat_buffer buffer;
    beast::error_code error;
    socket_.read(buffer, error);
    return error ? std::string() : beast::buffers_to_string(buffer.data());
  }
  Json read_until(const std::string& type) {
    for (std::string frame = read(); !frame.empty(); frame = read()) {
      const Json json = Json::parse(frame, nullptr, false);
      if (json.is_object() && json["type"] == type) return json;
    }
    return {};
  }
  websocket::close_reason read_to_the_end() {
    while (!read().empty()) {
    }
    return socket_.reason();
  }

 private:
  asio::io_context context_;
  websocket::stream<tcp::socket> socket_{context_};
  bool failed_ = false;
};

TEST(PageServer, ServesThePageWithSecurityHeaders) {
  const ServedPage page;
  const Response response = ask(page, http::verb::get, "/");
  EXPECT_EQ(response.result_int(), 200U);
  EXPECT_NE(std::string(response["Content-Security-Policy"]).find("default-src 'self'"), std::string::npos);
  EXPECT_EQ(response["X-Content-Type-Options"], "nosniff");
  EXPECT_EQ(response["Cache-Control"], "no-store");
  EXPECT_EQ(ask(page, http::verb::head, "/nothing").result_int(), 404U);
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
           R"(","parameters":[],"exaggeration":2})";
  };
  client.send(change("fly", 5));
  EXPECT_EQ(client.read_until("notice")["text"], "there is no such law");
  const Json refused = client.read_until("settings");
  EXPECT_EQ(refused["exaggeration"], 0.0);
  EXPECT_EQ(refused["answers"], 5);
  client.send(change("proxy", 6));
  EXPECT_EQ(client.read_until("settings")["exaggeration"], 2.0);
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
  // The host is called 60 times per second; its clock counts the calls.
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

/// Waits until exactly these probes have been lifted.
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
  // Probe 4 was lifted before: it may be another page's by now.
  wait_until_lifted(page.host, (1 << 4) + (1 << 1));
  stays.send(R"({"type":"lift","probe":2})");
  wait_until_lifted(page.host, (1 << 4) + (1 << 1) + (1 << 2));
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
  // The server refuses it by its length and closes with the rest unread. If the kernel answers with a reset,
  // the reason does not arrive, but the end of the connection does.
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
