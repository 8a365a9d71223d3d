// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/page/share/local_network.hpp"

#include <algorithm>
#include <cstring>
#include <memory>
#include <optional>

#include <arpa/inet.h>
#include <ifaddrs.h>
#include <net/if.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

namespace palpable::page {
namespace {

constexpr int kBits = 128, kVersion4Bits = 96;

constexpr IpAddress version_4(std::uint8_t a, std::uint8_t b, std::uint8_t c, std::uint8_t d) {
  return {0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0xFF, 0xFF, a, b, c, d};
}

constexpr NetworkAddress kLoopback4{version_4(127, 0, 0, 0), kVersion4Bits + 8};
constexpr NetworkAddress kLoopback6{{0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1}, kBits};
constexpr NetworkAddress kLinkLocal6{{0xFE, 0x80}, 10};
constexpr NetworkAddress kPrivate6{{0xFC}, 7};

bool holds(const NetworkAddress& network, const IpAddress& address) {
  const auto bit = [](const IpAddress& of, int k) {
    return (of.at(static_cast<std::size_t>(k / 8)) >> static_cast<unsigned>(7 - k % 8)) & 1U;
  };
  for (int k = 0; k < network.prefix; ++k)
    if (bit(network.address, k) != bit(address, k)) return false;
  return true;
}

bool is_version_4(const IpAddress& address) { return holds({version_4(0, 0, 0, 0), kVersion4Bits}, address); }

bool is_loopback(const IpAddress& address) {
  return holds(kLoopback4, address) || holds(kLoopback6, address);
}

/// nullopt for another family than the two of the internet protocol.
std::optional<IpAddress> address_of(const sockaddr* socket) {
  IpAddress address = version_4(0, 0, 0, 0);
  if (socket->sa_family == AF_INET) {
    const auto& four = reinterpret_cast<const sockaddr_in*>(socket)->sin_addr;
    std::memcpy(address.data() + 12, &four, sizeof four);
    return address;
  }
  if (socket->sa_family != AF_INET6) return std::nullopt;
  std::memcpy(address.data(), &reinterpret_cast<const sockaddr_in6*>(socket)->sin6_addr, address.size());
  return address;
}

int ones_of(const sockaddr* mask) {
  const auto bytes = address_of(mask);
  if (!bytes) return 0;
  int ones = mask->sa_family == AF_INET ? kVersion4Bits : 0;
  const IpAddress all{0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF,
                      0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF};
  NetworkAddress set{all, ones + 1};
  IpAddress padded = *bytes;
  if (mask->sa_family == AF_INET) std::fill_n(padded.begin(), 12, std::uint8_t{0xFF});
  while (ones < kBits && holds(set, padded)) set.prefix = ++ones + 1;
  return ones;
}

/// The address from which a packet to another network would be sent; nullopt if there is no way out.
/// Connecting a datagram socket only chooses the way. `there`: a destination for documentation.
template <class Address>
std::optional<IpAddress> address_towards(const Address& there) {
  const auto* destination = reinterpret_cast<const sockaddr*>(&there);
  const int socket = ::socket(destination->sa_family, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  if (socket < 0) return std::nullopt;
  Address here{};
  socklen_t size = sizeof here;
  const bool known = ::connect(socket, destination, sizeof there) == 0 &&
                     ::getsockname(socket, reinterpret_cast<sockaddr*>(&here), &size) == 0;
  ::close(socket);
  return known ? address_of(reinterpret_cast<const sockaddr*>(&here)) : std::nullopt;
}

std::optional<IpAddress> address_towards_others_4() {
  sockaddr_in there{};
  there.sin_family = AF_INET;
  there.sin_port = htons(9);
  there.sin_addr.s_addr = htonl(0xC6336401U);  // 198.51.100.1, RFC 5737
  return address_towards(there);
}

std::optional<IpAddress> address_towards_others_6() {
  sockaddr_in6 there{};
  there.sin6_family = AF_INET6;
  there.sin6_port = htons(9);
  inet_pton(AF_INET6, "2001:db8::1", &there.sin6_addr);  // RFC 3849
  return address_towards(there);
}

}  // namespace

std::vector<NetworkAddress> network_addresses() {
  ifaddrs* first = nullptr;
  if (getifaddrs(&first) != 0) return {};
  const std::unique_ptr<ifaddrs, decltype(&freeifaddrs)> all(first, freeifaddrs);
  std::vector<NetworkAddress> found;
  for (const ifaddrs* one = first; one != nullptr; one = one->ifa_next) {
    if (one->ifa_addr == nullptr || one->ifa_netmask == nullptr || (one->ifa_flags & IFF_UP) == 0) continue;
    if (const auto address = address_of(one->ifa_addr))
      found.push_back({*address, ones_of(one->ifa_netmask)});
  }
  return found;
}

Result<std::vector<std::string>> addresses_in_network() {
  const auto own = network_addresses();
  std::vector<std::string> found;
  const auto add = [&](std::optional<IpAddress> outwards, bool four) {
    const auto serves = [&](const IpAddress& one) {
      return is_version_4(one) == four && !is_loopback(one) && !holds(kLinkLocal6, one);
    };
    if (outwards && serves(*outwards)) return found.push_back(text_of(*outwards));
    const auto first = std::find_if(own.begin(), own.end(),
                                    [&](const NetworkAddress& network) { return serves(network.address); });
    if (first != own.end()) found.push_back(text_of(first->address));
  };
  add(address_towards_others_4(), true);
  add(address_towards_others_6(), false);
  if (!found.empty()) return found;
  return Error{ErrorCode::failed, "this computer is in no network, so that nothing can be shared", {}};
}

Result<IpAddress> ip_address(std::string_view text) {
  IpAddress address = version_4(0, 0, 0, 0);
  // As in a link.
  if (text.size() > 2 && text.front() == '[' && text.back() == ']') text = text.substr(1, text.size() - 2);
  if (inet_pton(AF_INET, std::string(text).c_str(), address.data() + 12) == 1) return address;
  if (inet_pton(AF_INET6, std::string(text.substr(0, text.find('%'))).c_str(), address.data()) == 1)
    return address;
  return invalid_input("is not an IP address", std::string(text));
}

std::string text_of(const IpAddress& address) {
  std::array<char, INET6_ADDRSTRLEN> text{};
  const bool four = is_version_4(address);
  const char* made = inet_ntop(four ? AF_INET : AF_INET6, address.data() + (four ? 12 : 0), text.data(),
                               static_cast<socklen_t>(text.size()));
  return made == nullptr ? std::string() : made;
}

bool is_local(const IpAddress& peer, const std::vector<NetworkAddress>& own) {
  constexpr std::array<NetworkAddress, 8> kPrivate{{kLoopback4,
                                                    {version_4(10, 0, 0, 0), kVersion4Bits + 8},
                                                    {version_4(172, 16, 0, 0), kVersion4Bits + 12},
                                                    {version_4(192, 168, 0, 0), kVersion4Bits + 16},
                                                    {version_4(169, 254, 0, 0), kVersion4Bits + 16},
                                                    kLoopback6,
                                                    kLinkLocal6,
                                                    kPrivate6}};
  const auto has_peer = [&](const NetworkAddress& network) {
    const int all = is_version_4(network.address) ? kVersion4Bits : 0;
    return network.prefix > all && holds(network, peer);
  };
  return std::any_of(kPrivate.begin(), kPrivate.end(), has_peer) ||
         std::any_of(own.begin(), own.end(), has_peer);
}

}  // namespace palpable::page
