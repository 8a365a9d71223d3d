// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/page/share/local_network.hpp"

#include <algorithm>

#include <gtest/gtest.h>

namespace palpable::page {
namespace {

TEST(LocalNetwork, ReadsAndWritesAddresses) {
  EXPECT_EQ(ip_address("192.168.1.20").value().to_string(), "192.168.1.20");
  EXPECT_EQ(ip_address("2001:0DB8:0:0:0:0:0:1").value().to_string(), "2001:db8::1");
  EXPECT_EQ(ip_address("fe80::1%eth0").value().to_string(), "fe80::1");
  EXPECT_EQ(ip_address("[fd00::2]").value().to_string(), "fd00::2");
  EXPECT_EQ(ip_address("::ffff:10.1.2.3").value(), ip_address("10.1.2.3").value());
  for (const char* text :
       {"", "192.168.1", "192.168.1.256", "example.org", "1.2.3.4 ", ":::", "2001:db8::1::"})
    EXPECT_FALSE(ip_address(text)) << text;
}

TEST(LocalNetwork, LetsInPrivateAddressesAndThoseOfItsOwnNetworks) {
  // A campus network with public addresses: 203.0.113.0/24 and 2001:db8:1:2::/64.
  const std::vector<NetworkAddress> own{{ip_address("203.0.113.5").value(), 24},
                                        {ip_address("2001:db8:1:2::5").value(), 64}};
  for (const char* text :
       {"192.168.7.3", "10.1.2.3", "172.16.0.1", "172.31.255.255", "169.254.3.4", "127.0.0.1",
        "203.0.113.200", "::1", "fe80::7%eth0", "fd12:3456::9", "2001:db8:1:2:aaaa::1", "::ffff:10.1.2.3"})
    EXPECT_TRUE(is_local(ip_address(text).value(), own)) << text;
  for (const char* text : {"203.0.114.1", "172.32.0.1", "8.8.8.8", "192.169.0.1", "0.0.0.0",
                           "2001:db8:1:3::1", "::2", "fec0::1", "2a00::1", "::ffff:8.8.8.8"})
    EXPECT_FALSE(is_local(ip_address(text).value(), own)) << text;
  // An interface that states no network.
  EXPECT_FALSE(is_local(ip_address("8.8.8.8").value(), {{ip_address("203.0.113.5").value(), 0}}));
  EXPECT_FALSE(is_local(ip_address("2a00::1").value(), {{ip_address("2001:db8::5").value(), 0}}));
}

TEST(LocalNetwork, FindsLoopbackAmongTheAddresses) {
  const auto all = network_addresses();
  const auto four = std::find_if(all.begin(), all.end(),
                                 [](const auto& one) { return one.address.to_string() == "127.0.0.1"; });
  ASSERT_NE(four, all.end());
  EXPECT_EQ(four->prefix, 8);
  if (const auto found = addresses_in_network()) {
    for (const std::string& text : *found) EXPECT_EQ(ip_address(text).value().to_string(), text);
  }
}

}  // namespace
}  // namespace palpable::page
