// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

// What the tests of a shared touch use: a server that shares the touch at loopback with a clock of the test,
// and guests that verify its certificate.

#include "palpable/page/share/sharing.hpp"
#include "palpable/page/test_page.hpp"

#include <atomic>
#include <condition_variable>
#include <deque>
#include <memory>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include <boost/asio/ssl.hpp>
#include <boost/beast/websocket/ssl.hpp>
#include <gtest/gtest.h>

namespace palpable::page {

namespace ssl = boost::asio::ssl;

// The links that a server has made, in their order.
class Links {
 public:
  void put(std::string link) {
    const std::lock_guard lock(mutex_);
    links_.push_back(std::move(link));
    came_.notify_all();
  }
  std::string take() {
    std::unique_lock lock(mutex_);
    came_.wait(lock, [&] { return !links_.empty(); });
    auto link = std::move(links_.front());
    links_.pop_front();
    return link;
  }

 private:
  std::mutex mutex_;
  std::condition_variable came_;
  std::deque<std::string> links_;
};

class SharedPage {
 public:
  explicit SharedPage(ServeOptions options = {}, std::size_t places = 8,
                      const std::vector<std::string>& addresses = {"127.0.0.1"})
      : sharing_(opened(places, addresses)), page((options.share = sharing_.get(), options)) {
    const std::string link = links_.take();
    const auto slash = link.rfind('/');
    const auto colon = link.rfind(':');
    guests.port = static_cast<std::uint16_t>(std::stoi(link.substr(colon + 1, slash - colon - 1)));
    token = token_of(link);
    trust.add_certificate_authority(boost::asio::buffer(sharing_->certificate().certificate));
    trust.set_verify_mode(ssl::verify_peer);
    X509_VERIFY_PARAM_set1_ip_asc(SSL_CTX_get0_param(trust.native_handle()), "127.0.0.1");
  }

  static std::string token_of(const std::string& link) { return link.substr(link.find('#') + 1); }
  // The token of the next link, which a page of this machine has asked for.
  std::string next_token() { return token_of(links_.take()); }
  std::string origin() const { return "https://127.0.0.1:" + std::to_string(guests.port); }
  const std::string& fingerprint() const { return sharing_->certificate().fingerprint; }

  Response ask_as_guest(http::verb method, const std::string& target, const std::string& body = {},
                        const Headers& headers = {}) {
    boost::asio::io_context context;
    ssl::stream<tcp::socket> stream(context, trust);
    stream.next_layer().connect(tcp::endpoint(boost::asio::ip::address_v4::loopback(), guests.port));
    stream.handshake(ssl::stream_base::client);
    return exchange(stream, guests.port, method, target, body, headers);
  }
  // The same at loopback of version 6, whose certificate is checked too.
  unsigned status_over_version_6(http::verb method, const std::string& target, const std::string& body,
                                 const std::string& host, const std::string& origin) {
    X509_VERIFY_PARAM_set1_ip_asc(SSL_CTX_get0_param(trust.native_handle()), "::1");
    boost::asio::io_context context;
    ssl::stream<tcp::socket> stream(context, trust);
    stream.next_layer().connect(tcp::endpoint(boost::asio::ip::address_v6::loopback(), guests.port));
    stream.handshake(ssl::stream_base::client);
    return exchange(stream, guests.port, method, target, body,
                    {{http::field::host, host}, {http::field::origin, origin}})
        .result_int();
  }
  // Uses a link; the cookie, or the empty string and the reason in `refusal`.
  std::string join(const std::string& with) {
    const Response response = ask_as_guest(http::verb::post, "/session", with,
                                           {{http::field::user_agent, "Mozilla/5.0 (iPhone) Mobile"}});
    refusal = response.body();
    const std::string header(response[http::field::set_cookie]);
    return header.substr(0, header.find(';'));
  }
  unsigned upgrade_status_of_guest(const std::string& cookie, const std::string& origin,
                                   const std::string& host = {}) {
    return ask_as_guest(http::verb::get, "/socket", {}, upgrade_headers(cookie, origin, host)).result_int();
  }

 private:
  std::unique_ptr<Sharing> opened(std::size_t places, const std::vector<std::string>& addresses) {
    Sharing::Options options;
    options.addresses = addresses;
    options.places = places;
    options.now_s = [this] { return now_s.load(); };
    options.on_link = [this](const protocol::Invitation& link, const std::string&) {
      other_link = link.other_link.value_or(std::string());
      links_.put(link.link);
    };
    auto made = Sharing::open(std::move(options));
    EXPECT_TRUE(made);
    return std::move(made).value();
  }

  Links links_;

 public:
  /// The newest link at the second address; read it after its link was taken.
  std::string other_link;
  std::atomic<double> now_s = 1000.0;

 private:
  std::unique_ptr<Sharing> sharing_;

 public:
  ServedPage page;
  ServedAddress guests;
  /// Of the first link.
  std::string token;
  std::string refusal;
  ssl::context trust{ssl::context::tls_client};
};

// A guest's page.
class GuestPage : public TestPageOver<ssl::stream<tcp::socket>> {
 public:
  GuestPage(SharedPage& shared, const std::string& cookie) : TestPageOver(shared.trust) {
    stream().next_layer().connect(tcp::endpoint(boost::asio::ip::address_v4::loopback(), shared.guests.port));
    stream().handshake(ssl::stream_base::client);
    handshake("127.0.0.1:" + std::to_string(shared.guests.port), shared.origin(), cookie);
  }
};

}  // namespace palpable::page
