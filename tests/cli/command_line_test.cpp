// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "program.hpp"
#include <gmock/gmock.h>

namespace palpable::test {
namespace {

using ::testing::HasSubstr;
using ::testing::MatchesRegex;

TEST(CommandLine, TellsItsVersion) {
  const Outcome outcome = palpable({"--version"});
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_THAT(outcome.out, MatchesRegex("palpable [0-9]+\\.[0-9]+\\.[0-9]+\n"));
}

TEST(CommandLine, HelpListsEveryCommandAndTheExitCodes) {
  const Outcome outcome = palpable({"--help"});
  EXPECT_EQ(outcome.exit_code, 0);
  for (const char* command : {"touch", "make", "depth", "probe", "sample", "bench", "show", "info", "export",
                              "score", "devices", "doctor"})
    EXPECT_THAT(outcome.out, HasSubstr(std::string("\n  ") + command));
  EXPECT_THAT(outcome.out, HasSubstr("130 interrupted"));
}

TEST(CommandLine, EveryCommandExplainsItselfWithAnExample) {
  for (const char* command : {"touch", "make", "depth", "probe", "sample", "bench", "show", "info", "export",
                              "devices", "doctor"}) {
    const Outcome outcome = palpable({command, "--help"});
    EXPECT_EQ(outcome.exit_code, 0) << command;
    EXPECT_THAT(outcome.out, HasSubstr(std::string("  palpable ") + command)) << command;
    EXPECT_THAT(outcome.out, HasSubstr("--json")) << command;
  }
}

TEST(CommandLine, WrongUsageIsOneSentenceAndTwo) {
  const std::vector<std::pair<std::vector<std::string>, std::string>> cases{
      {{"tuoch"}, "did you mean touch?"},
      {{"xyzzy"}, "there is no command xyzzy"},
      {{"make", "a.png", "-o", "b.palp", "--metod", "fast"}, "did you mean --method?"},
      {{"make", "a.png"}, "--output"},
      {{"probe"}, "SCENE"},
      {{"doctor", "--threads", "many"}, "--threads"},
      {{"doctor", "stray"}, "stray"},
      {{"bench", "--scene", "a.palp"}, "--path"},
      {{"make", "a.png", "-o", "b.palp", "--size", "10by10"}, "--size"},
      {{"make", "a.png", "-o", "b.palp", "--size", "nanx10x10"}, "--size"},
      {{"show", "a.palp", "-o", "b.png", "--view", "smell"}, "--view"}};
  for (const auto& [arguments, sentence] : cases) {
    const Outcome outcome = palpable(arguments);
    EXPECT_EQ(outcome.exit_code, 2) << outcome.err;
    EXPECT_TRUE(is_one_sentence(outcome.err));
    EXPECT_THAT(outcome.err, HasSubstr(sentence));
    EXPECT_EQ(outcome.out, "");
  }
}

TEST(CommandLine, JsonIsOneObjectAndQuietSaysNothingElse) {
  const Outcome outcome = palpable({"devices", "--json", "--quiet"});
  EXPECT_EQ(outcome.exit_code, 0);
  ASSERT_TRUE(outcome.json().is_object()) << outcome.out;
  EXPECT_FALSE(outcome.json()["devices"].empty());
  EXPECT_EQ(outcome.err, "");
}

TEST(CommandLine, DoctorNamesWhatItLookedAt) {
  const auto findings = palpable({"doctor", "--json"}).json();
  ASSERT_TRUE(findings.is_object());
  std::vector<std::string> names;
  for (const auto& finding : findings["findings"]) names.push_back(finding["name"]);
  EXPECT_THAT(names,
              ::testing::IsSupersetOf({"realtime-priority", "locked-memory", "loopback", "device-rules"}));
}

}  // namespace
}  // namespace palpable::test
