// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/core/text/number_table.hpp"

#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace palpable {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr std::array<std::string_view, 2> kWanted{"x_m", "y_m"};

TEST(NumberTable, TakesColumnsByNameInAnyOrderAndSkipsOthers) {
  const auto table = parse_number_table("note,y_m,x_m\nhello,2,1\n,-4.5e-3,+3\n", kWanted);
  ASSERT_TRUE(table);
  EXPECT_THAT(table->values, ElementsAre(1.0, 2.0, 3.0, -0.0045));
  EXPECT_EQ(table->rows(), 2U);
  EXPECT_THAT(table->row(1), ElementsAre(3.0, -0.0045));
}

TEST(NumberTable, AcceptsFilesOfSpreadsheets) {
  const auto table = parse_number_table("\xEF\xBB\xBF\"x_m\", \"y_m\"\r\n 1 ,\"2\"\r\n\r\n3,4", kWanted);
  ASSERT_TRUE(table);
  EXPECT_THAT(table->values, ElementsAre(1.0, 2.0, 3.0, 4.0));
}

TEST(NumberTable, NamesTheLineAndTheFault) {
  const auto message = [](std::string_view csv) {
    const auto table = parse_number_table(csv, kWanted);
    return table ? std::string() : table.error().message;
  };
  EXPECT_THAT(message("x_m,y_m\n1,2\n\n3,nan\n"), HasSubstr("line 4: y_m is not a finite number: 'nan'"));
  EXPECT_THAT(message("x_m,y_m\n1,inf\n"), HasSubstr("line 2: y_m"));
  EXPECT_THAT(message("x_m,y_m\n1,1e999\n"), HasSubstr("line 2: y_m"));
  EXPECT_THAT(message("x_m,y_m\n1,2x\n"), HasSubstr("'2x'"));
  EXPECT_THAT(message("x_m,y_m\n1\n"), HasSubstr("line 2: has too few fields"));
  EXPECT_THAT(message("x_m,y_m\n1,\n"), HasSubstr("line 2"));
  EXPECT_THAT(message("x_m,z_m\n1,2\n"), HasSubstr("column y_m is missing"));
  EXPECT_THAT(message("x_m,y_m\n"), HasSubstr("no rows"));
  EXPECT_THAT(message(""), HasSubstr("missing"));
}

TEST(AppendNumber, ReadsBackAsTheSameDouble) {
  std::uint64_t bits = 0x9E3779B97F4A7C15U;
  for (int i = 0; i < 20000; ++i) {
    bits = bits * 6364136223846793005U + 1442695040888963407U;
    double value = 0.0;
    std::memcpy(&value, &bits, sizeof value);
    if (!std::isfinite(value)) continue;
    std::string text;
    append_number(text, value);
    double back = 0.0;
    std::from_chars(text.data(), text.data() + text.size(), back);
    ASSERT_EQ(std::memcmp(&back, &value, sizeof value), 0) << text;
  }
}

TEST(AppendNumber, WritesNothingForWhatIsNotFinite) {
  std::string text;
  append_number(text, std::numeric_limits<double>::quiet_NaN());
  append_number(text, std::numeric_limits<double>::infinity());
  EXPECT_EQ(text, "");
}

}  // namespace
}  // namespace palpable
