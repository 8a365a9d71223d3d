// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/session/touch/recorded_parts.hpp"

#include <algorithm>
#include <filesystem>
#include <string>

#include <gtest/gtest.h>
#include <unistd.h>

namespace palpable::session {
namespace {

/// The ring of a servo that changes its scene while a recorder takes ticks: as the scene with number n is
/// noted, the ticks that wait are of older scenes, and the next ones are of this one.
class ChangingServo {
 public:
  explicit ChangingServo(std::uint64_t ticks_of_a_scene) : ticks_of_a_scene_(ticks_of_a_scene) {}

  /// The next tick; with the first of each scene that scene is noted, as another thread may do at any time.
  std::optional<device::TouchSample> take(RecordedParts& parts, std::uint64_t until) {
    if (tick_ == until) return std::nullopt;
    const auto scene = static_cast<std::uint32_t>(tick_ / ticks_of_a_scene_ + 1);
    if (tick_ % ticks_of_a_scene_ == 0) parts.note({scene, "{}"});
    device::TouchSample sample;
    sample.tick = tick_++;
    sample.dt_s = 0.001;
    sample.t_s = 0.001 * static_cast<double>(tick_);
    sample.scene_id = scene;
    return sample;
  }

 private:
  std::uint64_t ticks_of_a_scene_;
  std::uint64_t tick_ = 0;
};

/// Number of ticks in the file before which their scene is not described.
std::uint64_t ticks_without_scene(const std::filesystem::path& file, std::uint64_t& ticks) {
  auto reader = *device::RecordingReader::open(file);
  std::vector<std::uint32_t> described;
  std::uint64_t without = 0;
  while (const device::Recording* part = reader->next()) {
    for (const auto& scene : part->scenes) described.push_back(scene.id);
    for (const auto& tick : part->ticks)
      without += std::find(described.begin(), described.end(), tick.scene_id) == described.end() ? 1 : 0;
    ticks += part->ticks.size();
  }
  EXPECT_TRUE(reader->check_end());
  return without;
}

TEST(RecordedParts, DescribeASceneBeforeItsTicksWheneverItIsNoted) {
  // Before, at and behind the number of ticks that are written together; and recorders that come often or
  // late.
  for (const std::uint64_t ticks_of_a_scene : {1U, 7U, 300U, 511U, 512U, 513U, 2000U})
    for (const std::uint64_t at_once : {1U, 50U, 600U, 3000U}) {
      const auto file =
          std::filesystem::path(testing::TempDir()) / (std::to_string(::getpid()) + "-recorded-parts.rec");
      ChangingServo servo(ticks_of_a_scene);
      std::uint64_t until = 0;
      RecordedParts parts([&] { return servo.take(parts, until); });
      auto writer = *device::RecordingWriter::create(file, "{}");
      constexpr std::uint64_t kTicks = 3000;
      while (until < kTicks) {
        until = std::min(kTicks, until + at_once);
        parts.write_to(*writer);
      }
      ASSERT_TRUE(parts.outcome());
      ASSERT_TRUE(writer->finish(0));
      std::uint64_t ticks = 0;
      EXPECT_EQ(ticks_without_scene(file, ticks), 0U) << ticks_of_a_scene << ' ' << at_once;
      EXPECT_EQ(ticks, kTicks);
      std::filesystem::remove(file);
    }
}

}  // namespace
}  // namespace palpable::session
