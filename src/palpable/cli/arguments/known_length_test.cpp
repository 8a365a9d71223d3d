// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/cli/arguments/known_length.hpp"

#include <gtest/gtest.h>

namespace palpable::cli {
namespace {

TEST(KnownLength, IsReadWithItsUnitPlacesAndFrame) {
  const auto length = known_length_from("12.5 cm between 210,240.5 and 330,250 of frame 40");
  ASSERT_TRUE(length) << length.error().sentence();
  EXPECT_DOUBLE_EQ(length->length_m, 0.125);
  EXPECT_EQ(length->frame_number, 40);
  EXPECT_EQ(length->from, (vision::ImagePoint{210, 240.5}));
  EXPECT_EQ(length->to, (vision::ImagePoint{330, 250}));
  EXPECT_DOUBLE_EQ(known_length_from("120 mm between 1,2 and 3,4 of frame 0")->length_m, 0.12);
  EXPECT_DOUBLE_EQ(known_length_from("2 m between 1,2 and 3,4 of frame 0")->length_m, 2.0);
}

TEST(KnownLength, IsRefusedWithAnExample) {
  for (const char* text :
       {"", "120", "120 mm", "120 km between 1,2 and 3,4 of frame 0", "0 mm between 1,2 and 3,4 of frame 0",
        "-3 mm between 1,2 and 3,4 of frame 0", "5 mm between 1,2 and 1,2 of frame 0",
        "5 mm between 1 and 3,4 of frame 0", "5 mm between 1,2 and 3,4 of frame 1.5",
        "5 mm between 1,2 and 3,4 of frame -1", "5 mm between 1,2 and 3,4 of frame 1 please"}) {
    const auto length = known_length_from(text);
    ASSERT_FALSE(length) << text;
    EXPECT_EQ(length.error().code, ErrorCode::usage);
    EXPECT_NE(length.error().message.find("between 210,240"), std::string::npos);
  }
}

}  // namespace
}  // namespace palpable::cli
