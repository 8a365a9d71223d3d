// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/result.hpp"

#include <string>
#include <string_view>
#include <vector>

#include <boost/asio/ip/address.hpp>

namespace palpable::page {

/// Of version 4 or 6; those of version 4 are never mapped to version 6.
using IpAddress = boost::asio::ip::address;

/// An address of this computer, and how many of its first bits are those of its network.
struct NetworkAddress {
  IpAddress address;
  int prefix = 0;
};

/// The addresses of the interfaces that are up, loopback's too.
std::vector<NetworkAddress> network_addresses();

/// The addresses by which devices of the local network reach this computer, at most one of each version, 4
/// first: that of the interface which leads out, else the first one that is neither loopback's nor, of
/// version 6, link-local (browsers cannot be sent there). Sends nothing. Errors: failed, if there is none.
Result<std::vector<std::string>> addresses_in_network();

/// Which other computers may not know. Empty: it has none.
std::string name_of_this_computer();

/// An address in the usual notation, with or without brackets and a zone ("[fd00::2]", "fe80::1%eth0").
/// Errors: invalid_input.
Result<IpAddress> ip_address(std::string_view text);

/// Of version 6 (fe80::/10): browsers cannot be sent there.
bool is_link_local(const IpAddress& address);

/// Whether a device may be in the local network: its address is private (RFC 1918, RFC 4193), link-local,
/// loopback's, or in the network of one of `own`.
bool is_local(const IpAddress& peer, const std::vector<NetworkAddress>& own);

}  // namespace palpable::page
