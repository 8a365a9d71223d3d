// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sources/live/rosbridge_client.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace palpable::sources {
namespace {

using std::chrono::milliseconds;

std::string rosbridge_text(const nlohmann::json& message) {
  return message.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

/// "geometry_msgs/msg/Twist" of ROS 2; of ROS 1, whose names ROS 2's server takes too, without "msg".
std::string type_name(const RosPublication& publication, RosVersion version) {
  const char* between = version == RosVersion::ros2 ? "/msg/" : "/";
  return publication.package + between + publication.type;
}

/// Counts events, and says when there were too many in a second.
class SecondCounter {
 public:
  explicit SecondCounter(int most) : most_(most) {}
  bool is_too_many(RosbridgeClient::Clock::time_point now) {
    if (now - begin_ > std::chrono::seconds(1)) {
      begin_ = now;
      count_ = 0;
    }
    return ++count_ > most_;
  }

 private:
  int most_;
  int count_ = 0;
  RosbridgeClient::Clock::time_point begin_{};
};

}  // namespace

RosbridgeClient::RosbridgeClient(RosbridgeOptions options)
    : options_(std::move(options)),
      name_("ros://" + options_.host + ":" + options_.port),
      advertised_(options_.publications.size(), false),
      untaken_(options_.topics.size()),
      wanted_(options_.topics.size(), true),
      most_(options_.topics.size(), 1),
      count_(options_.topics.size(), 0) {
  for (const std::size_t k : options_.kept_whole) most_[k] = kMostKept;
  for (const std::size_t k : options_.on_demand) wanted_[k] = false;
}

Result<std::unique_ptr<RosbridgeClient>> RosbridgeClient::open(RosbridgeOptions options) {
  std::unique_ptr<RosbridgeClient> client(new RosbridgeClient(std::move(options)));
  auto socket = client->connect();
  if (!socket) return std::move(socket).error();
  client->socket_ = *socket;
  client->thread_ =
      std::thread([raw = client.get(), first = *std::move(socket)]() mutable { raw->run(std::move(first)); });
  return client;
}

RosbridgeClient::~RosbridgeClient() {
  {
    const std::lock_guard lock(mutex_);
    ending_ = true;
  }
  changed_.notify_all();
  if (thread_.joinable()) thread_.join();
}

/// Connects and subscribes.
Result<std::shared_ptr<WebSocket>> RosbridgeClient::connect() const {
  constexpr milliseconds kLongest{2000};
  auto socket =
      WebSocket::connect(options_.host, options_.port, kLongest, {kLongestRosMessage, std::size_t{1} << 16U});
  if (!socket) return invalid_input("cannot be reached: " + socket.error().message, name_);
  subscribe(**socket);
  return std::shared_ptr<WebSocket>(*std::move(socket));
}

/// To the topics of which nothing has come.
void RosbridgeClient::subscribe(WebSocket& socket) const {
  const std::lock_guard lock(mutex_);
  for (std::size_t k = 0; k < options_.topics.size(); ++k) {
    if (!wanted_[k] || (socket_ != nullptr && count_[k] > 0)) continue;
    socket.send(subscription(k));
  }
}

std::string RosbridgeClient::subscription(std::size_t k) const {
  const std::string& topic = options_.topics[k];
  return rosbridge_text(
      {{"op", "subscribe"}, {"id", "palpable:" + topic}, {"topic", topic}, {"queue_length", most_[k]}});
}

void RosbridgeClient::subscribe_to(std::size_t k) {
  const std::lock_guard lock(mutex_);
  wanted_[k] = true;
  untaken_[k].clear();
  if (socket_) socket_->send(subscription(k));
}

void RosbridgeClient::unsubscribe_from(std::size_t k) {
  const std::lock_guard lock(mutex_);
  wanted_[k] = false;
  untaken_[k].clear();
  const std::string& topic = options_.topics[k];
  if (socket_)
    socket_->send(rosbridge_text({{"op", "unsubscribe"}, {"id", "palpable:" + topic}, {"topic", topic}}));
}

void RosbridgeClient::run(std::shared_ptr<WebSocket> socket) {
  // At once after a connection that was of use, so that a robot's stop reaches it; then in its time.
  constexpr milliseconds kAtOnce{10};
  while (!ending_) {
    milliseconds pause = options_.retry;
    if (socket) {
      Error error = follow(*socket);
      // What was published last, such as a robot's stop, still leaves.
      constexpr milliseconds kLeaving{50};
      socket->close(kLeaving);
      if (!ending_ && lose(std::move(error))) pause = kAtOnce;
    }
    socket.reset();
    std::unique_lock lock(mutex_);
    if (changed_.wait_for(lock, pause, [&] { return ending_.load(); })) return;
    lock.unlock();
    if (auto again = connect()) {
      socket = *std::move(again);
      const std::lock_guard guard(mutex_);
      socket_ = socket;
    }
  }
}

/// Why the connection was lost.
Error RosbridgeClient::follow(WebSocket& socket) {
  constexpr milliseconds kPatience{20};
  SecondCounter counter(options_.most_per_s);
  // A server refuses a topic that nobody has announced yet.
  constexpr std::chrono::seconds kAgain{2};
  auto last = Clock::now();
  auto subscribed = last;
  while (!ending_) {
    auto text = socket.receive(Clock::now() + kPatience);
    if (!text) return std::move(text).error();
    const auto now = Clock::now();
    if (now - subscribed > kAgain) {
      subscribe(socket);
      subscribed = now;
    }
    if (*text) {
      last = now;
      if (counter.is_too_many(now))
        return invalid_input(fmt::format("sends more than {} messages a second", options_.most_per_s));
      take_in(**text);
    } else if (now - last > options_.silence) {
      return invalid_input(
          fmt::format("has sent nothing for {:.1f} s", std::chrono::duration<double>(now - last).count()));
    }
  }
  return {};
}

void RosbridgeClient::take_in(const std::string& text) {
  const auto arrival = Clock::now();
  auto heard = parse_rosbridge(text);
  if (!heard) return refuse(heard.error());
  if (auto* message = std::get_if<RosMessage>(&*heard)) return keep(std::move(*message), arrival);
  const auto& status = std::get<RosStatus>(*heard);
  if (!status.is_error || status.words.empty()) return;
  const std::lock_guard lock(mutex_);
  if (!std::exchange(has_stated_, true))
    unsaid_notice_ = fmt::format("The server {} says: {}", name_, status.words);
}

void RosbridgeClient::keep(RosMessage message, Clock::time_point arrival) {
  const auto found = std::find(options_.topics.begin(), options_.topics.end(), message.topic);
  if (found == options_.topics.end()) return refuse(invalid_input("sends a topic that was not asked for"));
  const auto k = static_cast<std::size_t>(found - options_.topics.begin());
  {
    const std::lock_guard lock(mutex_);
    if (message.version != RosVersion::unknown) version_ = message.version;
    untaken_[k].push_back({count_[k]++, arrival, std::move(message)});
    if (untaken_[k].size() > most_[k]) untaken_[k].pop_front();
    came_ = is_here_ = true;
  }
  changed_.notify_all();
}

void RosbridgeClient::refuse(const Error& error) {
  const std::lock_guard lock(mutex_);
  if (std::exchange(has_refused_, true)) return;
  unsaid_notice_ = fmt::format("The server {} {}; such messages are left out.", name_, error.message);
}

/// Whether messages had come.
bool RosbridgeClient::lose(Error error) {
  bool was_here = false;
  {
    const std::lock_guard lock(mutex_);
    socket_.reset();
    ++losses_;
    advertised_.assign(advertised_.size(), false);
    was_here = std::exchange(is_here_, false);
    if (was_here)
      unsaid_loss_ =
          fmt::format("The server {} was lost: it {}. It is tried again every second.", name_, error.message);
    error.place = name_;
    lost_ = std::move(error);
  }
  changed_.notify_all();
  return was_here;
}

std::optional<RosbridgeClient::Newest> RosbridgeClient::take(std::size_t k) {
  const std::lock_guard lock(mutex_);
  return take_locked(k);
}

std::optional<RosbridgeClient::Newest> RosbridgeClient::take_locked(std::size_t k) {
  if (untaken_[k].empty()) return std::nullopt;
  auto first = std::move(untaken_[k].front());
  untaken_[k].pop_front();
  return first;
}

Result<std::optional<RosbridgeClient::Newest>> RosbridgeClient::wait(std::size_t k,
                                                                     Clock::time_point deadline) {
  std::unique_lock lock(mutex_);
  changed_.wait_until(lock, deadline, [&] { return !untaken_[k].empty() || (lost_ && !came_); });
  if (auto first = take_locked(k)) return first;
  if (lost_ && !came_) return *lost_;
  return std::optional<Newest>();
}

bool RosbridgeClient::publish(std::size_t k, const std::string& message) {
  const std::lock_guard lock(mutex_);
  // Behind the commands of the same moment it is in time; behind more it would arrive late.
  constexpr std::size_t kMostUnsent = 512;
  if (!socket_ || socket_->unsent_bytes() > kMostUnsent) return false;
  const RosPublication& to = options_.publications[k];
  if (!advertised_[k])
    socket_->send(
        rosbridge_text({{"op", "advertise"}, {"topic", to.topic}, {"type", type_name(to, version_)}}));
  advertised_[k] = true;
  return socket_->send(
      fmt::format(R"({{"op":"publish","topic":{},"msg":{}}})", rosbridge_text(to.topic), message));
}

bool RosbridgeClient::is_connected() const {
  const std::lock_guard lock(mutex_);
  return socket_ != nullptr;
}

std::uint64_t RosbridgeClient::losses() const {
  const std::lock_guard lock(mutex_);
  return losses_;
}

std::optional<std::string> RosbridgeClient::loss() {
  const std::lock_guard lock(mutex_);
  return std::exchange(unsaid_loss_, std::nullopt);
}

std::optional<std::string> RosbridgeClient::notice() {
  const std::lock_guard lock(mutex_);
  return std::exchange(unsaid_notice_, std::nullopt);
}

}  // namespace palpable::sources
