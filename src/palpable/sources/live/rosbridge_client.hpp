// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/net/web_socket.hpp"
#include "palpable/core/result.hpp"
#include "palpable/sources/live/rosbridge_message.hpp"

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

namespace palpable::sources {

/// What is published: a topic and the type of its messages, in ROS' packages.
struct RosPublication {
  std::string topic;
  std::string package;
  std::string type;
};

struct RosbridgeOptions {
  std::string host;
  std::string port = "9090";
  /// Topics that are subscribed to, without a type: the server knows it.
  std::vector<std::string> topics;
  /// Of these topics (places in the list) every message is kept until it is taken, and not the newest alone:
  /// parts of a sound. At most kMostKept, then the oldest are lost.
  std::vector<std::size_t> kept_whole;
  /// Of these topics (places in the list) nothing is asked for until subscribe_to().
  std::vector<std::size_t> on_demand;
  std::vector<RosPublication> publications;
  /// The connection counts as lost if nothing comes for this time.
  std::chrono::milliseconds silence{5000};
  /// How long after a loss the server is tried again; the first time at once, if messages had come.
  std::chrono::milliseconds retry{1000};
  /// More messages in one second end the connection.
  int most_per_s = 2000;
};

/// A client of a rosbridge server (protocol 2.0, JSON over a WebSocket, without TLS and authentication). It
/// keeps the newest message of each topic; a server that is lost is tried again. Any thread.
class RosbridgeClient {
 public:
  using Clock = std::chrono::steady_clock;
  static constexpr std::size_t kMostKept = 100;
  struct Newest {
    /// Counted from 0 with every message of the topic, also those that nobody took.
    std::uint64_t number = 0;
    Clock::time_point arrival;
    RosMessage message;
  };

  /// Connects within two seconds each, the look-up of the name not counted. Errors (invalid_input), with the
  /// address as the place: nobody listens there, no answer in time, no WebSocket.
  static Result<std::unique_ptr<RosbridgeClient>> open(RosbridgeOptions options);
  ~RosbridgeClient();
  RosbridgeClient(const RosbridgeClient&) = delete;
  RosbridgeClient& operator=(const RosbridgeClient&) = delete;

  /// The newest message of topic `k` of the options that was not taken; of one that is kept whole, the
  /// oldest.
  std::optional<Newest> take(std::size_t k);
  /// As take(); waits for one until `deadline`. Errors: why the server was lost before its first message of
  /// any topic.
  Result<std::optional<Newest>> wait(std::size_t k, Clock::time_point deadline);
  /// Asks for the messages of topic `k`, one of RosbridgeOptions::on_demand, also after a loss of the
  /// connection, until unsubscribe_from(). What came before is forgotten.
  void subscribe_to(std::size_t k);
  void unsubscribe_from(std::size_t k);
  /// Sends a message (JSON) of publication `k`. False if it is not sent: the connection is lost, or earlier
  /// messages still wait for it.
  bool publish(std::size_t k, const std::string& message);
  bool is_connected() const;
  /// How often the connection was lost: tells of a loss between two calls of is_connected().
  std::uint64_t losses() const;
  /// Once for each loss, a sentence that says why.
  std::optional<std::string> loss();
  /// Another sentence for the user, if there is a new one: an error that the server states, or the first
  /// message that cannot be used.
  std::optional<std::string> notice();
  /// "ros://HOST:PORT".
  const std::string& name() const { return name_; }

 private:
  explicit RosbridgeClient(RosbridgeOptions options);
  Result<std::shared_ptr<WebSocket>> connect() const;
  void subscribe(WebSocket& socket) const;
  std::string subscription(std::size_t k) const;
  void run(std::shared_ptr<WebSocket> socket);
  Error follow(WebSocket& socket);
  void take_in(const std::string& text);
  void keep(RosMessage message, Clock::time_point arrival);
  bool lose(Error error);
  std::optional<Newest> take_locked(std::size_t k);
  void refuse(const Error& error);

  RosbridgeOptions options_;
  std::string name_;
  std::atomic<bool> ending_{false};
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  /// Null while the server is lost.
  std::shared_ptr<WebSocket> socket_;
  /// Which publications were advertised over this connection.
  std::vector<bool> advertised_;
  RosVersion version_ = RosVersion::unknown;
  /// Of each topic.
  std::vector<std::deque<Newest>> untaken_;
  /// Whether its messages are asked for.
  std::vector<bool> wanted_;
  /// How many of them are kept.
  std::vector<std::size_t> most_;
  std::vector<std::uint64_t> count_;
  std::uint64_t losses_ = 0;
  bool came_ = false;
  /// A message came since the last loss.
  bool is_here_ = false;
  bool has_refused_ = false;
  bool has_stated_ = false;
  std::optional<Error> lost_;
  std::optional<std::string> unsaid_loss_;
  std::optional<std::string> unsaid_notice_;
  std::thread thread_;
};

}  // namespace palpable::sources
