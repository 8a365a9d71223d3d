// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/core/result.hpp"

#include <memory>

#include <gtest/gtest.h>

namespace palpable {
namespace {

Result<int> parse_digit(char c) {
  if (c < '0' || c > '9') return invalid_input("not a digit", "settings.txt");
  return c - '0';
}

TEST(Result, HoldsAValue) {
  const Result<int> seven = parse_digit('7');
  ASSERT_TRUE(seven);
  EXPECT_EQ(*seven, 7);
  EXPECT_EQ(seven.value(), 7);
}

TEST(Result, HoldsAnErrorWithItsCodeAndPlace) {
  const Result<int> none = parse_digit('x');
  ASSERT_FALSE(none.has_value());
  EXPECT_EQ(none.error().code, ErrorCode::invalid_input);
  EXPECT_EQ(none.error().sentence(), "settings.txt: not a digit");
}

TEST(Result, ReturnsAMoveOnlyValue) {
  Result<std::unique_ptr<int>> owned(std::make_unique<int>(3));
  const std::unique_ptr<int> taken = *std::move(owned);
  EXPECT_EQ(*taken, 3);
}

TEST(Result, OfVoidIsDoneOrAnError) {
  EXPECT_TRUE(Result<void>());
  const Result<void> failed(Error{ErrorCode::device, "no answer", "falcon"});
  EXPECT_FALSE(failed);
  EXPECT_EQ(failed.error().sentence(), "falcon: no answer");
}

TEST(Error, IsTheMessageAloneWithoutAPlace) {
  EXPECT_EQ((Error{ErrorCode::failed, "disk full", {}}.sentence()), "disk full");
}

TEST(Error, CodesAreTheExitCodesOfTheCommandLine) {
  EXPECT_EQ(static_cast<int>(ErrorCode::failed), 1);
  EXPECT_EQ(static_cast<int>(ErrorCode::usage), 2);
  EXPECT_EQ(static_cast<int>(ErrorCode::invalid_input), 3);
  EXPECT_EQ(static_cast<int>(ErrorCode::device), 4);
  EXPECT_EQ(static_cast<int>(ErrorCode::interrupted), 130);
}

TEST(ResultDeathTest, NamesTheLineThatUsesAnErrorAsAValue) {
  const Result<int> none = parse_digit('x');
  EXPECT_DEATH(static_cast<void>(none.value()), "bug in palpable: has_value\\(\\).*result.hpp");
}

}  // namespace
}  // namespace palpable
