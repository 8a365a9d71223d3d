// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/cli/progress_lines.hpp"
#include "palpable/core/note.hpp"
#include "palpable/core/work.hpp"

#include <atomic>
#include <chrono>
#include <mutex>
#include <string>
#include <string_view>
#include <vector>

namespace palpable::cli {

/// Options that every command has.
struct CommonOptions {
  bool json = false;
  bool quiet = false;
  int threads = 0;
  std::uint64_t seed = 1;
  /// An open descriptor that receives progress, notes and the error as lines of JSON; -1: none.
  int progress_to = -1;
  /// The command line as given, without the program name.
  std::vector<std::string> command;
};

/// Where a command writes: results on standard output, everything else on standard error. Progress of work
/// that takes longer than a second is one line on a terminal, rewritten at most twice a second and removed
/// before anything else is written. Any thread.
class Console {
 public:
  explicit Console(const CommonOptions& options);
  ~Console();
  Console(const Console&) = delete;
  Console& operator=(const Console&) = delete;

  /// Writes a note to standard error, one line, with the options that would change it (hints.hpp); nothing
  /// with --quiet.
  void note(const Note& note);
  /// A sentence that is shown even with --quiet: on standard output, or on standard error with --json.
  void say(std::string_view sentence);
  /// Writes a picture made of characters and control sequences of our own to standard output if it is a
  /// terminal, else nothing.
  void draw(std::string_view picture);
  /// Shows no progress from now on, since it would overwrite the lines of a touch in the terminal.
  void end_progress();
  /// The Work that long functions take: threads, seed, progress to this console, cancelled by Ctrl-C.
  Work work();
  const CommonOptions& options() const { return options_; }

 private:
  void show_progress(double fraction, std::string_view what);
  /// Under mutex_.
  void remove_progress();

  CommonOptions options_;
  ProgressLines lines_;
  bool shows_progress_ = false;
  /// The progress line on the terminal; empty = none.
  std::string progress_;
  std::mutex mutex_;
  std::chrono::steady_clock::time_point started_;
  std::chrono::steady_clock::time_point last_shown_;
};

/// Set by the first SIGINT, SIGTERM or SIGHUP after catch_interrupts() was called. If the work has not ended
/// 0.7 s later, every servo writes zero force and the program ends with exit code 130. After a second signal
/// this happens at once.
const std::atomic<bool>& interrupted();
/// To be called first in the program. A SIGHUP that was ignored when it started (nohup) stays ignored. From
/// then on, no output file is put in place after such a signal, and a pipe without a reader or a file at its
/// size limit is an error of the write, not a signal.
void catch_interrupts();

/// Writes `text` to standard output. Errors: failed, if it cannot be written in full.
Result<void> print(std::string_view text);

/// Writes to standard error, with control characters of `text` replaced, and `before` unchanged. A closed
/// stream is no error.
void write_error(std::string_view text, std::string_view before = {});

}  // namespace palpable::cli
