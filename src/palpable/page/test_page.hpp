// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

// What the tests of the page's server share: a server with a host that has no servo, and clients in place of
// a browser.

#include "palpable/page/server.hpp"

#include <atomic>
#include <future>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <boost/asio/connect.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/beast/core/buffers_to_string.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/core/tcp_stream.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace palpable::page {

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
    return {protocol::kVersion, 0, "test", "pointer", true, 1, protocol::kMostProbes, false, false};
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
    moved = pointer.probe;
    ++moves;
  }
  void lift(const protocol::Lift& probe) override {
    lifted += 1 << probe.probe;
    lifted.notify_all();
  }
  void change(const protocol::Change& change) override {
    ++commands;
    settings_.answers = change.serial;
    if (change.law == "proxy") {
      settings_.height_factor = change.height_factor;
    } else {
      notice_ = protocol::Notice{"warning", "there is no such law"};
    }
  }
  void edit(const protocol::Edit& edit) override {
    ++commands;
    settings_.answers = materials_.answers = edit.serial;
  }
  void save() override {
    ++commands;
    notice_ = protocol::Notice{"info", "saved"};
  }
  void pause(bool paused) override {
    ++commands;
    settings_.paused = paused;
  }
  void recentre() override { ++commands; }
  void move_explorer(const protocol::MoveExplorer&) override { ++commands; }
  std::optional<protocol::Robot> robot() override {
    if (!has_robot) return std::nullopt;
    protocol::Robot robot;
    robot.events = robot_stops;
    return robot;
  }
  std::optional<protocol::RobotFloor> robot_floor() override {
    if (!has_robot) return std::nullopt;
    protocol::RobotFloor floor;
    floor.x_m = 0.01 * ++floors;
    return floor;
  }
  std::optional<protocol::Head> head() override {
    if (!follows_head) return std::nullopt;
    protocol::Head head;
    head.pictures = "come";
    head.place = protocol::HeadPlace{0.01 * ++heads, 0.0, 0.6};
    return head;
  }
  void follow_head(const protocol::FollowHead& follow) override {
    down_deg = follow.down_deg;
    follows_head = follow.follows;
    follows_head.notify_all();
  }
  void order(const protocol::RobotOrder& order) override {
    ++(order.word == "stop" ? robot_stops : commands);
  }
  void let_go() override { ++robot_stops; }
  protocol::Words answer(const protocol::Ask& ask) override {
    asked = ask.probe;
    return {ask.serial, "words on " + ask.what, {}, {}};
  }
  protocol::Around around(const protocol::LookAround& question) override {
    return {question.serial, 1, {{0, "tall hill", "tall hill, here", {}, true, true}}};
  }
  void name(const protocol::Name& name) override {
    ++commands;
    notice_ = protocol::Notice{"answer", "Named: " + name.name};
  }
  void unname(const protocol::Unname&) override {
    ++commands;
    notice_ = protocol::Notice{"answer", "Deleted"};
  }
  void undo_name(const protocol::UndoName&) override {
    ++commands;
    notice_ = protocol::Notice{"answer", "Undone"};
  }
  void find(const protocol::Find&) override { ++commands; }
  std::optional<protocol::Notice> next_notice() override { return std::exchange(notice_, std::nullopt); }

  std::atomic<int> moves = 0;
  /// The last probe that was moved.
  std::atomic<std::int64_t> moved = -1;
  /// The probe of the last question.
  std::atomic<std::int64_t> asked = -1;
  /// Calls that change something other than places of probes.
  std::atomic<int> commands = 0;
  /// Before a page is opened.
  std::atomic<bool> has_robot = false;
  /// What pages told of following the viewer's head, and how many places they were told.
  std::atomic<bool> follows_head = false;
  std::atomic<double> down_deg = 0.0;
  std::atomic<int> heads = 0;
  /// How often its floor was asked for.
  std::atomic<int> floors = 0;
  /// Orders to stop it, and pages that drove it and let go.
  std::atomic<int> robot_stops = 0;
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

// Where a server of a test is reached.
struct ServedAddress {
  std::string own_origin() const { return "http://127.0.0.1:" + std::to_string(port); }

  std::string address;
  std::string token;
  std::uint16_t port = 0;
};

// A server on its own thread for the duration of a test.
class Served : public ServedAddress {
 public:
  Served(const Served&) = delete;
  Served& operator=(const Served&) = delete;

 protected:
  Served() = default;
  ~Served() { stop(); }
  // `run` is serve() or serve_shelf() with everything but the options and the flag that ends it.
  template <class Run>
  void start(ServeOptions options, Run run) {
    std::promise<std::string> ready;
    options.on_ready = [&](const std::string& where) { ready.set_value(where); };
    thread_ = std::thread([this, options, run] { result_ = run(options, stop_); });
    address = ready.get_future().get();
    const auto colon = address.rfind(':');
    const auto slash = address.find('/', colon);
    port = static_cast<std::uint16_t>(std::stoi(address.substr(colon + 1, slash - colon - 1)));
    token = address.substr(address.find('#') + 1);
  }
  // Before the members that the server uses are destroyed.
  void stop() {
    if (!thread_.joinable()) return;
    stop_ = true;
    thread_.join();
    EXPECT_TRUE(result_);
  }

 private:
  std::atomic<bool> stop_ = false;
  Result<void> result_;
  std::thread thread_;
};

class ServedPage : public Served {
 public:
  explicit ServedPage(const ServeOptions& options = {}) {
    start(options,
          [this](const ServeOptions& used, const std::atomic<bool>& end) { return serve(host, used, end); });
  }
  ~ServedPage() { stop(); }

  FakeHost host;
};

using Response = http::response<http::string_body>;

using Headers = std::vector<std::pair<http::field, std::string>>;

// Sends one request over a connected stream to a server at this port, and reads the answer.
template <class Stream>
Response exchange(Stream& stream, std::uint16_t port, http::verb method, const std::string& target,
                  const std::string& body, const Headers& headers) {
  http::request<http::string_body> request(method, target, 11);
  request.set(http::field::host, "127.0.0.1:" + std::to_string(port));
  for (const auto& [name, value] : headers)
    if (!value.empty()) request.set(name, value);
  request.body() = body;
  request.prepare_payload();
  http::write(stream, request);
  boost::beast::flat_buffer buffer;
  http::response_parser<http::string_body> parser;
  parser.skip(method == http::verb::head);
  http::read(stream, buffer, parser);
  return parser.release();
}

inline Response ask(const ServedAddress& page, http::verb method, const std::string& target,
                    const std::string& body = {}, const Headers& headers = {}) {
  boost::asio::io_context context;
  boost::beast::tcp_stream stream(context);
  stream.connect(tcp::endpoint(boost::asio::ip::address_v4::loopback(), page.port));
  return exchange(stream, page.port, method, target, body, headers);
}

// One HTTP connection that is kept open.
class HttpConnection {
 public:
  explicit HttpConnection(const ServedAddress& page) : host_("127.0.0.1:" + std::to_string(page.port)) {
    stream_.connect(tcp::endpoint(boost::asio::ip::address_v4::loopback(), page.port));
  }
  // The status of the answer.
  unsigned ask(http::verb method, const std::string& target, const std::string& cookie) {
    http::request<http::string_body> request(method, target, 11);
    request.set(http::field::host, host_);
    request.set(http::field::cookie, cookie);
    http::write(stream_, request);
    Response response;
    http::read(stream_, buffer_, response);
    return response.result_int();
  }

 private:
  std::string host_;
  boost::asio::io_context context_;
  boost::beast::tcp_stream stream_{context_};
  boost::beast::flat_buffer buffer_;
};

// What a browser sends to open a WebSocket.
inline Headers upgrade_headers(const std::string& cookie, const std::string& origin,
                               const std::string& host = {}) {
  return {{http::field::cookie, cookie},
          {http::field::origin, origin},
          {http::field::host, host},
          {http::field::connection, "Upgrade"},
          {http::field::upgrade, "websocket"},
          {http::field::sec_websocket_version, "13"},
          {http::field::sec_websocket_key, "dGhlIHNhbXBsZSBub25jZQ=="}};
}

// The status of the server's answer to a WebSocket request.
inline unsigned upgrade_status(const ServedAddress& page, const std::string& cookie,
                               const std::string& origin, const std::string& host = {}) {
  return ask(page, http::verb::get, "/socket", {}, upgrade_headers(cookie, origin, host)).result_int();
}

inline std::string cookie_of(const ServedAddress& page) {
  const Response response = ask(page, http::verb::post, "/session", page.token);
  EXPECT_EQ(response.result_int(), 204U);
  const std::string header(response[http::field::set_cookie]);
  return header.substr(0, header.find(';'));
}

// A minimal client in place of a page, over a plain or an encrypted connection.
template <class Stream>
class TestPageOver {
 public:
  void send(const std::string& text, bool binary = false) {
    socket_.binary(binary);
    boost::beast::error_code error;
    socket_.write(boost::asio::buffer(text), error);
    failed_ = failed_ || error;
  }
  void ping() {
    boost::beast::error_code error;
    socket_.ping({}, error);
    failed_ = failed_ || error;
  }
  bool failed() const { return failed_; }
  // The next frame; empty once the socket is closed, or after a minute without one.
  std::string read() {
    boost::beast::flat_buffer buffer;
    boost::beast::error_code error;
    socket_.read(buffer, error);
    return error ? std::string() : boost::beast::buffers_to_string(buffer.data());
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

 protected:
  // `more`: what a stream is made of besides the context.
  template <class... More>
  explicit TestPageOver(More&... more) : socket_(context_, more...) {}
  void handshake(const std::string& host, const std::string& origin, const std::string& cookie) {
    socket_.set_option(websocket::stream_base::decorator([=](websocket::request_type& request) {
      request.set(http::field::origin, origin);
      request.set(http::field::cookie, cookie);
    }));
    // A page that is told nothing ends its test instead of waiting for ever.
    timeval longest{};
    longest.tv_sec = 60;
    ::setsockopt(boost::beast::get_lowest_layer(socket_).native_handle(), SOL_SOCKET, SO_RCVTIMEO, &longest,
                 sizeof longest);
    socket_.handshake(host, "/socket");
  }
  Stream& stream() { return socket_.next_layer(); }

 private:
  boost::asio::io_context context_;
  websocket::stream<Stream> socket_;
  bool failed_ = false;
};

class TestPage : public TestPageOver<tcp::socket> {
 public:
  explicit TestPage(const ServedAddress& page) : TestPage(page, cookie_of(page)) {}
  TestPage(const ServedAddress& page, const std::string& cookie) {
    stream().connect(tcp::endpoint(boost::asio::ip::address_v4::loopback(), page.port));
    handshake("127.0.0.1:" + std::to_string(page.port), page.own_origin(), cookie);
  }
};

}  // namespace palpable::page
