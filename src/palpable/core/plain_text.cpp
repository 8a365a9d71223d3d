// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/core/plain_text.hpp"

namespace palpable {
namespace {

/// Length in bytes of the control character at the start of the text; 0 if there is none.
std::size_t control_at(std::string_view text) {
  const auto byte = [&](std::size_t k) { return k < text.size() ? static_cast<unsigned char>(text[k]) : 0U; };
  constexpr unsigned kSpace = 0x20, kDelete = 0x7F;
  if (byte(0) < kSpace || byte(0) == kDelete) return text[0] == '\n' || text[0] == '\t' ? 0 : 1;
  // U+0080 ... U+009F
  if (byte(0) == 0xC2 && byte(1) >= 0x80 && byte(1) <= 0x9F) return 2;
  // U+202A ... U+202E
  if (byte(0) == 0xE2 && byte(1) == 0x80 && byte(2) >= 0xAA && byte(2) <= 0xAE) return 3;
  // U+2066 ... U+2069
  if (byte(0) == 0xE2 && byte(1) == 0x81 && byte(2) >= 0xA6 && byte(2) <= 0xA9) return 3;
  return 0;
}

}  // namespace

bool has_control_characters(std::string_view text) {
  for (std::size_t k = 0; k < text.size(); ++k)
    if (control_at(text.substr(k)) > 0) return true;
  return false;
}

std::string without_control_characters(std::string_view text) {
  std::string plain;
  plain.reserve(text.size());
  for (std::size_t k = 0; k < text.size();) {
    const std::size_t bytes = control_at(text.substr(k));
    plain += bytes > 0 ? '?' : text[k];
    k += bytes > 0 ? bytes : 1;
  }
  return plain;
}

}  // namespace palpable
