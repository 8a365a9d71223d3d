// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sources/isolated/decoder_process.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <fstream>
#include <sstream>
#include <string>
#include <thread>
#include <utility>

#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

namespace palpable::sources::isolated {
namespace {

using Clock = std::chrono::steady_clock;
using std::chrono::milliseconds;

/// The end of the pipe on which the process reports: a byte when it begins to read the file. It closes when
/// the process ends, and wakes at once; but a program may also close it early, or leave it to others.
class Reports {
 public:
  explicit Reports(Descriptor pipe) : pipe_(std::move(pipe)) {}
  bool began() const { return began_; }
  /// Waits for a report, at most `longest`.
  void wait(milliseconds longest) {
    if (is_closed_) {
      std::this_thread::sleep_for(std::min(longest, pause_));
      constexpr milliseconds kLongestPause{20};
      pause_ = std::min(2 * pause_, kLongestPause);
      return;
    }
    pollfd reported{pipe_.number(), POLLIN, 0};
    if (::poll(&reported, 1, static_cast<int>(longest.count())) <= 0) return;
    char report = 0;
    const ssize_t n = ::read(pipe_.number(), &report, 1);
    began_ = began_ || n > 0;
    is_closed_ = n == 0 || (n < 0 && errno != EINTR);
  }

 private:
  Descriptor pipe_;
  milliseconds pause_{1};
  bool began_ = false;
  bool is_closed_ = false;
};

/// When a process computed last, or waited for the processor or the disk.
class Activity {
 public:
  explicit Activity(pid_t process) : file_("/proc/" + std::to_string(process) + "/stat") {}
  /// How long the process has rested; 0 if the system does not say.
  Clock::duration rest() {
    std::string line;
    std::getline(std::ifstream(file_), line);
    // The name, in parentheses, may contain anything (proc(5)).
    const auto name_end = line.rfind(')');
    std::istringstream fields(name_end == std::string::npos ? std::string() : line.substr(name_end + 1));
    std::string state, skipped;
    fields >> state;
    constexpr int kBetween = 10;
    for (int k = 0; k < kBetween; ++k) fields >> skipped;
    unsigned long long user = 0, system = 0;
    fields >> user >> system;
    const bool rests = fields && state != "R" && state != "D" && user + system == computed_;
    computed_ = user + system;
    if (!rests) last_ = Clock::now();
    return Clock::now() - last_;
  }

 private:
  std::string file_;
  unsigned long long computed_ = 0;
  Clock::time_point last_ = Clock::now();
};

/// Whether the process has ended, or is unknown because somebody else has waited for it. It stays known to
/// the system until it is reaped.
bool has_ended(pid_t process) {
  siginfo_t info{};
  const int fault = ::waitid(P_PID, static_cast<id_t>(process), &info, WEXITED | WNOWAIT | WNOHANG);
  return fault != 0 ? errno != EINTR : info.si_pid == process;
}

/// Ends what is left of its group, and takes its status.
std::optional<int> reaped(pid_t process) {
  ::kill(-process, SIGKILL);
  int status = 0;
  while (::waitpid(process, &status, 0) < 0)
    if (errno != EINTR) return std::nullopt;
  return status;
}

}  // namespace

DecoderEnd wait_for_end(pid_t process, Descriptor alive, std::chrono::seconds time) {
  const auto deadline = Clock::now() + time;
  constexpr milliseconds kStep{200};
  Reports reports(std::move(alive));
  Activity activity(process);
  bool in_time = true;
  while (!has_ended(process) && in_time) {
    const auto left = std::chrono::duration_cast<milliseconds>(deadline - Clock::now());
    reports.wait(std::clamp(left, milliseconds{0}, kStep));
    in_time = left.count() > 0 && activity.rest() < kIdlePatience;
  }
  // Of a process that ended before it was looked for.
  reports.wait(milliseconds{0});
  return {reports.began(), in_time, reaped(process)};
}

}  // namespace palpable::sources::isolated
