// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/device/remote/remote_host.hpp"

#include <array>
#include <utility>
#include <vector>

namespace palpable::device {
namespace {

using std::chrono::milliseconds;

constexpr auto kHostLook = milliseconds(1);
constexpr auto kHostIdleLook = milliseconds(20);
constexpr auto kHostLeaving = milliseconds(50);
constexpr std::size_t kHostTakes_bytes = std::size_t{16} << 10U;

}  // namespace

Result<std::unique_ptr<RemoteHost>> RemoteHost::open(HostOptions options,
                                                     std::shared_ptr<SharedExchange> exchange) {
  auto listener = TcpListener::open(options.address, options.port);
  if (!listener) return std::move(listener).error();
  std::unique_ptr<RemoteHost> host(
      new RemoteHost(std::move(options), std::move(exchange), *std::move(listener)));
  if (auto renewed = host->renew_token(); !renewed) return std::move(renewed).error();
  host->thread_ = std::thread([&it = *host] { it.run(); });
  return host;
}

RemoteHost::~RemoteHost() {
  ends_ = true;
  if (thread_.joinable()) thread_.join();
  exchange_->connected = false;
  if (!client_) return;
  client_->stream.send(bye_message());
  client_->stream.close_after_sending(kHostLeaving);
}

std::string RemoteHost::token() const {
  const std::lock_guard lock(mutex_);
  return token_;
}

Result<void> RemoteHost::renew_token() {
  auto token = random_secret();
  auto secret = random_secret();
  if (!token || !secret) return token ? secret.error() : token.error();
  access_.emplace(*token, *secret);
  secret_ = *std::move(secret);
  const std::lock_guard lock(mutex_);
  token_ = *std::move(token);
  return {};
}

void RemoteHost::tell(const std::string& sentence) const {
  if (options_.on_news) options_.on_news(sentence);
}

void RemoteHost::run() {
  while (!ends_) {
    accept();
    greet();
    if (client_) serve();
    const bool forgotten = !client_ && access_->used() && Clock::now() - lost_since_ > kForgottenAfter;
    if (forgotten) end_session("The program that touched has not come back.");
    wait();
  }
}

void RemoteHost::wait() {
  std::array<int, kMostVisitors + 2> waited{};
  static_assert(waited.size() <= kMostWaitedFor);
  waited.fill(-1);
  // A connection that waits longer for its turn must not be looked for all the time.
  if (Clock::now() >= accepts_from_) waited[0] = listener_.descriptor();
  if (client_) waited[1] = client_->stream.descriptor();
  for (std::size_t i = 0; i < visitors_.size(); ++i) waited[i + 2] = visitors_[i].stream.descriptor();
  wait_for_any(waited, client_ || !visitors_.empty() ? kHostLook : kHostIdleLook);
}

void RemoteHost::accept() {
  if (Clock::now() < accepts_from_) return;
  // A visitor is heard at least once before so many others have come that it goes.
  for (std::size_t k = 0; k < kMostVisitors / 2; ++k) {
    auto stream = listener_.accept();
    if (!stream) return;
    if (visitors_.size() >= kMostVisitors) {
      // Without a word: to take leave of it takes longer than many come.
      visitors_.erase(visitors_.begin());
      tell("A connection was refused: it sent no token while others came.");
    }
    visitors_.emplace_back(*std::move(stream));
  }
}

void RemoteHost::greet() {
  // One that is admitted or refused may change what the next ones are told.
  std::vector<Client> staying;
  for (Client& visitor : visitors_)
    if (!greet(visitor)) staying.push_back(std::move(visitor));
  visitors_ = std::move(staying);
}

bool RemoteHost::greet(Client& visitor) {
  std::vector<std::byte> bytes;
  const bool open = visitor.stream.receive(bytes, kHostTakes_bytes);
  visitor.reader.take(bytes);
  if (const auto message = visitor.reader.next()) {
    if (const auto secret = parse_hello(*message))
      admit(std::move(visitor), *secret);
    else
      refuse(visitor, Refusal::not_understood, "it sent no token");
  } else if (visitor.reader.is_other_version()) {
    refuse(visitor, Refusal::wrong_version, "it is another version of Palpable");
  } else if (visitor.reader.is_broken()) {
    refuse(visitor, Refusal::not_understood, "it is no Palpable");
  } else if (open && Clock::now() - visitor.since > kHelloWithin) {
    refuse(visitor, Refusal::not_understood, "it sent no token in time");
  } else {
    return !open;
  }
  return true;
}

void RemoteHost::admit(Client visitor, const std::string& secret) {
  const bool returns = access_->used() && access_->admits(secret);
  // The program that touches may have lost a connection that is still open here.
  const bool is_busy = client_ && !(returns && Clock::now() - client_->heard > milliseconds(100));
  // The answer to one that was gone before its first message may have been lost.
  const bool tries_again = access_->used() && !confirmed_ && !client_ && same_secret(secret, token());
  const bool is_known = returns || tries_again || (!access_->used() && same_secret(secret, token()));
  if (!is_known) {
    accepts_from_ = Clock::now() + kWrongTokenWait;
    // Whether a session is going on is told to nobody without a token.
    return refuse(visitor, Refusal::wrong_token, "its token is wrong or was used already");
  }
  if (is_busy) return refuse(visitor, Refusal::in_use, "another program touches already");
  if (!returns && !tries_again) {
    static_cast<void>(access_->exchange(secret));
    exchange_->sessions.fetch_add(1, std::memory_order_release);
    confirmed_ = false;
  }
  client_ = std::move(visitor);
  client_->heard = client_->second = Clock::now();
  exchange_->connected = true;
  client_->stream.send(welcome_message(secret_, options_.traits));
  tell(returns ? "The program that touches is connected again." : "A program touches with this device now.");
}

void RemoteHost::refuse(Client& visitor, Refusal refusal, const std::string& why) {
  visitor.stream.send(refused_message(refusal));
  visitor.stream.close_after_sending(client_ ? milliseconds(2) : kHostLeaving);
  tell("A connection was refused: " + why + ".");
}

void RemoteHost::serve() {
  const std::string ending = take_messages();
  if (!ending.empty()) return end_session(ending);
  if (client_->stream.is_lost()) {
    client_.reset();
    exchange_->connected = false;
    lost_since_ = Clock::now();
    return tell(
        "The connection is broken; the force is off until the program comes back; after a minute, others may "
        "come.");
  }
  RemoteReading reading;
  // A reading that would wait behind others is not sent: a newer one comes.
  if (client_->stream.has_sent_all() && exchange_->readings.take(reading))
    client_->stream.send(reading_message(reading));
  client_->stream.flush();
}

std::string RemoteHost::take_messages() {
  const auto now = Clock::now();
  if (now - client_->second >= std::chrono::seconds(1)) {
    client_->second = now;
    client_->in_this_second = 0;
  }
  std::vector<std::byte> bytes;
  client_->stream.receive(bytes, kHostTakes_bytes);
  client_->reader.take(bytes);
  while (const auto message = client_->reader.next()) {
    client_->heard = now;
    confirmed_ = true;
    if (++client_->in_this_second > kMostMessages) return "The program that touched sent too many messages.";
    if (std::string ending = take(*message); !ending.empty()) return ending;
  }
  return client_->reader.is_broken() ? "The program that touched sent what is no message." : std::string();
}

std::string RemoteHost::take(const Message& message) {
  if (message.kind == MessageKind::bye) return "The program that touched has ended.";
  if (message.kind == MessageKind::texture) {
    const auto texture = parse_texture(message);
    const bool is_one = texture && (!options_.on_texture || options_.on_texture(*texture));
    return is_one ? std::string() : "The program that touched sent a texture that is out of range.";
  }
  const auto surface = parse_surface(message);
  if (message.kind != MessageKind::surface)
    return "The program that touched sent a message that has no place in a touch.";
  if (!surface) return "The program that touched sent a surface that is out of range.";
  const LocalSurface limited = options_.limited ? options_.limited(*surface) : *surface;
  using Kind = LocalSurface::Kind;
  if (limited.kind > Kind::free) exchange_->kind.store(limited.kind, std::memory_order_relaxed);
  exchange_->surfaces.put(limited);
  return {};
}

void RemoteHost::end_session(const std::string& why) {
  exchange_->connected = false;
  if (client_) client_->stream.close_after_sending(kHostLeaving);
  client_.reset();
  if (auto renewed = renew_token(); !renewed) tell(renewed.error().sentence());
  tell(why);
}

}  // namespace palpable::device
