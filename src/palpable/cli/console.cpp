// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/cli/console.hpp"

#include "palpable/cli/hints.hpp"
#include "palpable/core/files/atomic_file.hpp"
#include "palpable/core/text/plain_text.hpp"
#include "palpable/haptics/safety/zero_force.hpp"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstring>

#include <fmt/format.h>
#include <sys/time.h>
#include <unistd.h>

namespace palpable::cli {
namespace {

constexpr std::chrono::seconds kProgressAfter{1};
constexpr std::chrono::milliseconds kProgressEvery{500};
// Moves to the start of the line and clears it.
constexpr const char* kClearLine = "\r\x1b[K";

// Global, since a signal handler cannot access anything else.
std::atomic<bool> interrupt_flag{false};
static_assert(std::atomic<bool>::is_always_lock_free);

constexpr int kServoPatience_ms = 200;
// The time that interrupted work has to end. With the time of the servo's end, and 0.3 s of a busy machine,
// the program ends within a second.
constexpr int kWorkPatience_ms = 500;

/// Called if work did not end in time: it waits for a pipe, or a library cannot be interrupted. A file that
/// is being written has no name or a temporary one, so the old file is unchanged.
void on_patience_over(int /*number*/) {
  haptics::end_every_servo(kServoPatience_ms);
  constexpr std::string_view kSentence = "palpable: interrupted\n";
  static_cast<void>(!write(STDERR_FILENO, kSentence.data(), kSentence.size()));
  _exit(static_cast<int>(ErrorCode::interrupted));
}

/// The first signal sets every servo to zero force, requests the work to end and gives it time. The second
/// one has the default action, after every servo has written zero force.
void on_interrupt(int number) {
  haptics::end_every_servo(0);
  if (!interrupt_flag.exchange(true, std::memory_order_relaxed)) {
    constexpr int kMicroseconds = 1000;
    const itimerval patience{{0, 0}, {0, kWorkPatience_ms * kMicroseconds}};
    setitimer(ITIMER_REAL, &patience, nullptr);
    return;
  }
  haptics::end_every_servo(kServoPatience_ms);
  std::signal(number, SIG_DFL);
  std::raise(number);
}

/// Whether the program was started with this signal ignored, as nohup does with SIGHUP.
bool is_ignored(int number) {
  struct sigaction now {};
  return sigaction(number, nullptr, &now) == 0 && now.sa_handler == SIG_IGN;
}

}  // namespace

const std::atomic<bool>& interrupted() { return interrupt_flag; }

void catch_interrupts() {
  struct sigaction action {};
  action.sa_handler = on_interrupt;
  sigemptyset(&action.sa_mask);
  for (const int number : {SIGINT, SIGTERM, SIGHUP}) sigaddset(&action.sa_mask, number);
  for (const int number : {SIGINT, SIGTERM}) sigaction(number, &action, nullptr);
  if (!is_ignored(SIGHUP)) sigaction(SIGHUP, &action, nullptr);
  action.sa_handler = on_patience_over;
  sigaction(SIGALRM, &action, nullptr);
  // A pipe without a reader and a file at its size limit are errors of the write call.
  for (const int number : {SIGPIPE, SIGXFSZ}) std::signal(number, SIG_IGN);
  // Ignored when the program was started, it would hide how programs end that this one starts.
  std::signal(SIGCHLD, SIG_DFL);
  refuse_commits_after(&interrupt_flag);
}

Console::Console(const CommonOptions& options)
    : options_(options),
      lines_(options.progress_to),
      shows_progress_(!options.quiet && isatty(STDERR_FILENO) != 0),
      started_(std::chrono::steady_clock::now()),
      last_shown_(started_) {}

Console::~Console() { remove_progress(); }

void Console::note(const Note& note) {
  lines_.note(sentence_of(note));
  if (options_.quiet) return;
  const std::lock_guard lock(mutex_);
  remove_progress();
  write_error(sentence_of(note) + "\n");
}

void Console::say(std::string_view sentence) {
  const std::lock_guard lock(mutex_);
  remove_progress();
  std::FILE* const stream = options_.json ? stderr : stdout;
  const std::string line = without_control_characters(sentence) + "\n";
  std::fwrite(line.data(), 1, line.size(), stream);
  std::fflush(stream);
}

void Console::draw(std::string_view picture) {
  const std::lock_guard lock(mutex_);
  if (options_.json || options_.quiet || isatty(STDOUT_FILENO) == 0) return;
  remove_progress();
  std::fwrite(picture.data(), 1, picture.size(), stdout);
  std::fflush(stdout);
}

void Console::end_progress() {
  const std::lock_guard lock(mutex_);
  remove_progress();
  shows_progress_ = false;
}

Work Console::work() {
  Work work;
  work.threads = static_cast<unsigned>(options_.threads);
  work.seed = options_.seed;
  work.cancel = &interrupted();
  if (shows_progress_ || options_.progress_to >= 0)
    work.progress = [this](double fraction, std::string_view what) { show_progress(fraction, what); };
  return work;
}

void Console::show_progress(double fraction, std::string_view what) {
  const std::lock_guard lock(mutex_);
  const auto now = std::chrono::steady_clock::now();
  // Its reader has ended: nobody waits for the result.
  if (!lines_.progress(fraction, what)) interrupt_flag = true;
  if (!shows_progress_) return;
  if (now - started_ < kProgressAfter || now - last_shown_ < kProgressEvery) return;
  std::string line = fmt::format("{}: {} %", what, std::lround(100.0 * std::clamp(fraction, 0.0, 1.0)));
  if (line == progress_) return;
  last_shown_ = now;
  progress_ = std::move(line);
  write_error(progress_, kClearLine);
}

void Console::remove_progress() {
  if (progress_.empty()) return;
  progress_.clear();
  write_error({}, kClearLine);
}

void write_error(std::string_view text, std::string_view before) {
  const std::string plain = std::string(before) + without_control_characters(text);
  std::fwrite(plain.data(), 1, plain.size(), stderr);
}

Result<void> print(std::string_view text) {
  const std::size_t written = std::fwrite(text.data(), 1, text.size(), stdout);
  if (written == text.size() && std::fflush(stdout) == 0) return {};
  // Its reader, such as `head`, has read enough.
  if (errno == EPIPE) return {};
  return Error{ErrorCode::failed, fmt::format("could not be written: {}", std::strerror(errno)),
               "standard output"};
}

}  // namespace palpable::cli
