// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/page/shelf/making.hpp"

#include "palpable/page/shelf/test_programs.hpp"

#include <chrono>
#include <csignal>
#include <thread>

namespace palpable::page::shelf {
namespace {

struct Ran {
  Result<void> result;
  std::vector<std::string> steps, notes;
};

Ran run(const std::string& commands, MakingLimits limits = {}, std::vector<std::string> hidden = {},
        const std::atomic<bool>& cancel = false) {
  const auto folder = new_folder("making");
  Ran ran;
  MakingNews news;
  news.progress = [&](double fraction, std::string step) {
    ran.steps.push_back(step + " " + std::to_string(static_cast<int>(100.0 * fraction)));
  };
  news.note = [&](std::string note) { ran.notes.push_back(std::move(note)); };
  ran.result = run_making(
      {program_of(folder, commands), {"make", "-o", folder / "out.palp"}, limits, std::move(hidden)}, cancel,
      news);
  return ran;
}

TEST(Making, ReportsProgressAndNotes) {
  const Ran ran =
      run(R"(echo '{"progress":0.25,"step":"Matching"}' >&3; echo '{"note":"two\u001b[31m lines"}' >&3)");
  EXPECT_TRUE(ran.result);
  EXPECT_EQ(ran.steps, std::vector<std::string>{"Matching 25"});
  EXPECT_EQ(ran.notes, std::vector<std::string>{"two[31m lines"});
}

TEST(Making, GivesTheCommandsSentenceWithTheNameThatThePersonKnows) {
  const Ran ran =
      run(R"(echo '{"error":"/tmp/x/ab/photo.png: is damaged"}' >&3; exit 3)", {}, {"/tmp/x/ab/"});
  ASSERT_FALSE(ran.result);
  EXPECT_EQ(ran.result.error().sentence(), "photo.png: is damaged");
}

TEST(Making, SaysThatTheProcessCrashed) {
  const Ran ran = run("kill -SEGV $$");
  ASSERT_FALSE(ran.result);
  EXPECT_EQ(
      ran.result.error().sentence(),
      "working on the scene ended with a fault (signal 11): the file is damaged, or made to do harm; nothing "
      "else was affected");
}

TEST(Making, SurvivesWhateverTheProcessReports) {
  const Ran ran = run(
      R"(head -c 3000000 /dev/zero | tr '\0' 'x' >&3; echo >&3; echo '[1]' >&3; echo '{"progress":"x","note":7}' >&3)"
      R"(; echo '{"progress":1e300}' >&3; head -c 100000 /dev/urandom >&3; exit 1)");
  ASSERT_FALSE(ran.result);
  EXPECT_EQ(ran.result.error().sentence(), "working on the scene failed without a reason (exit code 1)");
}

TEST(Making, EndsAProcessThatTakesTooLong) {
  const Ran asleep = run("sleep 100", {.time = std::chrono::seconds(1)});
  ASSERT_FALSE(asleep.result);
  EXPECT_EQ(asleep.result.error().sentence(), "working on the scene took too long, and was ended");
  const Ran busy = run("while true; do :; done", {.processor_time = std::chrono::seconds(1)});
  ASSERT_FALSE(busy.result);
  EXPECT_EQ(busy.result.error().sentence(), "working on the scene took too long, and was ended");
}

TEST(Making, LimitsMemoryAndFiles) {
  // The limits hold for the children of the process as well.
  const Ran memory =
      run("sleep 0.3; head -c 10 /dev/zero | tail -c 1 > /dev/null; test \"$(ulimit -v)\" = 1048576",
          {.memory_bytes = std::uint64_t{1} << 30U});
  EXPECT_TRUE(memory.result);
  const Ran file =
      run("sleep 0.3; head -c 3000000 /dev/zero > \"$out\" || exit 5", {.file_bytes = 1'000'000});
  EXPECT_FALSE(file.result);
}

TEST(Making, IsCancelledAtOnceWithAllItsProcesses) {
  std::atomic<bool> cancel = false;
  const auto begin = std::chrono::steady_clock::now();
  std::thread person([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(300));
    cancel = true;
  });
  const Ran ran = run("sleep 1000 & sleep 1000", {}, {}, cancel);
  person.join();
  ASSERT_FALSE(ran.result);
  EXPECT_EQ(ran.result.error().code, ErrorCode::interrupted);
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(30)) << "not 1000";
}

TEST(Making, SaysThatTheProgramIsMissing) {
  const std::atomic<bool> cancel = false;
  const auto ran = run_making({"/nothing/palpable", {"make"}, {}, {}}, cancel, {});
  ASSERT_FALSE(ran);
  EXPECT_EQ(ran.error().sentence(), "/nothing/palpable: No such file or directory");
}

}  // namespace
}  // namespace palpable::page::shelf
