// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/session/touch/recorded_pairs.hpp"

#include "palpable/sources/live/frame_folder.hpp"
#include "palpable/vision/stereo/problem/synthetic_pair.hpp"

#include <chrono>
#include <cmath>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <thread>

#include <gtest/gtest.h>

namespace palpable::session {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

/// Pairs of 8 bits, numbered 3, 6, 9 ...
class ManyPairs final : public PairSource {
 public:
  Result<std::optional<LivePair>> take(Clock::time_point /*deadline*/) override {
    number_ += 3;
    auto pair = vision::render(vision::slanted_scene());
    for (auto* picture : {&pair.left, &pair.right})
      for (float& sample : picture->samples) sample = std::round(255.0F * sample) / 255.0F;
    return std::optional(LivePair{number_, Clock::now(), std::move(pair.left), std::move(pair.right)});
  }
  bool has_ended() const override { return false; }

 private:
  std::uint64_t number_ = 0;
};

fs::path new_folder(const std::string& name) {
  const fs::path folder = fs::path(testing::TempDir()) / ("recorded-pairs-" + name);
  fs::remove_all(folder);
  return folder;
}

TEST(RecordedPairs, AreShownAgainByAFolder) {
  const auto folder = new_folder("again");
  std::optional<LivePair> last;
  {
    const auto source = recorded_pairs(std::make_unique<ManyPairs>(), folder);
    ASSERT_TRUE(source) << source.error().sentence();
    for (int k = 0; k < 4; ++k) last = **(*source)->take(Clock::now());
    EXPECT_FALSE((*source)->notice());
  }
  const auto frames = sources::FrameFolder::open(folder);
  ASSERT_TRUE(frames) << frames.error().sentence();
  ASSERT_EQ(frames->size(), 4U);
  EXPECT_TRUE(fs::exists(folder / "000012.left.png"));
  const auto pair = frames->pair(3);
  ASSERT_TRUE(pair) << pair.error().sentence();
  EXPECT_EQ(pair->first.samples, last->left.samples);
  EXPECT_EQ(pair->second.samples, last->right.samples);
  EXPECT_EQ(recorded_pairs(std::make_unique<ManyPairs>(), folder).error().code, ErrorCode::usage);
}

TEST(RecordedPairs, SayOnceThatTheyCannotBeWritten) {
  const auto folder = new_folder("lost");
  const auto source = recorded_pairs(std::make_unique<ManyPairs>(), folder);
  ASSERT_TRUE(source);
  fs::remove_all(folder);
  std::optional<std::string> said;
  for (const auto end = Clock::now() + std::chrono::seconds(20); !said && Clock::now() < end;) {
    EXPECT_TRUE(*(*source)->take(Clock::now()));
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
    said = (*source)->notice();
  }
  ASSERT_TRUE(said);
  EXPECT_TRUE(said->starts_with("The pictures are no longer recorded")) << *said;
  EXPECT_TRUE(*(*source)->take(Clock::now()));
  EXPECT_FALSE((*source)->notice());
  EXPECT_EQ(recorded_pairs(std::make_unique<ManyPairs>(), "/proc/none/x").error().code, ErrorCode::failed);
}

}  // namespace
}  // namespace palpable::session
