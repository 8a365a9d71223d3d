// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/page/shelf/making.hpp"

#include "palpable/core/system/child_process.hpp"
#include "palpable/core/text/plain_text.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <optional>
#include <thread>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <poll.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace palpable::page::shelf {
namespace {

using Clock = std::chrono::steady_clock;
using std::chrono::milliseconds;

constexpr std::size_t kLongestLine = 16384;
constexpr std::size_t kLongestReport = 1200;
constexpr milliseconds kStep{100};
/// The number of the pipe in the process: start_child() passes its first descriptor as this one.
constexpr const char* kPipe = "3";

void limit(pid_t process, __rlimit_resource what, std::uint64_t least, std::uint64_t most) {
  const rlimit values{static_cast<rlim_t>(least), static_cast<rlim_t>(most)};
  static_cast<void>(::prlimit(process, what, &values, nullptr));
}

/// Set right after the start: the process reads its files much later.
void confine(pid_t process, const MakingLimits& limits) {
  const auto seconds = static_cast<std::uint64_t>(limits.processor_time.count());
  limit(process, RLIMIT_AS, limits.memory_bytes, limits.memory_bytes);
  limit(process, RLIMIT_FSIZE, limits.file_bytes, limits.file_bytes);
  limit(process, RLIMIT_CPU, seconds, seconds + 5);
  limit(process, RLIMIT_CORE, 0, 0);
  if (limits.niceness != 0) ::setpriority(PRIO_PROCESS, static_cast<id_t>(process), limits.niceness);
}

/// What the process reports, line by line.
class Reports {
 public:
  Reports(const Making& making, const MakingNews& news) : making_(making), news_(news) {}

  void add(std::string_view bytes) {
    for (const char c : bytes) {
      if (c == '\n') {
        take(std::exchange(line_, {}));
      } else if (line_.size() < kLongestLine) {
        line_.push_back(c);
      }
    }
  }
  /// The command's error, if it reported one.
  const std::optional<Error>& error() const { return error_; }

 private:
  void take(const std::string& line) {
    const auto report = nlohmann::json::parse(line, nullptr, false);
    if (!report.is_object()) return;
    const auto text = [&](const char* name) {
      const auto found = report.find(name);
      return found != report.end() && found->is_string() ? shown(found->get<std::string>()) : std::string();
    };
    const auto fraction = report.find("progress");
    if (fraction != report.end() && fraction->is_number())
      news_.progress(std::clamp(fraction->get<double>(), 0.0, 1.0), text("step"));
    if (report.contains("note")) news_.note(text("note"));
    if (report.contains("error")) error_ = Error{ErrorCode::failed, text("error"), {}};
  }

  std::string shown(std::string sentence) const {
    for (const std::string& folder : making_.hidden_folders)
      for (auto at = sentence.find(folder); at != std::string::npos; at = sentence.find(folder, at))
        sentence.erase(at, folder.size());
    sentence = plain_name(sentence);
    if (sentence.size() <= kLongestReport) return sentence;
    std::size_t end = kLongestReport;
    while (end > 0 && (static_cast<unsigned char>(sentence[end]) & 0xC0U) == 0x80U) --end;
    return sentence.substr(0, end) + "…";
  }

  const Making& making_;
  const MakingNews& news_;
  std::string line_;
  std::optional<Error> error_;
};

/// Reads what has arrived; false at the end of the pipe.
bool read_reports(const Descriptor& pipe, Reports& reports) {
  pollfd waiting{pipe.number(), POLLIN, 0};
  if (::poll(&waiting, 1, static_cast<int>(kStep.count())) <= 0) return true;
  std::array<char, 4096> part{};
  const ssize_t bytes = ::read(pipe.number(), part.data(), part.size());
  if (bytes > 0) reports.add({part.data(), static_cast<std::size_t>(bytes)});
  return bytes > 0 || (bytes < 0 && errno == EINTR);
}

std::string end_by_signal(int number, bool out_of_time) {
  if (out_of_time || number == SIGXCPU) return "working on the scene took too long, and was ended";
  if (number == SIGKILL)
    return "working on the scene was ended by the system: probably there was not enough memory for it";
  return fmt::format(
      "working on the scene ended with a fault (signal {}): the file is damaged, or made to do harm; nothing "
      "else "
      "was affected",
      number);
}

Result<void> outcome(int status, const std::optional<Error>& reported, bool out_of_time) {
  if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return {};
  if (WIFSIGNALED(status)) return Error{ErrorCode::failed, end_by_signal(WTERMSIG(status), out_of_time), {}};
  if (reported) return *reported;
  return Error{
      ErrorCode::failed,
      fmt::format("working on the scene failed without a reason (exit code {})", WEXITSTATUS(status)),
      {}};
}

}  // namespace

Result<void> run_making(const Making& making, const std::atomic<bool>& cancel, const MakingNews& news) {
  auto pipe = make_pipe();
  if (!pipe) return pipe.error();
  auto& [reading, writing] = *pipe;
  std::vector<std::string> words = making.arguments;
  words.insert(words.end(), {"--progress-to", kPipe});
  const std::array passed{writing.number()};
  const auto started = start_child(making.program, std::move(words), passed);
  if (!started) return Error{started.error().code, started.error().message, making.program.string()};
  const pid_t process = *started;
  confine(process, making.limits);
  writing.close();

  Reports reports(making, news);
  const auto deadline = Clock::now() + making.limits.time;
  bool open = true, out_of_time = false;
  int status = 0;
  pid_t ended = 0;
  while ((ended = ::waitpid(process, &status, WNOHANG)) == 0) {
    if (open) {
      open = read_reports(reading, reports);
    } else {
      std::this_thread::sleep_for(kStep);
    }
    out_of_time = Clock::now() >= deadline;
    if (cancel || out_of_time) {
      ::kill(-process, SIGKILL);
      while ((ended = ::waitpid(process, &status, 0)) < 0 && errno == EINTR) continue;
      break;
    }
  }
  if (ended < 0) return Error{ErrorCode::failed, "the process that works on the scene was lost", {}};
  // Its own children end with it; what is left in its group is ended, too.
  ::kill(-process, SIGKILL);
  while (open && read_reports(reading, reports)) {
    pollfd waiting{reading.number(), POLLIN, 0};
    if (::poll(&waiting, 1, 0) <= 0) break;
  }
  if (cancel) return Error{ErrorCode::interrupted, "cancelled", {}};
  return outcome(status, reports.error(), out_of_time);
}

}  // namespace palpable::page::shelf
