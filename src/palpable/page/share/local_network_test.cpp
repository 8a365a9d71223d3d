// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/page/share/local_network.hpp"

#include <algorithm>

#include <gtest/gtest.h>

namespace palpable::page {
namespace {

TEST(LocalNetwork, ReadsAddresses) {
  EXPECT_EQ(ipv4("192.168.1.20").value(), 0xC0A80114U);
  for (const char* text : {"", "192.168.1", "192.168.1.256", "example.org", "::1", "1.2.3.4 "})
    EXPECT_FALSE(ipv4(text)) << text;
}

TEST(LocalNetwork, LetsInPrivateAddressesAndThoseOfItsOwnNetworks) {
  // A campus network with public addresses: 203.0.113.0/24.
  const std::vector<NetworkAddress> own{{0xCB007105U, 0xFFFFFF00U}};
  for (const char* text : {"192.168.7.3", "10.1.2.3", "172.16.0.1", "172.31.255.255", "169.254.3.4",
                           "127.0.0.1", "203.0.113.200"})
    EXPECT_TRUE(is_local(ipv4(text).value(), own)) << text;
  for (const char* text : {"203.0.114.1", "172.32.0.1", "8.8.8.8", "192.169.0.1", "0.0.0.0"})
    EXPECT_FALSE(is_local(ipv4(text).value(), own)) << text;
  EXPECT_FALSE(is_local(ipv4("8.8.8.8").value(), {{0xCB007105U, 0U}}));
}

TEST(LocalNetwork, FindsLoopbackAmongTheAddresses) {
  const auto all = network_addresses();
  EXPECT_TRUE(std::any_of(all.begin(), all.end(),
                          [](const NetworkAddress& one) { return one.address == 0x7F000001U; }));
}

}  // namespace
}  // namespace palpable::page
