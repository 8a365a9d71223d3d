// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/device/remote/remote_wire.hpp"

#include <cstdint>
#include <cstdlib>

// Any bytes from another computer give messages whose values are in range, or none, however the line divides
// them.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace palpable::device;
  const auto bytes = std::as_bytes(std::span(data, size));
  MessageReader whole, divided;
  whole.take(bytes);
  std::size_t taken = 0;
  while (true) {
    const auto message = whole.next();
    auto same = divided.next();
    while (!same && taken < size && !divided.is_broken()) {
      divided.take(bytes.subspan(taken++, 1));
      same = divided.next();
    }
    if (message.has_value() != same.has_value()) std::abort();
    if (!message) break;
    if (message->kind != same->kind || message->body != same->body) std::abort();
    parse_hello(*message);
    parse_welcome(*message);
    parse_refused(*message);
    parse_reading(*message);
    const auto texture = parse_texture(*message);
    if (texture && (texture->number == 0 || texture->tile.size() > kMostTile)) std::abort();
    const auto surface = parse_surface(*message);
    if (surface && !is_valid(*surface)) std::abort();
  }
  return 0;
}
