// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/core/files/build_id.hpp"

#include <gtest/gtest.h>

namespace palpable {
namespace {

TEST(BuildId, IsTheHashThatTheLinkerWrote) {
  const std::string id = build_id();
  EXPECT_GE(id.size(), 16U);
  EXPECT_EQ(id.find_first_not_of("0123456789abcdef"), std::string::npos) << id;
  EXPECT_EQ(build_id(), id);
}

}  // namespace
}  // namespace palpable
