// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/page/share/local_network.hpp"

#include <algorithm>
#include <array>
#include <memory>

#include <arpa/inet.h>
#include <ifaddrs.h>
#include <net/if.h>
#include <sys/socket.h>
#include <unistd.h>

namespace palpable::page {
namespace {

constexpr std::uint32_t kLoopback = 0x7F000000U;
constexpr std::uint32_t kLoopbackMask = 0xFF000000U;

std::uint32_t number_of(const sockaddr* address) {
  return ntohl(reinterpret_cast<const sockaddr_in*>(address)->sin_addr.s_addr);
}

bool is_loopback(std::uint32_t address) { return (address & kLoopbackMask) == kLoopback; }

std::string dotted(std::uint32_t address) {
  const in_addr value{htonl(address)};
  std::array<char, INET_ADDRSTRLEN> text{};
  return inet_ntop(AF_INET, &value, text.data(), text.size()) == nullptr ? std::string() : text.data();
}

/// The address from which a packet to another network would be sent; 0 if there is no way out. Connecting a
/// datagram socket only chooses the way. The destination is one for documentation (RFC 5737).
std::uint32_t address_towards_others() {
  const int socket = ::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  if (socket < 0) return 0;
  sockaddr_in there{};
  there.sin_family = AF_INET;
  there.sin_port = htons(9);
  there.sin_addr.s_addr = htonl(0xC6336401U);  // 198.51.100.1
  sockaddr_in here{};
  socklen_t size = sizeof here;
  const bool known = ::connect(socket, reinterpret_cast<const sockaddr*>(&there), sizeof there) == 0 &&
                     ::getsockname(socket, reinterpret_cast<sockaddr*>(&here), &size) == 0;
  ::close(socket);
  return known ? ntohl(here.sin_addr.s_addr) : 0;
}

}  // namespace

std::vector<NetworkAddress> network_addresses() {
  ifaddrs* first = nullptr;
  if (getifaddrs(&first) != 0) return {};
  const std::unique_ptr<ifaddrs, decltype(&freeifaddrs)> all(first, freeifaddrs);
  std::vector<NetworkAddress> found;
  for (const ifaddrs* one = first; one != nullptr; one = one->ifa_next) {
    if (one->ifa_addr == nullptr || one->ifa_netmask == nullptr || one->ifa_addr->sa_family != AF_INET)
      continue;
    if ((one->ifa_flags & IFF_UP) != 0)
      found.push_back({number_of(one->ifa_addr), number_of(one->ifa_netmask)});
  }
  return found;
}

Result<std::string> address_in_network() {
  if (const std::uint32_t address = address_towards_others(); address != 0 && !is_loopback(address))
    return dotted(address);
  for (const auto& own : network_addresses())
    if (!is_loopback(own.address)) return dotted(own.address);
  return Error{ErrorCode::failed, "this computer is in no network, so that nothing can be shared", {}};
}

Result<std::uint32_t> ipv4(std::string_view text) {
  in_addr address{};
  if (inet_pton(AF_INET, std::string(text).c_str(), &address) != 1)
    return invalid_input("is not an IPv4 address", std::string(text));
  return ntohl(address.s_addr);
}

bool is_local(std::uint32_t peer, const std::vector<NetworkAddress>& own) {
  constexpr std::array<NetworkAddress, 5> kPrivate{{{kLoopback, kLoopbackMask},
                                                    {0x0A000000U, 0xFF000000U},
                                                    {0xAC100000U, 0xFFF00000U},
                                                    {0xC0A80000U, 0xFFFF0000U},
                                                    {0xA9FE0000U, 0xFFFF0000U}}};
  const auto holds = [&](const NetworkAddress& network) {
    return network.mask != 0 && (peer & network.mask) == (network.address & network.mask);
  };
  return std::any_of(kPrivate.begin(), kPrivate.end(), holds) || std::any_of(own.begin(), own.end(), holds);
}

}  // namespace palpable::page
