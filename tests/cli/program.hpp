// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <filesystem>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <sys/types.h>

namespace palpable::test {

/// The result of a run of the program.
struct Outcome {
  /// The exit code, or 1000 + the signal that ended it.
  int exit_code = -1;
  std::string out;
  std::string err;
  /// Standard output as JSON; discarded (is_discarded()) if it is none.
  nlohmann::json json() const { return nlohmann::json::parse(out, nullptr, false); }
};

/// A running program.
/// How a program is started as to SIGHUP: with its default action, or ignored as by nohup.
enum class Hangup { by_default, ignored };

class Running {
 public:
  /// `input`: file for standard input; `error`: file for standard error, by default the one that err() reads.
  explicit Running(const std::vector<std::string>& arguments, const std::string& input = "/dev/null",
                   const std::string& error = {}, Hangup hangup = Hangup::by_default);
  ~Running();
  Running(const Running&) = delete;
  Running& operator=(const Running&) = delete;

  void send(int signal) const;
  /// Waits until the program has its own handler for `signal`; false after `patience`.
  bool catches(int signal, std::chrono::seconds patience) const;
  /// Waits until it has used this much processor time; false if it ends earlier, or after `patience`.
  bool works(std::chrono::seconds processor_time, std::chrono::seconds patience) const;
  /// Its output so far.
  std::string out() const;
  std::string err() const;
  /// Waits until `text` appears on standard error or output; false after `patience`.
  bool says(const std::string& text, std::chrono::seconds patience) const;
  /// Waits for its end; kills it after `patience` and fails the test.
  Outcome wait(std::chrono::seconds patience = std::chrono::seconds(100));

 private:
  std::filesystem::path folder_;
  pid_t pid_ = -1;
};

/// Runs the program to its end.
Outcome palpable(const std::vector<std::string>& arguments);

/// The same with standard error on a pseudo-terminal.
Outcome palpable_on_a_terminal(const std::vector<std::string>& arguments);

/// A test with a temporary folder, removed at its end.
class InFolder : public testing::Test {
 protected:
  void SetUp() override;
  void TearDown() override;
  std::string path(const std::string& name) const { return (folder_ / name).string(); }
  std::filesystem::path folder_;
};

void write_text(const std::string& file, const std::string& text);
std::string read_text(const std::string& file);

/// One sentence on standard error: one line, beginning with the program's name.
testing::AssertionResult is_one_sentence(const std::string& err);

}  // namespace palpable::test
