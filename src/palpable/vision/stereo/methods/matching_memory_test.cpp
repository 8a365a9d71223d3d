// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/stereo/methods/matching_memory.hpp"

#include "palpable/vision/stereo/methods/match.hpp"

#include <cstdio>

#include <gmock/gmock.h>

namespace palpable::vision {
namespace {

constexpr std::size_t kGigabyte = 1'000'000'000;

TEST(MatchingMemory, GrowsWithPixelsAndNeverFallsWithDisparities) {
  for (const StereoMethod method : available_stereo_methods()) {
    const double one = matching_memory_bytes(method, 1000, 800, 64);
    EXPECT_GT(one, 4e7) << name_of(method);
    EXPECT_DOUBLE_EQ(matching_memory_bytes(method, 2000, 1600, 64), 4.0 * one) << name_of(method);
    EXPECT_GE(matching_memory_bytes(method, 1000, 800, 128), one) << name_of(method);
  }
}

TEST(MatchingMemory, PicturesThatFitAreTaken) {
  for (const StereoMethod method : available_stereo_methods())
    EXPECT_TRUE(check_matching_memory(method, 1000, 800, 64, 2 * kGigabyte)) << name_of(method);
}

TEST(MatchingMemory, PicturesThatDoNotFitAreRefusedWithASizeThatDoes) {
  for (const StereoMethod method : available_stereo_methods()) {
    const auto refused = check_matching_memory(method, 8192, 8192, 512, 2 * kGigabyte);
    ASSERT_FALSE(refused) << name_of(method);
    EXPECT_EQ(refused.error().code, ErrorCode::failed);
    const std::string& sentence = refused.error().message;
    EXPECT_THAT(sentence, testing::HasSubstr("8192 x 8192"));
    EXPECT_THAT(sentence, testing::HasSubstr("2.0 GB are available"));
    int width = 0, height = 0;
    const auto at = sentence.find("scale them to ");
    ASSERT_NE(at, std::string::npos) << sentence;
    ASSERT_EQ(std::sscanf(sentence.c_str() + at, "scale them to %d x %d", &width, &height), 2) << sentence;
    EXPECT_TRUE(check_matching_memory(method, width, height, 512, 2 * kGigabyte)) << sentence;
  }
}

}  // namespace
}  // namespace palpable::vision
