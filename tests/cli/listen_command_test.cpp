// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/core/files/byte_reader.hpp"
#include "palpable/core/files/byte_writer.hpp"

#include <random>

#include "program.hpp"
#include <gmock/gmock.h>

namespace palpable::test {
namespace {

using ::testing::HasSubstr;

/// Two samples' way from the middle, in the robot's axes: ahead, left, behind, right.
constexpr const char* kArray =
    R"({"frame": "robot", "microphones_m": [[0.0429, 0, 0], [0, 0.0429, 0], [-0.0429, 0, 0], [0, -0.0429, 0]]})";

class Listen : public InFolder {
 protected:
  void SetUp() override {
    InFolder::SetUp();
    write_text(path("array.json"), kArray);
  }
  /// A quiet second, then half a second of noise from the right.
  void write_noise_from_the_right(const std::string& name) const {
    constexpr int kLength = 24'000, kBegin = 16'000;
    constexpr int kLate[] = {2, 4, 2, 0};
    std::mt19937 random(3);
    std::vector<int> noise(kLength);
    for (int i = kBegin; i < kLength; ++i)
      noise[static_cast<std::size_t>(i)] = static_cast<int>(random() % 2001) - 1000;
    ByteWriter file;
    file.text("RIFF"), file.u32(0), file.text("WAVEfmt "), file.u32(16), file.u16(1), file.u16(4);
    file.u32(16'000), file.u32(128'000), file.u16(8), file.u16(16), file.text("data"), file.u32(8 * kLength);
    for (int i = 0; i < kLength; ++i)
      for (const int late : kLate) {
        const int sound = i < late ? 0 : noise[static_cast<std::size_t>(i - late)];
        file.u16(static_cast<std::uint16_t>(sound + static_cast<int>(random() % 21) - 10));
      }
    write_text(path(name), std::string(as_text(file.bytes())));
  }
};

TEST_F(Listen, SaysWhenAndWhereASoundWas) {
  write_noise_from_the_right("noise.wav");
  const Outcome heard =
      palpable({"listen", path("noise.wav"), "--microphones", path("array.json"), "--json"});
  ASSERT_EQ(heard.exit_code, 0) << heard.err;
  const auto json = heard.json();
  EXPECT_EQ(json.at("array"), "level");
  ASSERT_EQ(json.at("sounds").size(), 1U) << heard.out;
  const auto& sound = json["sounds"][0];
  EXPECT_NEAR(sound.at("azimuth_deg"), 90.0, 1.0);
  EXPECT_TRUE(sound.at("elevation_deg").is_null());
  EXPECT_NEAR(sound.at("time_s"), 0.75, 0.3) << "the window in which it begins";
  EXPECT_EQ(sound.at("words"), "to the right");
  const Outcome said = palpable({"listen", path("noise.wav"), "--microphones", path("array.json")});
  EXPECT_THAT(said.out, HasSubstr("to the right (90 degrees right)"));
}

TEST_F(Listen, WhatDoesNotFitIsRefused) {
  write_noise_from_the_right("noise.wav");
  write_text(path("three.json"), R"({"microphones_m": [[0.1, 0, 0], [-0.1, 0, 0], [0, 0, 0.1]]})");
  write_text(path("line.json"), R"({"microphones_m": [[0, 0, 0], [0.1, 0, 0], [0.2, 0, 0], [0.3, 0, 0]]})");
  const std::pair<const char*, const char*> wrong[] = {{"noise.wav", "three.json"},
                                                       {"noise.wav", "line.json"},
                                                       {"noise.wav", "none.json"},
                                                       {"noise.wav", "noise.wav"},
                                                       {"array.json", "array.json"}};
  for (const auto& [recording, array] : wrong) {
    const Outcome refused = palpable({"listen", path(recording), "--microphones", path(array)});
    EXPECT_EQ(refused.exit_code, 3) << recording << ", " << array;
    EXPECT_TRUE(is_one_sentence(refused.err)) << refused.err;
  }
  EXPECT_EQ(palpable({"listen", path("noise.wav")}).exit_code, 2);
}

}  // namespace
}  // namespace palpable::test
