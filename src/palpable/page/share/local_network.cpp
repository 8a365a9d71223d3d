// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/page/share/local_network.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <memory>
#include <optional>

#include <boost/asio/ip/host_name.hpp>
#include <boost/asio/ip/network_v4.hpp>
#include <boost/asio/ip/network_v6.hpp>
#include <boost/asio/ip/udp.hpp>
#include <ifaddrs.h>
#include <net/if.h>
#include <netinet/in.h>
#include <sys/socket.h>

namespace palpable::page {
namespace {

namespace ip = boost::asio::ip;

/// Addresses of version 4 that are written as ones of version 6 (RFC 4291, 2.5.5.2) become theirs.
IpAddress plain(const IpAddress& address) {
  return address.is_v6() && address.to_v6().is_v4_mapped()
             ? ip::make_address_v4(ip::v4_mapped, address.to_v6())
             : address;
}

/// nullopt for another family than the two of the internet protocol.
std::optional<IpAddress> address_of(const sockaddr* socket) {
  if (socket->sa_family == AF_INET)
    return ip::address_v4(ntohl(reinterpret_cast<const sockaddr_in*>(socket)->sin_addr.s_addr));
  if (socket->sa_family != AF_INET6) return std::nullopt;
  ip::address_v6::bytes_type bytes{};
  std::memcpy(bytes.data(), &reinterpret_cast<const sockaddr_in6*>(socket)->sin6_addr, bytes.size());
  return ip::address_v6(bytes);
}

int ones_of(const IpAddress& mask) {
  const auto count = [](const auto& bytes) {
    int ones = 0;
    for (const std::uint8_t byte : bytes) ones += std::popcount(byte);
    return ones;
  };
  return mask.is_v4() ? count(mask.to_v4().to_bytes()) : count(mask.to_v6().to_bytes());
}

bool holds(const NetworkAddress& network, const IpAddress& address) {
  if (network.address.is_v4() != address.is_v4()) return false;
  const auto prefix = static_cast<unsigned short>(network.prefix);
  return address.is_v4() ? ip::network_v4(network.address.to_v4(), prefix).canonical() ==
                               ip::network_v4(address.to_v4(), prefix).canonical()
                         : ip::network_v6(network.address.to_v6(), prefix).canonical() ==
                               ip::network_v6(address.to_v6(), prefix).canonical();
}

/// The address from which a packet to another network would be sent; nullopt if there is no way out.
/// Connecting a datagram socket only chooses the way. `there`: a destination for documentation.
std::optional<IpAddress> address_towards(const char* there) {
  constexpr std::uint16_t kDiscard = 9;
  boost::asio::io_context context;
  ip::udp::socket socket(context);
  boost::system::error_code error;
  const ip::udp::endpoint destination(ip::make_address(there), kDiscard);
  if (socket.open(destination.protocol(), error) || socket.connect(destination, error)) return std::nullopt;
  const auto here = socket.local_endpoint(error);
  return error ? std::nullopt : std::optional<IpAddress>(here.address());
}

}  // namespace

bool is_link_local(const IpAddress& address) { return address.is_v6() && address.to_v6().is_link_local(); }

std::vector<NetworkAddress> network_addresses() {
  ifaddrs* first = nullptr;
  if (getifaddrs(&first) != 0) return {};
  const std::unique_ptr<ifaddrs, decltype(&freeifaddrs)> all(first, freeifaddrs);
  std::vector<NetworkAddress> found;
  for (const ifaddrs* one = first; one != nullptr; one = one->ifa_next) {
    if (one->ifa_addr == nullptr || one->ifa_netmask == nullptr || (one->ifa_flags & IFF_UP) == 0) continue;
    const auto address = address_of(one->ifa_addr), mask = address_of(one->ifa_netmask);
    if (address && mask) found.push_back({*address, ones_of(*mask)});
  }
  return found;
}

Result<std::vector<std::string>> addresses_in_network() {
  const auto own = network_addresses();
  std::vector<std::string> found;
  const auto add = [&](std::optional<IpAddress> outwards, bool four) {
    const auto serves = [&](const IpAddress& one) {
      return one.is_v4() == four && !one.is_loopback() && !is_link_local(one);
    };
    if (outwards && serves(*outwards)) return found.push_back(outwards->to_string());
    const auto first = std::find_if(own.begin(), own.end(),
                                    [&](const NetworkAddress& network) { return serves(network.address); });
    if (first != own.end()) found.push_back(first->address.to_string());
  };
  add(address_towards("198.51.100.1"), true);  // RFC 5737
  add(address_towards("2001:db8::1"), false);  // RFC 3849
  if (!found.empty()) return found;
  return Error{ErrorCode::failed, "this computer is in no network, so that nothing can be shared", {}};
}

std::string name_of_this_computer() {
  boost::system::error_code error;
  const std::string name = ip::host_name(error);
  return error ? std::string() : name;
}

Result<IpAddress> ip_address(std::string_view text) {
  std::string_view bare = text;
  // As in a link.
  if (bare.size() > 2 && bare.front() == '[' && bare.back() == ']') bare = bare.substr(1, bare.size() - 2);
  boost::system::error_code error;
  const auto address = ip::make_address(std::string(bare.substr(0, bare.find('%'))), error);
  if (error) return invalid_input("is not an IP address", std::string(text));
  return plain(address);
}

bool is_local(const IpAddress& peer, const std::vector<NetworkAddress>& own) {
  static const std::array<NetworkAddress, 5> kPrivate{{{ip::make_address("10.0.0.0"), 8},
                                                       {ip::make_address("172.16.0.0"), 12},
                                                       {ip::make_address("192.168.0.0"), 16},
                                                       {ip::make_address("169.254.0.0"), 16},
                                                       {ip::make_address("fc00::"), 7}}};
  const auto has_peer = [&](const NetworkAddress& network) {
    return network.prefix > 0 && holds(network, peer);
  };
  return peer.is_loopback() || is_link_local(peer) ||
         std::any_of(kPrivate.begin(), kPrivate.end(), has_peer) ||
         std::any_of(own.begin(), own.end(), has_peer);
}

}  // namespace palpable::page
