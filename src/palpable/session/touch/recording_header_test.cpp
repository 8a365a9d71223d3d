// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/session/touch/recording_header.hpp"

#include <string>

#include <gtest/gtest.h>

namespace palpable::session {
namespace {

TEST(RecordingHeader, SaysWhetherARampLoadsTheSpring) {
  for (const bool loads : {false, true}) {
    RecordedSession session;
    session.tick.ramp_loads = loads;
    const auto read = parse_header(header_json(session));
    ASSERT_TRUE(read) << read.error().sentence();
    EXPECT_EQ(read->tick.ramp_loads, loads);
  }
}

// Its ramp did not, so that its forces are recomputed without.
TEST(RecordingHeader, OfAnOlderProgramHasARampThatLoadsNothing) {
  std::string json = header_json({});
  const std::string key = R"(,"ramp_loads":true)";
  const auto at = json.find(key);
  ASSERT_NE(at, std::string::npos) << json;
  const auto read = parse_header(json.erase(at, key.size()));
  ASSERT_TRUE(read) << read.error().sentence();
  EXPECT_FALSE(read->tick.ramp_loads);
}

}  // namespace
}  // namespace palpable::session
