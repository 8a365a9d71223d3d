// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/cli/help_format.hpp"

#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace palpable::cli {
namespace {

using testing::HasSubstr;
using testing::Not;

/// A command with one option of each kind.
struct TestCommand {
  TestCommand() {
    app.formatter(help_format());
    app.add_option("INPUT", inputs)->expected(1, 2);
    app.add_option("--size", size)->check(CLI::Validator("[1 to 5]"))->capture_default_str();
    app.add_option("--as", kind)->check(CLI::Validator("{relief,field}"));
    app.add_flag("--json", json)->disable_flag_override();
  }
  std::string complaint(const std::string& line) {
    try {
      app.parse(line);
    } catch (const CLI::ParseError& error) {
      return mismatch_sentence(error.what());
    }
    return {};
  }

  CLI::App app{"A test", "palpable test"};
  std::vector<std::string> inputs;
  double size = 2.0;
  std::string kind;
  bool json = false;
};

TEST(HelpFormat, ShowsArgumentsRangesAndChoicesPlainly) {
  const std::string help = TestCommand().app.help();
  EXPECT_THAT(help, HasSubstr("palpable test [OPTION...] [INPUT...]"));
  EXPECT_THAT(help, HasSubstr("--size NUMBER, 1 to 5 (default 2)"));
  EXPECT_THAT(help, HasSubstr("--as relief|field"));
  EXPECT_THAT(help, Not(HasSubstr("FLOAT")));
  EXPECT_THAT(help, Not(HasSubstr("1x")));
}

TEST(HelpFormat, SaysWhatIsWrongWithTheNumberOfValues) {
  EXPECT_EQ(TestCommand().complaint("--size"), "--size needs a value");
  EXPECT_EQ(TestCommand().complaint("--size 2 --size 3"), "--size is given more than once");
  EXPECT_EQ(TestCommand().complaint("--json=3"), "--json takes no value");
}

}  // namespace
}  // namespace palpable::cli
