// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/page/access.hpp"

#include <algorithm>
#include <string>

namespace palpable::page {

std::string_view cookie_value(std::string_view header, std::string_view name) {
  while (!header.empty()) {
    const std::size_t end = header.find(';');
    std::string_view pair = header.substr(0, end);
    header = end == std::string_view::npos ? std::string_view{} : header.substr(end + 1);
    while (!pair.empty() && pair.front() == ' ') pair.remove_prefix(1);
    if (pair.size() > name.size() && pair[name.size()] == '=' && pair.starts_with(name))
      return pair.substr(name.size() + 1);
  }
  return {};
}

OwnNames loopback_names(std::uint16_t port) {
  const std::string suffix = ":" + std::to_string(port);
  return {"http", {"127.0.0.1" + suffix, "localhost" + suffix}};
}

std::string host_and_port(const std::string& address, std::uint16_t port) {
  const bool is_6 = address.find(':') != std::string::npos;
  return (is_6 ? "[" + address + "]" : address) + ":" + std::to_string(port);
}

OwnNames guest_names(const std::vector<std::string>& addresses, std::uint16_t port) {
  OwnNames names{"https", {}};
  for (const std::string& address : addresses) names.hosts.push_back(host_and_port(address, port));
  return names;
}

bool is_own_host(std::string_view host, const OwnNames& names) {
  return std::find(names.hosts.begin(), names.hosts.end(), host) != names.hosts.end();
}

bool is_own_origin(std::string_view origin, const OwnNames& names) {
  const std::string scheme = names.scheme + "://";
  return origin.starts_with(scheme) && is_own_host(origin.substr(scheme.size()), names);
}

}  // namespace palpable::page
