// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/cli/output_files.hpp"

#include "palpable/cli/program.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <sys/stat.h>

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
                                 const std::vector<std::string>& suffixes = {},
                                 const std::vector<std::string>& arguments = {}) const {
    const std::string value = output.starts_with('/') ? output : (folder_ / output).string();
    const OutputOption option{nullptr, nullptr, &value, suffixes};
    const auto checked = check_outputs(std::span(&option, 1), {words, arguments});
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
    EXPECT_EQ(asked(name, {"replay:" + path("in.palp") + "?"}), ErrorCode::usage) << name;
    EXPECT_EQ(asked(name, {"replay:" + path("in.palp") + "?loop=1&x=2"}), ErrorCode::usage) << name;
    EXPECT_EQ(asked(name, {"sim:?motors=" + path("in.palp") + "&dof=2"}), ErrorCode::usage) << name;
    EXPECT_EQ(asked(name, {"0:texture=" + path("in.palp") + ",pitch=2"}), ErrorCode::usage) << name;
  }
}

TEST_F(OutputFiles, AreNoInputsWhoseNamesHoldMarks) {
  for (const std::string name : {"a,b?c&d.palp", "a=b:c@d.palp", "ends,", "?"}) {
    std::ofstream(folder_ / name) << "x";
    EXPECT_EQ(asked(name, {path(name)}), ErrorCode::usage) << name;
    EXPECT_EQ(asked(name, {"replay:" + path(name)}), ErrorCode::usage) << name;
  }
  // Many parts take no time.
  EXPECT_FALSE(asked("in.palp", {std::string(100'000, '='), std::string(4000, ',')}));
}

TEST_F(OutputFiles, AreNoFilesOfAFolderThatIsRead) {
  fs::create_directories(folder_ / "frames");
  for (const char* name : {"0.depth.png", "0.pose.txt", "intrinsics.K.txt", "depth.json", "old.palp"})
    std::ofstream(folder_ / "frames" / name) << "x";
  std::ofstream(folder_ / "target.png") << "x";
  fs::create_symlink("../target.png", folder_ / "frames" / "1.depth.png");
  fs::create_directory_symlink("frames", path("link"));
  for (const std::string& argument : {path("frames"), "frames:" + path("frames") + "?fps=30&loop=1",
                                      "frames:" + path("link"), path("frames") + "/"}) {
    const auto of = [&](const std::string& name) { return asked(name, {}, {}, {argument}); };
    for (const char* name : {"frames/0.depth.png", "frames/0.pose.txt", "link/intrinsics.K.txt",
                             "frames/../frames/depth.json", "target.png", "frames/1.depth.png"})
      EXPECT_EQ(of(name), ErrorCode::usage) << name << " of " << argument;
    EXPECT_FALSE(of("frames/new.rec")) << argument;
    EXPECT_FALSE(of("frames/old.palp")) << argument;
    EXPECT_FALSE(of("in.palp")) << argument;
  }
  // The value of an option names a file.
  EXPECT_FALSE(asked("frames/0.depth.png", {path("frames")}));
}

TEST_F(OutputFiles, AreNoSidecars) {
  for (const char* name : {"d.png", "d.png.json", "d.json", "depth.json", "e.json"})
    std::ofstream(folder_ / name) << "x";
  for (const char* name : {"d.png.json", "d.json", "depth.json"})
    EXPECT_EQ(asked(name, {}, {}, {path("d.png")}), ErrorCode::usage) << name;
  EXPECT_FALSE(asked("e.json", {}, {}, {path("d.png")}));
  // What a command made of points may be made again.
  std::ofstream(folder_ / "points.ply") << "ply\nformat ascii 1.0\nelement vertex 0\nend_header\n";
  std::ofstream(folder_ / "points.json") << "x";
  EXPECT_FALSE(asked("points.json", {}, {}, {path("points.ply")}));
}

TEST_F(OutputFiles, AreNoPipeThatIsRead) {
  ASSERT_EQ(mkfifo(path("pipe").c_str(), S_IRUSR | S_IWUSR), 0);
  EXPECT_EQ(asked("pipe", {path("pipe")}), ErrorCode::usage);
  EXPECT_FALSE(asked("pipe", {path("in.palp")}));
}

TEST_F(OutputFiles, InAFolderReplaceNoInput) {
  fs::create_directories(folder_ / "out");
  std::ofstream(folder_ / "out" / "depth.json") << "x";
  const auto into = [&](const std::string& name, const InputWords& inputs) {
    const std::string value = path(name);
    const OutputOption option{nullptr, nullptr, &value, {}, nullptr, OutputOption::Kind::folder};
    return check_outputs(std::span(&option, 1), inputs);
  };
  EXPECT_TRUE(into("out", {{path("in.palp")}, {}}));
  EXPECT_TRUE(into("new", {{path("in.palp")}, {}}));
  EXPECT_FALSE(into("in.palp", {}));
  EXPECT_FALSE(into("out", {{path("out/depth.json")}, {}}));
  EXPECT_FALSE(into("out", {{}, {path("out")}}));
  fs::create_hard_link(path("in.palp"), path("out/0001.png"));
  EXPECT_FALSE(into("out", {{path("in.palp")}, {}}));
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

TEST_F(OutputFiles, AreNotTwoOfOneNameThroughALink) {
  fs::create_directory_symlink(".", path("link"));
  const std::string a = path("new.png"), b = path("link/new.png");
  const std::vector<OutputOption> options{{nullptr, nullptr, &a, {}}, {nullptr, nullptr, &b, {}}};
  EXPECT_FALSE(check_outputs(options, {}));
}

TEST_F(OutputFiles, OfOneOptionAreCheckedOneByOne) {
  std::ofstream(folder_ / "p_left.png") << "x";
  const std::string prefix = path("p");
  const auto files_for = [](const std::string& value) {
    return std::vector{value + "_left.png", value + "_right.png"};
  };
  const OutputOption option{nullptr, nullptr, &prefix, {}, files_for};
  EXPECT_FALSE(check_outputs(std::span(&option, 1), {{path("p_left.png")}, {}}));
  EXPECT_TRUE(check_outputs(std::span(&option, 1), {}));
}

/// Calls `visit` for each command, also those below another.
void for_each_command(CLI::App& app, const std::function<void(CLI::App&)>& visit) {
  for (CLI::App* command : app.get_subcommands([](CLI::App*) { return true; })) {
    visit(*command);
    for_each_command(*command, visit);
  }
}

bool is_output(const Program& program, const CLI::Option* option) {
  return std::any_of(program.outputs.begin(), program.outputs.end(),
                     [&](const OutputOption& output) { return output.option == option; });
}

/// The options of a command that take values, by their numbers, and not those that name what it writes.
std::vector<std::size_t> inputs_of(const Program& program, CLI::App& command) {
  const auto options = command.get_options();
  std::vector<std::size_t> numbers;
  for (std::size_t k = 0; k < options.size(); ++k)
    if (options[k]->get_expected_max() != 0 && !is_output(program, options[k])) numbers.push_back(k);
  return numbers;
}

/// All that an option may write for this value.
std::vector<std::string> written_by(const OutputOption& output, const std::string& value) {
  if (output.kind == OutputOption::Kind::folder) return {value + "/depth.json"};
  return output.files_for ? output.files_for(value) : std::vector{value};
}

// Every output of every command refuses every input of that command.
TEST_F(OutputFiles, OfEveryCommandAreNoneOfItsInputs) {
  Program program;
  add_commands(program);
  std::size_t pairs = 0;
  for_each_command(program.app, [&](CLI::App& command) {
    for (OutputOption output : program.outputs) {
      if (output.command != &command) continue;
      const std::string value = path("o" + (output.suffixes.empty() ? ".palp" : output.suffixes.front()));
      output.value = &value;
      for (const std::size_t input : inputs_of(program, command))
        for (const std::string& file : written_by(output, value)) {
          fs::create_directories(fs::path(file).parent_path());
          std::ofstream(file) << "x";
          CLI::Option& named = *command.get_options()[input];
          named.add_result(file);
          const auto checked = check_outputs(command, std::span(&output, 1));
          named.clear();
          EXPECT_TRUE(!checked && checked.error().code == ErrorCode::usage)
              << command.get_name() << ' ' << output.option->get_name() << ' ' << file << " also as "
              << named.get_name();
          EXPECT_TRUE(fs::exists(file));
          fs::remove_all(value);
          fs::remove(file);
          ++pairs;
        }
    }
  });
  EXPECT_GT(pairs, 300U);
}

TEST_F(OutputFiles, AreDeclaredForEveryOptionThatWrites) {
  Program program;
  add_commands(program);
  std::size_t outputs = 0;
  for_each_command(program.app, [&](CLI::App& command) {
    for (const CLI::Option* option : command.get_options()) {
      const std::string& help = option->get_description();
      const bool writes = option->get_expected_max() != 0 &&
                          (help.find("rite ") != std::string::npos || help.find("Record ") == 0);
      outputs += is_output(program, option) ? 1 : 0;
      if (writes) {
        EXPECT_TRUE(is_output(program, option)) << command.get_name() << ' ' << option->get_name();
      }
    }
  });
  EXPECT_GE(outputs, 20U);
}

}  // namespace
}  // namespace palpable::cli
