// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/cli/arguments/parameter_groups.hpp"

#include <set>
#include <string>

#include <gmock/gmock.h>

namespace palpable::cli {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

TEST(ParameterGroups, HaveDocumentedParametersWhoseDefaultsLieInTheirRanges) {
  std::set<std::string> names;
  for (const ParameterGroup& group : parameter_groups()) {
    const bool is_tuned = group.name != "video";
    EXPECT_EQ(is_tuned, !group.tuned_on.empty()) << group.name;
    SettableOptions options;
    const auto parameters = parameters_of(group, options);
    EXPECT_THAT(parameters, Not(IsEmpty())) << group.name;
    EXPECT_TRUE(check_parameters(parameters)) << group.name;
    for (const Parameter& p : parameters) {
      EXPECT_TRUE(names.insert(p.name).second) << p.name;
      EXPECT_THAT(p.meaning, Not(IsEmpty())) << p.name;
    }
  }
}

TEST(ParameterGroups, AreSetByNameWithinTheirRanges) {
  SettableOptions options;
  const auto known = parameters_of(*find_group("field"), options);
  const std::vector<std::string> given{"field.walls.least_cells=3", "field.resolution=256"};
  ASSERT_TRUE(set_parameters(given, known, "field"));
  EXPECT_EQ(options.recipes.field.walls.least_cells, 3.0);
  EXPECT_EQ(options.recipes.field.field.resolution, 256);
  const auto refusal = [&](const std::string& assignment) {
    const auto set = set_parameters(std::vector{assignment}, known, "field");
    return set ? "taken" : set.error().sentence();
  };
  EXPECT_THAT(refusal("field.resolution=8"), HasSubstr("must lie between 16 and 4096"));
  EXPECT_THAT(refusal("field.resolution=100.5"), HasSubstr("whole number"));
  EXPECT_THAT(refusal("field.resolutoin=100"), HasSubstr("did you mean field.resolution?"));
  EXPECT_THAT(refusal("field.resolution=many"), HasSubstr("not a number"));
  EXPECT_THAT(refusal("field.resolution"), HasSubstr("NAME=VALUE"));
  EXPECT_EQ(find_group("bogus"), nullptr);
  const auto twice =
      set_parameters(std::vector<std::string>{"field.resolution=64", "field.resolution=128"}, known, "field");
  ASSERT_FALSE(twice);
  EXPECT_THAT(twice.error().sentence(), HasSubstr("field.resolution is given more than once"));
}

}  // namespace
}  // namespace palpable::cli
