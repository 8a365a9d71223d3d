// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/page/server.hpp"

#include "palpable/page/access.hpp"
#include "palpable/page/client.hpp"
#include "palpable/page/http.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <exception>
#include <optional>
#include <utility>

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/core/tcp_stream.hpp>
#include <boost/beast/http.hpp>

namespace palpable::page {
namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = boost::beast::http;
using tcp = boost::asio::ip::tcp;
using std::chrono::milliseconds;

constexpr std::size_t kLongestHeaderBytes = 8192;
// Enough for the page's mesh and sound; the state carries the exact height.
constexpr int kLongestHeightSide = 320;
constexpr int kLongestPictureSide = 1024;
constexpr auto kRestPeriod = std::chrono::seconds(1);

milliseconds whole_milliseconds(double seconds) {
  return milliseconds(static_cast<std::int64_t>(seconds * 1000.0));
}

std::string_view view(beast::string_view text) { return {text.data(), text.size()}; }

template <class Message>
SharedFrame text_frame(const Message& message) {
  return std::make_shared<const Frame>(Frame{protocol::write_message(message), false});
}

// Whether two states are equal for a person: within a micrometre and two millinewtons.
bool nearly_equal(const protocol::ProbeState& a, const protocol::ProbeState& b) {
  const auto near = [](double p, double q, double limit) { return std::abs(p - q) < limit; };
  return a.probe == b.probe && a.page == b.page && a.contact == b.contact && a.label == b.label &&
         near(a.x_m, b.x_m, 1e-6) && near(a.y_m, b.y_m, 1e-6) && near(a.z_m, b.z_m, 1e-6) &&
         near(a.surface_m, b.surface_m, 1e-6) && near(a.fx_N, b.fx_N, 2e-3) && near(a.fy_N, b.fy_N, 2e-3) &&
         near(a.fz_N, b.fz_N, 2e-3);
}

// The state that all connections share: request handler, host and open pages.
class Pages {
 public:
  Pages(PageHost& host, const ServeOptions& options, RequestHandler front)
      : host_(host), options_(options), handler_(std::move(front)) {}

  RequestHandler& handler() { return handler_; }
  const ServeOptions& options() const { return options_; }
  bool full() const { return clients_.size() >= options_.most_clients; }
  std::string full_sentence() const {
    return "This session is open in " + std::to_string(options_.most_clients) +
           " pages already, which is the limit: close one of them.";
  }
  std::size_t connections = 0;

  void add_client(beast::tcp_stream stream, const Client::Upgrade& upgrade) {
    Client::Events events;
    events.opened = [this](Client& client) { send_everything(client); };
    events.message = [this](Client& client, const protocol::FromPage& message) {
      std::visit([&](const auto& m) { handle(client, m); }, message);
    };
    events.closed = [this](Client& client) {
      release_probes(client);
      std::erase_if(clients_,
                    [&](const auto& other) { return other.expired() || other.lock().get() == &client; });
    };
    auto client = std::make_shared<Client>(std::move(stream), options_.rate, options_.longest_message_bytes,
                                           whole_milliseconds(options_.idle_timeout_s), std::move(events));
    client->page = next_page_++;
    clients_.push_back(client);
    client->accept(upgrade);
  }

  // Called 60 times per second: sends changes to all pages.
  void update() {
    while (const auto notice = host_.next_notice()) broadcast(text_frame(*notice));
    if (clients_.empty()) return;
    host_.update();
    if (const auto scene = host_.scene(); scene != shown_) {
      show(scene);
      broadcast(text_frame(host_.laws()));
      for (const auto& frame : scene_frames_) broadcast(frame);
    }
    if (const auto settings = host_.settings(); settings != sent_settings_) {
      sent_settings_ = settings;
      broadcast(text_frame(settings));
    }
    if (auto materials = host_.materials(); materials != sent_materials_) {
      sent_materials_ = std::move(materials);
      broadcast(text_frame(sent_materials_));
    }
    send_state();
  }

  void close_all() {
    for_each_client([](Client& client) {
      client.close(beast::websocket::close_code::going_away, "the session has ended");
    });
  }

 private:
  // Once per second at rest; otherwise each time, to the pages that keep up.
  void send_state() {
    protocol::State state = host_.state();
    for (auto& probe : state.probes) probe.page = movers_.at(static_cast<std::size_t>(probe.probe));
    const auto now = std::chrono::steady_clock::now();
    const bool changed = !std::equal(state.probes.begin(), state.probes.end(), sent_probes_.begin(),
                                     sent_probes_.end(), nearly_equal) ||
                         now - sent_state_at_ >= kRestPeriod;
    const auto frame = text_frame(state);
    for_each_client([&](Client& client) {
      if (client.visible && (changed || client.is_behind)) client.is_behind = !client.send_if_idle(frame);
    });
    if (!changed) return;
    sent_probes_ = std::move(state.probes);
    sent_state_at_ = now;
  }

  // Removes the additional probes that this page moved; the first probe stays.
  void release_probes(const Client& client) {
    for (std::size_t probe = 1; probe < client.moved.size(); ++probe)
      if (client.moved.test(probe)) host_.lift({static_cast<std::int64_t>(probe)});
    for (auto& mover : movers_)
      if (mover == client.page) mover.reset();
  }

  void send_everything(Client& client) {
    auto hello = host_.hello();
    hello.page = client.page;
    client.send(text_frame(hello));
    client.send(text_frame(host_.laws()));
    if (const auto scene = host_.scene(); scene != shown_) show(scene);
    for (const auto& frame : scene_frames_) client.send(frame);
    sent_settings_ = host_.settings();
    client.send(text_frame(sent_settings_));
    sent_materials_ = host_.materials();
    client.send(text_frame(sent_materials_));
  }

  void show(const std::shared_ptr<const PageScene>& scene) {
    shown_ = scene;
    const auto number = static_cast<std::uint32_t>(scene->about.scene);
    const auto binary = [](std::string bytes) {
      return std::make_shared<const Frame>(Frame{std::move(bytes), true});
    };
    scene_frames_ = {
        text_frame(scene->about),
        binary(protocol::write_heights(number, protocol::thinned(scene->height_m, kLongestHeightSide)))};
    const auto push = [&](protocol::RasterKind kind, const Raster<Rgb8>& picture) {
      scene_frames_.push_back(
          binary(protocol::write_picture(kind, number, protocol::thinned(picture, kLongestPictureSide))));
    };
    if (scene->about.has_picture) push(protocol::RasterKind::picture, scene->picture);
    if (scene->about.cells) push(protocol::RasterKind::cells, scene->cells);
  }

  // Iterates over a copy, since a disconnected client is removed from the list.
  template <class Do>
  void for_each_client(Do act) {
    const auto clients = clients_;
    for (const auto& weak : clients)
      if (const auto client = weak.lock()) act(*client);
  }

  void broadcast(const SharedFrame& frame) {
    for_each_client([&](Client& client) { client.send(frame); });
  }

  void handle(Client& client, const protocol::Pointer& pointer) {
    const auto probe = static_cast<std::size_t>(pointer.probe);
    client.moved.set(probe);
    if (probe > 0 || host_.hello().pointer_moves) movers_.at(probe) = client.page;
    host_.move(pointer);
  }
  void handle(Client& client, const protocol::Lift& probe) {
    client.moved.reset(static_cast<std::size_t>(probe.probe));
    movers_.at(static_cast<std::size_t>(probe.probe)).reset();
    host_.lift(probe);
  }
  void handle(Client&, const protocol::Change& change) { host_.change(change); }
  void handle(Client&, const protocol::Edit& edit) { host_.edit(edit); }
  void handle(Client&, const protocol::Save&) { host_.save(); }
  void handle(Client&, const protocol::Pause& pause) { host_.pause(pause.paused); }
  void handle(Client&, const protocol::Recentre&) { host_.recentre(); }
  void handle(Client&, const protocol::Stand& stand) { host_.stand(stand); }
  void handle(Client& client, const protocol::Ask& ask) {
    client.send(text_frame(protocol::Words{ask.serial, host_.answer(ask)}));
  }
  void handle(Client& client, const protocol::Visible& visible) {
    client.visible = visible.visible;
    client.is_behind = true;
  }

  PageHost& host_;
  const ServeOptions& options_;
  RequestHandler handler_;
  // Weak: a client lives as long as operations on its socket are pending, and never longer than the I/O
  // context.
  std::vector<std::weak_ptr<Client>> clients_;
  std::shared_ptr<const PageScene> shown_;
  std::vector<SharedFrame> scene_frames_;
  protocol::Settings sent_settings_;
  protocol::Materials sent_materials_;
  std::vector<protocol::ProbeState> sent_probes_;
  std::chrono::steady_clock::time_point sent_state_at_;
  std::int64_t next_page_ = 1;
  /// The page that last moved each probe.
  std::array<std::optional<std::int64_t>, protocol::kMostProbes> movers_;
};

// One HTTP connection, until it is closed or becomes a client.
class Connection : public std::enable_shared_from_this<Connection> {
 public:
  Connection(tcp::socket socket, Pages& pages) : stream_(std::move(socket)), pages_(pages) {
    ++pages_.connections;
  }
  Connection(const Connection&) = delete;
  Connection& operator=(const Connection&) = delete;
  ~Connection() { --pages_.connections; }

  void read() {
    parser_.emplace();
    parser_->header_limit(kLongestHeaderBytes);
    parser_->body_limit(pages_.options().longest_message_bytes);
    stream_.expires_after(whole_milliseconds(pages_.options().idle_timeout_s));
    http::async_read(
        stream_, buffer_, *parser_,
        [self = shared_from_this()](beast::error_code error, std::size_t) { self->on_read(error); });
  }

 private:
  void on_read(beast::error_code error) {
    if (error == http::error::end_of_stream || error == asio::error::operation_aborted) return close();
    if (error == http::error::body_limit)
      return write({413, "text/plain", "The request is too long.", {}}, false);
    if (error == http::error::header_limit)
      return write({431, "text/plain", "The request is too long.", {}}, false);
    if (error.category() == http::make_error_code(http::error::bad_method).category())
      return write({400, "text/plain", "The request is not HTTP.", {}}, false);
    if (error) return close();
    respond(parser_->get());
  }

  void respond(const Client::Upgrade& message) {
    const Request request{view(message.method_string()),      view(message.target()),
                          view(message[http::field::host]),   view(message[http::field::origin]),
                          view(message[http::field::cookie]), message.body()};
    if (!beast::websocket::is_upgrade(message)) {
      Reply reply = pages_.handler().answer(request);
      if (request.target == kSessionPath && reply.status == 204 && pages_.full()) {
        reply.status = 503;
        reply.body = pages_.full_sentence();
      }
      return write(reply, message.keep_alive());
    }
    const Reply reply = pages_.handler().check_upgrade(request);
    if (reply.status != 101) return write(reply, false);
    if (pages_.full()) return write({503, "text/plain", pages_.full_sentence(), {}}, false);
    pages_.add_client(std::move(stream_), message);
  }

  void write(const Reply& reply, bool keep_alive) {
    const bool head = parser_->get().method() == http::verb::head;
    response_ = {};
    response_.result(reply.status);
    response_.version(11);
    for (const auto& header : kSafetyHeaders) response_.set(header.name, header.value);
    if (!reply.body.empty()) response_.set(http::field::content_type, reply.media_type);
    if (!reply.set_cookie.empty()) response_.set(http::field::set_cookie, reply.set_cookie);
    response_.keep_alive(keep_alive);
    response_.body() = reply.body;
    response_.prepare_payload();
    if (head) response_.body().clear();
    http::async_write(stream_, response_,
                      [self = shared_from_this(), keep_alive](beast::error_code error, std::size_t) {
                        if (error || !keep_alive) return self->close();
                        self->read();
                      });
  }

  void close() {
    beast::error_code ignored;
    stream_.socket().shutdown(tcp::socket::shutdown_send, ignored);
  }

  beast::tcp_stream stream_;
  Pages& pages_;
  beast::flat_buffer buffer_{kLongestHeaderBytes + 65536};
  std::optional<http::request_parser<http::string_body>> parser_;
  http::response<http::string_body> response_;
};

void accept_next(tcp::acceptor& acceptor, Pages& pages) {
  acceptor.async_accept([&](beast::error_code error, tcp::socket socket) {
    if (error == asio::error::operation_aborted) return;
    // Connections beyond the limit, and failed ones, are dropped at once.
    if (!error && pages.connections < pages.options().most_connections)
      std::make_shared<Connection>(std::move(socket), pages)->read();
    accept_next(acceptor, pages);
  });
}

void update_next(asio::steady_timer& timer, Pages& pages, std::chrono::microseconds period) {
  // Relative to now, not to the due time: after a stall, frames are skipped.
  timer.expires_after(period);
  timer.async_wait([&timer, &pages, period](beast::error_code error) {
    if (error) return;
    pages.update();
    update_next(timer, pages, period);
  });
}

Result<void> open(tcp::acceptor& acceptor, std::uint16_t port) {
  const tcp::endpoint where(asio::ip::address_v4::loopback(), port);
  beast::error_code error;
  acceptor.open(where.protocol(), error);
  if (!error) acceptor.set_option(asio::socket_base::reuse_address(true), error);
  if (!error) acceptor.bind(where, error);
  if (!error) acceptor.listen(16, error);
  if (!error) return {};
  const std::string place = "port " + std::to_string(port);
  if (error == asio::error::address_in_use)
    return Error{ErrorCode::failed, "in use by another program", place, Reason::port_in_use};
  return Error{ErrorCode::failed, "cannot serve the page there (" + error.message() + ")", place};
}

Result<void> run(PageHost& host, const ServeOptions& options, const std::atomic<bool>& stop) {
  const auto token = random_secret();
  if (!token) return token.error();
  const auto secret = random_secret();
  if (!secret) return secret.error();

  std::optional<Pages> pages;  // outlives the context, whose pending operations refer to it
  asio::io_context context(1);
  tcp::acceptor acceptor(context);
  if (auto opened = open(acceptor, options.port); !opened) return opened;
  const std::uint16_t port = acceptor.local_endpoint().port();
  pages.emplace(host, options, RequestHandler(SessionAccess(*token, *secret), port));
  asio::steady_timer timer(context);
  accept_next(acceptor, *pages);
  update_next(timer, *pages,
              std::chrono::microseconds(static_cast<std::int64_t>(1e6 / options.states_per_s)));
  if (options.on_ready) options.on_ready("http://127.0.0.1:" + std::to_string(port) + "/#" + *token);

  while (!stop.load()) context.run_for(milliseconds(50));
  timer.cancel();
  beast::error_code ignored;
  acceptor.close(ignored);
  pages->close_all();
  context.run_for(milliseconds(100));
  return {};
}

}  // namespace

Result<void> serve(PageHost& host, const ServeOptions& options, const std::atomic<bool>& stop) {
  try {
    return run(host, options, stop);
  } catch (const std::exception& e) {
    return Error{ErrorCode::failed, std::string("the page's server stopped: ") + e.what(), {}};
  }
}

}  // namespace palpable::page
