// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/page/server.hpp"

#include "palpable/page/access.hpp"
#include "palpable/page/channel.hpp"
#include "palpable/page/connection.hpp"
#include "palpable/page/http.hpp"
#include "palpable/page/pages.hpp"

#include <algorithm>
#include <exception>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/steady_timer.hpp>

namespace palpable::page {
namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
using tcp = boost::asio::ip::tcp;
using std::chrono::milliseconds;

std::chrono::microseconds period_of(double per_s) {
  return std::chrono::microseconds(static_cast<std::int64_t>(1e6 / per_s));
}

/// What is served: the pages of one touch, or a home page and the touches that it leads to.
struct Served {
  std::shared_ptr<PageHost> touch;
  ShelfHost* shelf = nullptr;
};

// Updates the shelf, the sharing, then the pages, at a steady rate: slowly at rest, and at once when a page
// sends something.
class Updates {
 public:
  Updates(asio::io_context& context, const ServeOptions& options, ShelfHost* shelf)
      : timer_(context),
        period_(period_of(options.states_per_s)),
        rest_period_(period_of(options.rest_updates_per_s)),
        shelf_(shelf),
        share_(options.share) {}

  void start(Pages& pages) {
    pages_ = &pages;
    wait();
  }
  void hasten() {
    if (resting_) timer_.cancel();
  }
  void stop() {
    stopped_ = true;
    timer_.cancel();
  }

 private:
  void wait() {
    resting_ = pages_->is_at_rest();
    // Relative to now, not to the due time: after a stall, frames are skipped.
    timer_.expires_after(resting_ ? rest_period_ : period_);
    timer_.async_wait([this](beast::error_code) {
      if (stopped_) return;
      if (shelf_ != nullptr) {
        shelf_->update();
        pages_->show(shelf_->touch());
      }
      if (share_ != nullptr) share_->update();
      pages_->update();
      wait();
    });
  }

  asio::steady_timer timer_;
  std::chrono::microseconds period_;
  std::chrono::microseconds rest_period_;
  ShelfHost* shelf_;
  ShareHost* share_;
  Pages* pages_ = nullptr;
  bool resting_ = false;
  bool stopped_ = false;
};

void accept_next(tcp::acceptor& acceptor, Connections& connections, ServerContext& shared) {
  acceptor.async_accept([&](beast::error_code error, tcp::socket socket) {
    if (error == asio::error::operation_aborted) return;
    if (!error) connections.add(std::move(socket), shared);
    accept_next(acceptor, connections, shared);
  });
}

Result<void> open(tcp::acceptor& acceptor, const asio::ip::address& address, std::uint16_t port) {
  const tcp::endpoint where(address, port);
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

using Acceptors = std::vector<std::unique_ptr<tcp::acceptor>>;

/// The second port, for guests (docs/adr/0009). It outlives the context, but for the acceptors.
struct GuestPort {
  std::unique_ptr<asio::ssl::context> tls;
  std::optional<ServerContext> shared;
  std::optional<Connections> connections;
};

/// Opens one port at all addresses, the first of which must open: an address of version 6 may not be ready.
Result<Acceptors> open_at(asio::io_context& context, const std::vector<std::string>& addresses,
                          std::uint16_t port) {
  Acceptors acceptors;
  for (const std::string& text : addresses) {
    beast::error_code error;
    const auto address = asio::ip::make_address(text, error);
    if (error) return invalid_input("is not an IP address of this computer", text);
    auto acceptor = std::make_unique<tcp::acceptor>(context);
    if (auto opened = open(*acceptor, address, port); !opened) {
      if (acceptors.empty()) return opened.error();
      break;
    }
    port = acceptor->local_endpoint().port();
    acceptors.push_back(std::move(acceptor));
  }
  return acceptors;
}

/// Begins to serve guests.
Result<void> open_for_guests(GuestPort& guests, asio::io_context& context, Acceptors& acceptors, Pages& pages,
                             const ServeOptions& options, const protocol::Hello& hello) {
  ShareHost& share = *options.share;
  auto tls = tls_context(share.certificate());
  if (!tls) return tls.error();
  guests.tls = *std::move(tls);
  auto opened = open_at(context, share.addresses(), share.port());
  if (!opened) return opened.error();
  acceptors = *std::move(opened);
  const std::uint16_t port = acceptors.front()->local_endpoint().port();
  guests.shared.emplace(ServerContext{RequestHandler(share, port), pages, nullptr, options, RateLimit({}),
                                      &share, guests.tls.get(), RateLimit(options.handshake_rate)});
  guests.connections.emplace(options.most_guest_connections, options.most_connections_of_an_address);
  // The last probe answers the questions of those who look.
  share.begin(port, acceptors.size(), std::max<std::int64_t>(1, hello.hands), hello.probes - 2);
  for (const auto& acceptor : acceptors) accept_next(*acceptor, *guests.connections, *guests.shared);
  return {};
}

Result<void> run(const Served& served, const ServeOptions& options, const std::atomic<bool>& stop) {
  const auto token = random_secret();
  if (!token) return token.error();
  const auto secret = random_secret();
  if (!secret) return secret.error();

  // What outlives the context, whose pending operations refer to it.
  std::optional<Pages> pages;
  std::optional<ServerContext> shared;
  Connections connections(options.most_connections, options.most_connections);
  GuestPort guests;

  asio::io_context context(1);
  tcp::acceptor acceptor(context);
  Acceptors guest_acceptors;
  if (auto opened = open(acceptor, asio::ip::address_v4::loopback(), options.port); !opened) return opened;
  const std::uint16_t port = acceptor.local_endpoint().port();
  Updates updates(context, options, served.shelf);
  pages.emplace(options, [&updates] { updates.hasten(); });
  pages->show(served.touch);
  shared.emplace(ServerContext{RequestHandler(SessionAccess(*token, *secret), port, served.shelf), *pages,
                               served.shelf, options, RateLimit(options.upgrade_rate), nullptr, nullptr,
                               RateLimit({})});
  if (options.share != nullptr && served.touch != nullptr)
    if (auto opened =
            open_for_guests(guests, context, guest_acceptors, *pages, options, served.touch->hello());
        !opened)
      return opened;
  accept_next(acceptor, connections, *shared);
  updates.start(*pages);
  if (options.on_ready) options.on_ready("http://127.0.0.1:" + std::to_string(port) + "/#" + *token);

  while (!stop.load()) context.run_for(milliseconds(50));
  updates.stop();
  beast::error_code ignored;
  acceptor.close(ignored);
  for (const auto& one : guest_acceptors) one->close(ignored);
  pages->close_all();
  context.run_for(milliseconds(100));
  return {};
}

Result<void> run_guarded(const Served& served, const ServeOptions& options, const std::atomic<bool>& stop) {
  try {
    return run(served, options, stop);
  } catch (const std::exception& e) {
    return Error{ErrorCode::failed, std::string("the page's server stopped: ") + e.what(), {}};
  }
}

}  // namespace

Result<void> serve(PageHost& host, const ServeOptions& options, const std::atomic<bool>& stop) {
  // It belongs to the caller.
  return run_guarded({std::shared_ptr<PageHost>(std::shared_ptr<void>(), &host)}, options, stop);
}

Result<void> serve_shelf(ShelfHost& shelf, const ServeOptions& options, const std::atomic<bool>& stop) {
  return run_guarded({nullptr, &shelf}, options, stop);
}

}  // namespace palpable::page
