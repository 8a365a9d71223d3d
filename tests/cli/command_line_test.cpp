// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include <regex>

#include "program.hpp"
#include <gmock/gmock.h>

namespace palpable::test {
namespace {

using ::testing::HasSubstr;
using ::testing::MatchesRegex;

TEST(CommandLine, PrintsItsVersion) {
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

TEST(CommandLine, EveryDefaultIsInTheRangeThatTheHelpStates) {
  const std::regex command(R"(\n  ([a-z][a-z-]*) )");
  const std::regex number(R"((--[a-z-]+) NUMBER, (\S+) to (\S+) \(default (\S+)\))");
  const std::string list = palpable({"help"}).out;
  int numbers = 0;
  for (std::sregex_iterator c(list.begin(), list.end(), command), none; c != none; ++c) {
    const std::string help = palpable({"help", (*c)[1]}).out;
    for (std::sregex_iterator n(help.begin(), help.end(), number); n != none; ++n, ++numbers) {
      const double value = std::stod((*n)[4]);
      EXPECT_TRUE(value >= std::stod((*n)[2]) && value <= std::stod((*n)[3])) << (*c)[1] << ": " << n->str();
    }
  }
  EXPECT_GT(numbers, 5);
}

TEST(CommandLine, TouchNamesLiveFrames) {
  EXPECT_THAT(palpable({"help", "touch"}).out, HasSubstr("frames:"));
}

TEST(CommandLine, HelpCommandEqualsHelpOption) {
  EXPECT_EQ(palpable({"help"}).out, palpable({"--help"}).out);
  for (const char* command : {"touch", "make", "export"}) {
    const Outcome outcome = palpable({"help", command});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_EQ(outcome.out, palpable({command, "--help"}).out);
  }
  EXPECT_EQ(palpable({"help", "score", "disparity"}).out, palpable({"score", "disparity", "--help"}).out);
  const Outcome wrong = palpable({"help", "tuoch"});
  EXPECT_EQ(wrong.exit_code, 2);
  EXPECT_THAT(wrong.err, HasSubstr("did you mean touch?"));
}

TEST(CommandLine, AWrongValueListsTheValidOnes) {
  const std::vector<std::pair<std::vector<std::string>, std::vector<std::string>>> cases{
      {{"touch", "a.png", "--law", "bogus"}, {"--law", "'bogus'", "proxy", "tracing", "groove"}},
      {{"touch", "a.png", "--law", "rollin"}, {"did you mean rolling?"}},
      {{"touch", "a.png", "--as", "bogus"}, {"--as", "relief, contours, field, grid"}},
      {{"make", "a.png", "-o", "b.palp", "--kind", "bogus"}, {"--kind", "picture, stereo, depth, mesh"}},
      {{"make", "a.png", "-o", "b.palp", "--method", "bogus"}, {"--method", "scanline", "graph-cut"}},
      {{"make", "a.png", "-o", "b.palp", "--ground", "bogus"}, {"--ground", "keep, flatten, remove"}},
      {{"show", "a.palp", "-o", "b.png", "--view", "smell"}, {"--view", "relief, depth, force, section"}},
      {{"touch", "--rate", "5"}, {"--rate", "'5' is not a number from 100 to 4000"}},
      {{"touch", "--port", "1.5"}, {"--port", "'1.5' is not a whole number from 0 to 65535"}}};
  for (const auto& [arguments, words] : cases) {
    const Outcome outcome = palpable(arguments);
    EXPECT_EQ(outcome.exit_code, 2) << outcome.err;
    EXPECT_TRUE(is_one_sentence(outcome.err));
    for (const std::string& word : words) EXPECT_THAT(outcome.err, HasSubstr(word));
  }
}

TEST(CommandLine, WrongUsageIsOneSentenceAndExitCodeTwo) {
  const std::vector<std::pair<std::vector<std::string>, std::string>> cases{
      {{"tuoch"}, "did you mean touch?"},
      {{"xyzzy"}, "there is no command xyzzy"},
      {{"make", "a.png", "-o", "b.palp", "--metod", "fast"}, "did you mean --method?"},
      {{"make", "a.png"}, "--output"},
      {{"probe"}, "SCENE"},
      {{"doctor", "--threads", "many"}, "--threads"},
      {{"doctor", "stray"}, "stray"},
      {{"bench", "--scene", "a.palp"}, "--path"},
      {{"bench", "--passes", "3"}, "--scene"},
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

TEST(CommandLine, JsonIsOneObjectAndQuietPrintsNothingElse) {
  const Outcome outcome = palpable({"devices", "--json", "--quiet"});
  EXPECT_EQ(outcome.exit_code, 0);
  ASSERT_TRUE(outcome.json().is_object()) << outcome.out;
  EXPECT_FALSE(outcome.json()["devices"].empty());
  EXPECT_EQ(outcome.err, "");
}

TEST(CommandLine, DoctorNamesItsChecks) {
  const auto findings = palpable({"doctor", "--json"}).json();
  ASSERT_TRUE(findings.is_object());
  std::vector<std::string> names;
  for (const auto& finding : findings["findings"]) names.push_back(finding["name"]);
  EXPECT_THAT(names, ::testing::IsSupersetOf({"realtime-priority", "locked-memory", "loopback",
                                              "device-rules", "modem-manager"}));
}

TEST(CommandLine, DoctorPrintsTheRulesOfTheDocuments) {
  std::ifstream file(PALPABLE_SAMPLES "/../docs/devices.md");
  const std::string page{std::istreambuf_iterator<char>(file), {}};
  const Outcome outcome = palpable({"doctor", "--rules"});
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_THAT(page, HasSubstr("```text\n" + outcome.out + "```"));
}

TEST(CommandLine, MeasuresNoHandOnARecording) {
  const Outcome outcome = palpable({"doctor", "--measure-hand", "replay:touch.rec"});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.err, HasSubstr("a recording does not move when it is pushed"));
}

TEST(CommandLine, MeasuresNoSimulatedHandThatExplores) {
  const Outcome outcome = palpable({"doctor", "--measure-hand", "sim:?seed=3"});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.err, HasSubstr("add script=hold"));
}

TEST(CommandLine, NamesADeviceOnceInAnErrorAndAsksForNoButtonThatItLacks) {
  const Outcome twice = palpable({"touch", "sample:drawing", "--device", "2diy:", "--device", "2diy:"});
  EXPECT_EQ(twice.exit_code, 2);
  EXPECT_THAT(twice.err, HasSubstr(" 2diy: the device is named twice"));
  const Outcome stop = palpable({"touch", "sample:drawing", "--device", "2diy:", "--stop-button", "1"});
  EXPECT_EQ(stop.exit_code, 2);
  EXPECT_THAT(stop.err, HasSubstr("this device has no button"));
}

TEST(CommandLine, ListsWhatToDoForEachKindOfDevice) {
  const auto listed = palpable({"devices", "--json"}).json();
  for (const auto& kind : listed["devices"])
    EXPECT_NE(kind["available"].get<bool>(), !kind["advice"].get<std::string>().empty()) << kind.dump();
}

}  // namespace
}  // namespace palpable::test
