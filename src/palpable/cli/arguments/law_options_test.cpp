// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/cli/arguments/law_options.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace palpable::cli {
namespace {

using testing::HasSubstr;

TEST(LawOptions, ListTheLawsOfEachKindOfSceneForAnUnknownOne) {
  LawArguments arguments;
  arguments.law = "foo";
  const auto refused = law_parameters(arguments, haptics::Law::proxy);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::usage);
  EXPECT_THAT(refused.error().message, HasSubstr("'foo' is not one of the force laws (reliefs: proxy, "));
  EXPECT_THAT(refused.error().message, HasSubstr("; contours: tracing, groove"));
  EXPECT_THAT(refused.error().message, HasSubstr("; grids: grid"));
}

TEST(LawOptions, SuggestALawOfASimilarName) {
  LawArguments arguments;
  arguments.law = "proxi";
  const auto refused = law_parameters(arguments, haptics::Law::proxy);
  ASSERT_FALSE(refused);
  EXPECT_THAT(refused.error().message, HasSubstr("did you mean proxy?"));
}

}  // namespace
}  // namespace palpable::cli
