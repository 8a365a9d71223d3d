// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/describe/name_keys.hpp"

#include <set>
#include <string>

#include <gtest/gtest.h>

namespace palpable::describe {
namespace {

TEST(NameKeys, AreInitialsAndAllDifferent) {
  const auto keys = name_keys({"High Street", "Mill Lane", "Hope Street", "Rue de la Poste", "Église"});
  EXPECT_EQ(keys[0], "hs");
  EXPECT_EQ(keys[1], "ml");
  EXPECT_EQ(keys[2], "ho");
  EXPECT_EQ(keys[3], "rd");
  EXPECT_EQ(keys[4].size(), 2U);
  EXPECT_EQ(std::set(keys.begin(), keys.end()).size(), keys.size());
}

TEST(NameKeys, AreFoundForNamesInOtherScriptsToo) {
  std::vector<std::string> names;
  for (int i = 0; i < 600; ++i) names.push_back("улица " + std::to_string(i));
  const auto keys = name_keys(names);
  EXPECT_EQ(std::set(keys.begin(), keys.end()).size(), 600U);
  for (const std::string& key : keys) EXPECT_EQ(key.size(), 2U);
}

}  // namespace
}  // namespace palpable::describe
