// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/result.hpp"

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace palpable::page {

/// An IPv4 address of this computer and the mask of its network, both in host byte order.
struct NetworkAddress {
  std::uint32_t address = 0;
  std::uint32_t mask = 0;
};

/// The IPv4 addresses of the interfaces that are up, loopback's too.
std::vector<NetworkAddress> network_addresses();

/// The address by which devices of the local network reach this computer: that of the interface which leads
/// out, else the first one that is not loopback's. Sends nothing. Errors: failed, if there is none.
Result<std::string> address_in_network();

/// An IPv4 address in dotted notation as a number in host byte order. Errors: invalid_input.
Result<std::uint32_t> ipv4(std::string_view text);

/// Whether a device may be in the local network: its address is private (RFC 1918), link-local, loopback's,
/// or in the network of one of `own`.
bool is_local(std::uint32_t peer, const std::vector<NetworkAddress>& own);

}  // namespace palpable::page
