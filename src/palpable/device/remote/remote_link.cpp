// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/device/remote/remote_link.hpp"

#include <array>
#include <utility>
#include <vector>

namespace palpable::device {
namespace {

using std::chrono::milliseconds;

constexpr auto kLinkConnecting = milliseconds(3000);
constexpr auto kLinkConnectingAgain = milliseconds(500);
constexpr auto kLinkBetweenTries = milliseconds(100);
/// A peer that is silent for this long has gone, whatever the system knows of the connection.
constexpr auto kLinkGone = milliseconds(1000);
/// A surface is sent for each reading, and at least this often.
constexpr auto kLinkLeastOften = milliseconds(5);
constexpr auto kLinkLook = milliseconds(1);
constexpr std::size_t kLinkTakes_bytes = std::size_t{32} << 10U;

}  // namespace

Result<std::unique_ptr<RemoteLink>> RemoteLink::open(const Address& address,
                                                     std::shared_ptr<RemoteExchange> exchange) {
  std::unique_ptr<RemoteLink> link(new RemoteLink(address, std::move(exchange)));
  auto welcome = link->connect(address.token);
  if (!welcome) return std::move(welcome).error();
  link->secret_ = std::move(welcome->secret);
  link->traits_ = std::move(welcome->traits);
  link->thread_ = std::thread([&it = *link] { it.run(); });
  return link;
}

RemoteLink::~RemoteLink() {
  ends_ = true;
  if (thread_.joinable()) thread_.join();
  if (!stream_) return;
  stream_->send(bye_message());
  constexpr auto kLeaving = milliseconds(100);
  stream_->close_after_sending(kLeaving);
}

Result<Welcome> RemoteLink::connect(const std::string& secret) {
  const std::string place = "remote:" + address_.host + ":" + address_.port;
  const auto no_welcome = [&](std::string message) {
    return Error{ErrorCode::device, std::move(message), place, Reason::device_silent};
  };
  const auto longest = secret_.empty() ? kLinkConnecting : kLinkConnectingAgain;
  auto stream = TcpStream::connect(address_.host, address_.port, longest);
  if (!stream) {
    const bool is_silent = stream.error().reason == Reason::device_silent;
    return no_welcome((is_silent ? "nobody shares a device there: " : "the name of the computer ") +
                      stream.error().message);
  }
  stream->send(hello_message(secret));
  reader_ = {};
  for (const auto until = Clock::now() + longest; Clock::now() < until;) {
    std::vector<std::byte> bytes;
    const bool open = stream->receive(bytes, kLinkTakes_bytes);
    reader_.take(bytes);
    if (const auto message = reader_.next()) {
      if (const auto refusal = parse_refused(*message)) return no_welcome(std::string(sentence_of(*refusal)));
      auto welcome = parse_welcome(*message);
      if (!welcome) return no_welcome("what answers there shares no device of Palpable");
      stream_ = *std::move(stream);
      heard_ = last_take_ = last_sent_ = Clock::now();
      sent_textures_ = 0;
      return *std::move(welcome);
    }
    if (reader_.is_other_version()) return no_welcome(std::string(sentence_of(Refusal::wrong_version)));
    if (reader_.is_broken()) return no_welcome("what answers there shares no device of Palpable");
    if (!open) return no_welcome("the connection was closed without an answer");
    wait_for_any(std::array{stream->descriptor()}, kLinkLook);
  }
  return no_welcome("no answer");
}

void RemoteLink::run() {
  while (!ends_ && !exchange_->failed) {
    if (!stream_) {
      connect_again();
      continue;
    }
    if (!exchange_once()) stream_.reset();
  }
}

void RemoteLink::connect_again() {
  // Nothing that was written before is sent over a new connection.
  exchange_->surfaces.cut();
  auto welcome = connect(secret_);
  if (welcome) {
    secret_ = std::move(welcome->secret);
    note_trouble({});
    return;
  }
  // A host that does not know the session shares its device anew: that needs the address that it prints.
  if (welcome.error().message == sentence_of(Refusal::wrong_token)) {
    note_trouble("the sharing of the device has ended");
    exchange_->failed = true;
    return;
  }
  note_trouble(welcome.error().message);
  std::this_thread::sleep_for(kLinkBetweenTries);
}

bool RemoteLink::exchange_once() {
  if (!take_messages()) return false;
  const auto now = Clock::now();
  if (now - heard_ > kLinkGone) {
    note_trouble("the other computer does not answer any more");
    return false;
  }
  send_textures();
  const auto taken =
      exchange_->surfaces.take(std::chrono::duration<double>(now - std::exchange(last_take_, now)).count());
  if ((has_news_ || now - last_sent_ >= kLinkLeastOften) && stream_->has_sent_all()) {
    stream_->send(surface_message(taken.command));
    exchange_->surfaces.sent(taken);
    last_sent_ = now;
    has_news_ = false;
  }
  stream_->flush();
  wait_for_any(std::array{stream_->descriptor()}, kLinkLook);
  return !stream_->is_lost();
}

/// Before the surfaces that name them.
void RemoteLink::send_textures() {
  if (exchange_->textures.version() == sent_textures_) return;
  const auto list = exchange_->textures.list();
  for (const LocalTexture& texture : list.textures) stream_->send(texture_message(texture));
  sent_textures_ = list.version;
}

bool RemoteLink::take_messages() {
  std::vector<std::byte> bytes;
  const bool open = stream_->receive(bytes, kLinkTakes_bytes);
  reader_.take(bytes);
  while (const auto message = reader_.next()) {
    if (message->kind == MessageKind::bye) {
      note_trouble("the other computer has ended the sharing of the device");
      exchange_->failed = true;
      return false;
    }
    const auto reading = parse_reading(*message);
    if (!reading) {
      note_trouble("the other computer sends what is no reading of a device");
      return false;
    }
    exchange_->readings.put(*reading);
    heard_ = Clock::now();
    has_news_ = true;
  }
  if (!open || reader_.is_broken()) note_trouble("the connection to the other computer is broken");
  return open && !reader_.is_broken();
}

void RemoteLink::note_trouble(std::string sentence) {
  const std::lock_guard lock(mutex_);
  trouble_ = std::move(sentence);
}

std::string RemoteLink::trouble() const {
  const std::lock_guard lock(mutex_);
  return trouble_;
}

}  // namespace palpable::device
