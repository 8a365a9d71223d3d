// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sources/isolated/flat.hpp"

#include "palpable/core/text/plain_text.hpp"

#include <algorithm>

namespace palpable::sources::isolated {
namespace {

constexpr std::uint8_t kValue = 0x56, kError = 0x45;
constexpr std::size_t kLongestMessage = 400;

}  // namespace

std::string FlatReader::get_text(std::size_t longest) {
  const auto raw = get_bytes(get<std::uint64_t>());
  std::string text(reinterpret_cast<const char*>(raw.data()), std::min(raw.size(), longest));
  std::replace(text.begin(), text.end(), '\n', ' ');
  return without_control_characters(text);
}

Error invalid_reply() { return invalid_input("is damaged: its decoder gave an invalid result"); }

std::vector<std::byte> error_reply(const Error& error) {
  FlatWriter reply;
  reply.put(kError);
  reply.put_text(error.message);
  return reply.take();
}

void begin_value(FlatWriter& reply) { reply.put(kValue); }

Result<void> open_reply(FlatReader& reply) {
  const auto kind = reply.get<std::uint8_t>();
  if (kind == kValue) return {};
  if (kind != kError) return invalid_reply();
  const std::string message = reply.get_text(kLongestMessage);
  if (!reply.done() || message.empty()) return invalid_reply();
  return invalid_input(message);
}

}  // namespace palpable::sources::isolated
