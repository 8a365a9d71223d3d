// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/voice/voice.hpp"

#include "palpable/core/test_comes_true.hpp"

#include <atomic>
#include <filesystem>
#include <fstream>
#include <iterator>

#include <gtest/gtest.h>
#include <unistd.h>

namespace palpable::voice {
namespace {

using namespace std::chrono_literals;

// The sentences that a fake speaker received.
struct Said {
  std::mutex mutex;
  std::vector<std::string> sentences;
  std::vector<std::string> now() {
    const std::lock_guard lock(mutex);
    return sentences;
  }
};

class FakeSpeaker final : public Speaker {
 public:
  explicit FakeSpeaker(Said& said) : said_(said) {}
  Result<void> say(std::string_view sentence) override {
    const std::lock_guard lock(said_.mutex);
    said_.sentences.emplace_back(sentence);
    return {};
  }

 private:
  Said& said_;
};

TEST(Voice, SpeaksTheFirstAtOnceAndThenTheNewestOfEqualImportance) {
  Said said;
  Voice voice(std::make_unique<FakeSpeaker>(said), {300ms, 10s});
  voice.say(Importance::label, "a");
  ASSERT_TRUE(comes_true([&] { return said.now().size() == 1; }));
  for (const char* label : {"b", "c", "d"}) voice.say(Importance::label, label);
  ASSERT_TRUE(comes_true([&] { return said.now().size() == 2; }));
  EXPECT_EQ(said.now(), (std::vector<std::string>{"a", "d"}));
}

TEST(Voice, DoesNotReplaceAFaultByALabel) {
  Said said;
  Voice voice(std::make_unique<FakeSpeaker>(said), {200ms, 10s});
  voice.say(Importance::label, "first");
  ASSERT_TRUE(comes_true([&] { return said.now().size() == 1; }));
  voice.say(Importance::fault, "fault");
  voice.say(Importance::label, "label");
  ASSERT_TRUE(comes_true([&] { return said.now().size() == 2; }));
  EXPECT_EQ(said.now().back(), "fault");
}

TEST(Voice, DropsASentenceThatIsTooOld) {
  Said said;
  Voice voice(std::make_unique<FakeSpeaker>(said), {300ms, 0ms});
  voice.say(Importance::label, "too late before it is heard");
  std::this_thread::sleep_for(50ms);
  EXPECT_TRUE(said.now().size() <= 1);
  const auto before = said.now().size();
  voice.say(Importance::label, "old");
  std::this_thread::sleep_for(400ms);
  EXPECT_EQ(said.now().size(), before);
}

TEST(Voice, EndsAtOnceWhileASentenceWaits) {
  Said said;
  {
    Voice voice(std::make_unique<FakeSpeaker>(said), {1h, 1h});
    voice.say(Importance::label, "a");
    ASSERT_TRUE(comes_true([&] { return said.now().size() == 1; }));
    voice.say(Importance::label, "b");
  }
  EXPECT_EQ(said.now().size(), 1U);
}

TEST(Speaker, WritesEachSentenceToItsProgramAsOneLine) {
  const auto file = std::filesystem::temp_directory_path() / ("palpable-voice-" + std::to_string(getpid()));
  auto speaker = open_speaking_program({"sh", "-c", "exec cat >>\"$0\"", file.string()});
  ASSERT_TRUE(speaker);
  const auto heard = [&] {
    std::ifstream in(file);
    return std::string(std::istreambuf_iterator<char>(in), {});
  };
  ASSERT_TRUE((*speaker)->say("The device; $(rm -rf /) `does` not\nanswer"));
  EXPECT_TRUE(comes_true([&] { return heard() == "The device; $(rm -rf /) `does` not answer\n"; }))
      << heard();
  ASSERT_TRUE((*speaker)->say("Again"));
  EXPECT_TRUE(comes_true([&] { return heard().ends_with("answer\nAgain\n"); })) << heard();
  speaker->reset();
  std::filesystem::remove(file);
}

TEST(Speaker, FinishesOnlyAfterItsProgramHasSpoken) {
  const auto file = std::filesystem::temp_directory_path() / ("palpable-spoken-" + std::to_string(getpid()));
  auto speaker =
      open_speaking_program({"sh", "-c", "read line; sleep 0.2; echo \"$line\" >\"$0\"", file.string()});
  ASSERT_TRUE(speaker);
  ASSERT_TRUE((*speaker)->say("to the end"));
  (*speaker)->finish();
  std::string line;
  std::getline(std::ifstream(file), line);
  EXPECT_EQ(line, "to the end");
  EXPECT_FALSE((*speaker)->say("again"));
  std::filesystem::remove(file);
}

TEST(Speaker, ReportsAMissingProgram) {
  const auto speaker = open_speaking_program({"palpable-has-no-such-program"});
  ASSERT_FALSE(speaker);
  EXPECT_EQ(speaker.error().sentence(),
            "palpable-has-no-such-program: cannot be started (No such file or directory)");
}

TEST(Speaker, ReportsThatItsProgramHasEnded) {
  auto speaker = open_speaking_program({"true"});
  ASSERT_TRUE(speaker);
  std::this_thread::sleep_for(200ms);
  EXPECT_FALSE((*speaker)->say("Hello"));
}

}  // namespace
}  // namespace palpable::voice
