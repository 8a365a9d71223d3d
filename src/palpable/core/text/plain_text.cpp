// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/core/text/plain_text.hpp"

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

bool is_utf8(std::string_view text) {
  for (std::size_t k = 0; k < text.size();) {
    const auto byte = [&](std::size_t at) {
      return k + at < text.size() ? static_cast<unsigned char>(text[k + at]) : 0U;
    };
    const unsigned first = byte(0);
    const std::size_t more = first < 0x80 ? 0 : first < 0xC2 ? 4 : first < 0xE0 ? 1 : first < 0xF0 ? 2 : 3;
    if (more == 4 || first > 0xF4) return false;
    for (std::size_t i = 1; i <= more; ++i)
      if (byte(i) < 0x80 || byte(i) > 0xBF) return false;
    // Overlong forms, surrogates, and beyond U+10FFFF.
    if ((first == 0xE0 && byte(1) < 0xA0) || (first == 0xED && byte(1) > 0x9F) ||
        (first == 0xF0 && byte(1) < 0x90) || (first == 0xF4 && byte(1) > 0x8F))
      return false;
    k += more + 1;
  }
  return true;
}

std::string with_plain_lines(std::string_view text) {
  constexpr std::string_view kMark = "\xEF\xBB\xBF";
  if (text.starts_with(kMark)) text.remove_prefix(kMark.size());
  std::string plain;
  plain.reserve(text.size());
  for (std::size_t k = 0; k < text.size(); ++k)
    if (text[k] != '\r' || k + 1 == text.size() || text[k + 1] != '\n') plain += text[k];
  return plain;
}

std::string plain_name(std::string_view text) {
  std::string name;
  for (std::size_t k = 0; k < text.size();) {
    const std::size_t control = control_at(text.substr(k));
    const bool is_blank = text[k] == ' ' || text[k] == '\n' || text[k] == '\t';
    if (is_blank && !name.empty() && name.back() != ' ') name += ' ';
    if (!is_blank && control == 0) name += text[k];
    k += control > 0 ? control : 1;
  }
  if (!name.empty() && name.back() == ' ') name.pop_back();
  return name;
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
