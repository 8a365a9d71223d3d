// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/page/share/qr_code.hpp"

#include <algorithm>
#include <array>
#include <string>

#include <gtest/gtest.h>

namespace palpable::page {
namespace {

constexpr const char* kLink = "https://192.168.100.200:65535/#0123456789abcdef0123456789abcdef";

// A finder pattern: rings of dark, light and dark modules (ISO/IEC 18004, 6.3.3).
bool has_finder(const QrCode& code, int left, int top) {
  for (int y = 0; y < 7; ++y) {
    for (int x = 0; x < 7; ++x) {
      const int ring = std::min({x, y, 6 - x, 6 - y});
      if (code.is_dark(left + x, top + y) != (ring != 1)) return false;
    }
  }
  return true;
}

TEST(QrCode, HoldsALinkWithItsThreeFinderPatterns) {
  const auto code = qr_code(kLink);
  ASSERT_TRUE(code);
  EXPECT_EQ((code->side - 17) % 4, 0);
  EXPECT_EQ(code->modules.size(), static_cast<std::size_t>(code->side * code->side));
  EXPECT_TRUE(has_finder(*code, 0, 0));
  EXPECT_TRUE(has_finder(*code, code->side - 7, 0));
  EXPECT_TRUE(has_finder(*code, 0, code->side - 7));
  EXPECT_NE(qr_code(std::string(kLink) + "0")->modules, code->modules);
}

TEST(QrCode, IsDrawnWithItsMarginOnATerminal) {
  const auto code = qr_code(kLink);
  ASSERT_TRUE(code);
  const std::string text = terminal_text(*code);
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), (code->side + 8 + 1) / 2);
  // The margin's four rows are two lines of spaces.
  const std::string blank =
      "\x1b[38;5;16;48;5;231m" + std::string(static_cast<std::size_t>(code->side) + 8, ' ') + "\x1b[0m\n";
  EXPECT_TRUE(text.starts_with(blank + blank));
  EXPECT_FALSE(text.starts_with(blank + blank + blank));
}

TEST(QrCode, RefusesWhatIsEmptyOrTooLong) {
  EXPECT_FALSE(qr_code(""));
  EXPECT_FALSE(qr_code(std::string(5000, 'x')));
}

}  // namespace
}  // namespace palpable::page
