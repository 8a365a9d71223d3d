// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/core/text/number_text.hpp"

#include <gtest/gtest.h>

namespace palpable {
namespace {

TEST(NumberText, ReadsWhatIsANumber) {
  EXPECT_EQ(finite_number("-1.5e-3"), -1.5e-3);
  EXPECT_EQ(finite_number("+2"), 2.0);
  EXPECT_EQ(whole_number("-9223372036854775808"), INT64_MIN);
  EXPECT_EQ(whole_number("+7"), 7);
}

TEST(NumberText, RefusesAllElse) {
  for (const char* text : {"", "nan", "NaN", "-nan", "inf", "-infinity", "1e999", "-1e999", "1,5", " 1", "1 ",
                           "1m", "+-1", "++1", "0x10", "."})
    EXPECT_FALSE(finite_number(text)) << text;
  for (const char* text : {"", "1.0", "1e3", "9223372036854775808", "+-1", "nan", " 1"})
    EXPECT_FALSE(whole_number(text)) << text;
}

}  // namespace
}  // namespace palpable
