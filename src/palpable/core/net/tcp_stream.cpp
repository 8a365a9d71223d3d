// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/core/net/tcp_stream.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <memory>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <linux/sockios.h>
#include <netdb.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/ioctl.h>
#include <sys/socket.h>

namespace palpable {
namespace {

struct FreeAddresses {
  void operator()(addrinfo* list) const { ::freeaddrinfo(list); }
};
using Addresses = std::unique_ptr<addrinfo, FreeAddresses>;

Result<Addresses> addresses_of(const std::string& host, const std::string& port, int flags) {
  addrinfo wanted{};
  wanted.ai_socktype = SOCK_STREAM;
  wanted.ai_flags = flags;
  addrinfo* found = nullptr;
  if (const int failed = ::getaddrinfo(host.c_str(), port.c_str(), &wanted, &found); failed != 0)
    return Error{ErrorCode::device, std::string("is no address (") + ::gai_strerror(failed) + ")",
                 host + ":" + port};
  return Addresses(found);
}

Descriptor new_socket(const addrinfo& address) {
  return Descriptor(::socket(address.ai_family, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0));
}

/// The reason for which a socket did not connect in time; 0: it did.
int failure_of(int socket, const addrinfo& address, std::chrono::milliseconds longest) {
  if (::connect(socket, address.ai_addr, address.ai_addrlen) == 0) return 0;
  if (errno != EINPROGRESS) return errno;
  pollfd waited{socket, POLLOUT, 0};
  if (::poll(&waited, 1, static_cast<int>(longest.count())) <= 0) return ETIMEDOUT;
  int failed = 0;
  socklen_t size = sizeof failed;
  ::getsockopt(socket, SOL_SOCKET, SO_ERROR, &failed, &size);
  return failed;
}

std::string system_reason(int why) { return std::generic_category().message(why); }

}  // namespace

TcpStream::TcpStream(Descriptor socket) : socket_(std::move(socket)) {
  const int on = 1;
  ::setsockopt(descriptor(), IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
}

Result<TcpStream> TcpStream::connect(const std::string& host, const std::string& port,
                                     std::chrono::milliseconds longest) {
  auto addresses = addresses_of(host, port, AI_NUMERICSERV);
  if (!addresses) return std::move(addresses).error();
  int failed = EADDRNOTAVAIL;
  for (const addrinfo* address = addresses->get(); address != nullptr; address = address->ai_next) {
    Descriptor socket = new_socket(*address);
    if (socket.number() < 0) continue;
    failed = failure_of(socket.number(), *address, longest);
    if (failed == 0) return TcpStream(std::move(socket));
  }
  return Error{ErrorCode::device, "no connection (" + system_reason(failed) + ")", host + ":" + port,
               Reason::device_silent};
}

void TcpStream::send(std::span<const std::byte> bytes) {
  constexpr std::size_t kMostUnsent_bytes = std::size_t{64} << 10U;
  unsent_.insert(unsent_.end(), bytes.begin(), bytes.end());
  if (lost_ || unsent_.empty()) return;
  const ssize_t sent = ::send(descriptor(), unsent_.data(), unsent_.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
  if (sent > 0) unsent_.erase(unsent_.begin(), unsent_.begin() + sent);
  lost_ = (sent < 0 && errno != EAGAIN && errno != EINTR) || unsent_.size() > kMostUnsent_bytes;
}

bool TcpStream::has_sent_all() const {
  int waiting = 0;
  return unsent_.empty() && ::ioctl(descriptor(), SIOCOUTQNSD, &waiting) == 0 && waiting == 0;
}

bool TcpStream::receive(std::vector<std::byte>& bytes, std::size_t most) {
  std::array<std::byte, 4096> buffer{};
  while (!lost_ && most > 0) {
    const ssize_t got = ::recv(descriptor(), buffer.data(), std::min(most, buffer.size()), MSG_DONTWAIT);
    if (got < 0 && (errno == EAGAIN || errno == EINTR)) return true;
    lost_ = got <= 0;
    if (lost_) return false;
    bytes.insert(bytes.end(), buffer.begin(), buffer.begin() + got);
    most -= static_cast<std::size_t>(got);
  }
  return !lost_;
}

void TcpStream::close_after_sending(std::chrono::milliseconds longest) {
  flush();
  ::shutdown(descriptor(), SHUT_WR);
  // Closing while bytes of the peer are unread would take the last message along.
  const auto until = std::chrono::steady_clock::now() + longest;
  std::vector<std::byte> ignored;
  constexpr std::size_t kMost_bytes = std::size_t{64} << 10U;
  while (receive(ignored, kMost_bytes) && std::chrono::steady_clock::now() < until) {
    ignored.clear();
    wait_for_any(std::array{descriptor()}, std::chrono::milliseconds(1));
  }
  socket_.close();
  lost_ = true;
}

Result<TcpListener> TcpListener::open(const std::string& address, std::uint16_t port) {
  const std::string place = address + ":" + std::to_string(port);
  auto addresses = addresses_of(address, std::to_string(port), AI_NUMERICHOST | AI_NUMERICSERV | AI_PASSIVE);
  if (!addresses) return Error{ErrorCode::usage, "is no address of this machine in numbers", place};
  const addrinfo& first = **addresses;
  Descriptor socket = new_socket(first);
  const int on = 1;
  ::setsockopt(socket.number(), SOL_SOCKET, SO_REUSEADDR, &on, sizeof on);
  constexpr int kWaiting = 32;
  if (socket.number() < 0 || ::bind(socket.number(), first.ai_addr, first.ai_addrlen) != 0 ||
      ::listen(socket.number(), kWaiting) != 0)
    return Error{ErrorCode::failed, "cannot be listened at (" + system_reason(errno) + ")", place};
  sockaddr_storage bound{};
  socklen_t size = sizeof bound;
  ::getsockname(socket.number(), reinterpret_cast<sockaddr*>(&bound), &size);
  const auto in_network_order = bound.ss_family == AF_INET6
                                    ? reinterpret_cast<const sockaddr_in6*>(&bound)->sin6_port
                                    : reinterpret_cast<const sockaddr_in*>(&bound)->sin_port;
  return TcpListener(std::move(socket), ntohs(in_network_order));
}

std::optional<TcpStream> TcpListener::accept() {
  Descriptor socket(::accept4(descriptor(), nullptr, nullptr, SOCK_CLOEXEC | SOCK_NONBLOCK));
  if (socket.number() < 0) return {};
  return TcpStream(std::move(socket));
}

void wait_for_any(std::span<const int> descriptors, std::chrono::milliseconds longest) {
  std::array<pollfd, kMostWaitedFor> waited{};
  const std::size_t count = std::min(descriptors.size(), waited.size());
  for (std::size_t k = 0; k < count; ++k) waited[k] = {descriptors[k], POLLIN, 0};
  ::poll(waited.data(), count, static_cast<int>(longest.count()));
}

}  // namespace palpable
