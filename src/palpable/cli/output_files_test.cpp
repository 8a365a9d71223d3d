// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/cli/output_files.hpp"

#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace palpable::cli {
namespace {

namespace fs = std::filesystem;

class OutputFiles : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::path(testing::TempDir()) / (std::string("palpable-outputs-") +
                                              testing::UnitTest::GetInstance()->current_test_info()->name());
    fs::remove_all(folder_);
    fs::create_directories(folder_);
    std::ofstream(folder_ / "in.palp") << "x";
  }
  void TearDown() override { fs::remove_all(folder_); }

  /// The code of the error; empty if writing is allowed.
  std::optional<ErrorCode> asked(const std::string& output, const std::vector<std::string>& words = {},
                                 const std::vector<std::string>& suffixes = {}) const {
    const std::string value = output.starts_with('/') ? output : (folder_ / output).string();
    const OutputOption option{nullptr, nullptr, &value, suffixes};
    const auto checked = check_outputs(std::span(&option, 1), words);
    return checked ? std::nullopt : std::optional(checked.error().code);
  }
  std::string path(const std::string& name) const { return (folder_ / name).string(); }
  fs::path folder_;
};

TEST_F(OutputFiles, MayBeNewOrReplaceWhatIsNoInput) {
  EXPECT_FALSE(asked("new.palp", {path("in.palp")}, {".palp"}));
  EXPECT_FALSE(asked("in.palp", {"other.png", "relief"}));
  EXPECT_FALSE(asked("/dev/null", {"/dev/null"}, {".palp"}));
  EXPECT_FALSE(fs::exists(path("new.palp")));
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_), {}), 1);
}

TEST_F(OutputFiles, AreNoInputsByAnyName) {
  fs::create_symlink("in.palp", path("soft.palp"));
  fs::create_hard_link(path("in.palp"), path("hard.palp"));
  for (const std::string name : {"in.palp", "./in.palp", "soft.palp", "hard.palp"}) {
    EXPECT_EQ(asked(name, {path("in.palp")}), ErrorCode::usage) << name;
    EXPECT_EQ(asked(name, {"@" + path("in.palp")}), ErrorCode::usage) << name;
    EXPECT_EQ(asked(name, {"replay:" + path("in.palp")}), ErrorCode::usage) << name;
    EXPECT_EQ(asked(name, {"0:texture=" + path("in.palp") + ",pitch=2"}), ErrorCode::usage) << name;
  }
}

TEST_F(OutputFiles, HaveAFolderAndASuffixOfTheirFormat) {
  EXPECT_EQ(asked("missing/a.palp"), ErrorCode::usage);
  EXPECT_EQ(asked("in.palp/a.palp"), ErrorCode::usage);
  EXPECT_EQ(asked(folder_.string()), ErrorCode::usage);
  EXPECT_EQ(asked("a.foo", {}, {".png", ".svg"}), ErrorCode::usage);
  EXPECT_FALSE(asked("a.svg", {}, {".png", ".svg"}));
}

TEST_F(OutputFiles, AreNotStandardOutput) {
  for (const std::string& name : {std::string("-"), std::string("./-")}) {
    const OutputOption option{nullptr, nullptr, &name, {}};
    const auto checked = check_outputs(std::span(&option, 1), {});
    EXPECT_EQ(static_cast<bool>(checked), name == "./-");
    if (!checked) {
      EXPECT_NE(checked.error().message.find("standard output"), std::string::npos);
    }
  }
}

TEST_F(OutputFiles, AreNotTwoOfOneName) {
  const std::string a = path("a.png"), b = path("./a.png");
  const std::vector<OutputOption> options{{nullptr, nullptr, &a, {}}, {nullptr, nullptr, &b, {}}};
  const auto checked = check_outputs(options, {});
  ASSERT_FALSE(checked);
  EXPECT_EQ(checked.error().code, ErrorCode::usage);
}

TEST_F(OutputFiles, OfAPrefixAreCheckedOneByOne) {
  std::ofstream(folder_ / "p_left.png") << "x";
  const std::string prefix = path("p");
  const OutputOption option{nullptr, nullptr, &prefix, {}, {"_left.png", "_right.png"}};
  const std::vector<std::string> words{path("p_left.png")};
  EXPECT_FALSE(check_outputs(std::span(&option, 1), words));
  EXPECT_TRUE(check_outputs(std::span(&option, 1), {}));
}

}  // namespace
}  // namespace palpable::cli
