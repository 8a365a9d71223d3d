// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/page/access.hpp"
#include "palpable/page/protocol.hpp"

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <variant>

// Any text gives a message within its limits, or an error; any header is accepted or refused.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  namespace page = palpable::page;
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  const auto message = page::protocol::parse_from_page(text);
  if (!message && message.error().message.empty()) std::abort();
  if (message) {
    if (const auto* pointer = std::get_if<page::protocol::Pointer>(&*message);
        pointer != nullptr && !(std::abs(pointer->x_m) <= 10.0 && std::abs(pointer->y_m) <= 10.0))
      std::abort();
    if (const auto* change = std::get_if<page::protocol::Change>(&*message);
        change != nullptr && (change->parameters.size() > 16 || change->law.size() > 32))
      std::abort();
    if (const auto* edit = std::get_if<page::protocol::Edit>(&*message);
        edit != nullptr && edit->material.friction && !(*edit->material.friction <= 10.0))
      std::abort();
  }
  const auto value = page::cookie_value(text, "palpable");
  if (value.size() > text.size()) std::abort();
  static const auto names = page::loopback_names(8080);
  const bool own = page::is_own_host(text, names) || page::is_own_origin(text, names);
  if (own && text.find("8080") == std::string_view::npos) std::abort();
  return 0;
}
