// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <string>
#include <string_view>

namespace palpable::cli {

/// What a command reports to a program that runs it, as lines of JSON on an open file descriptor:
/// {"progress":0.4,"step":"…"}, at most ten per second, {"note":"…"} and {"error":"…"}. What a pipe that is
/// full does not take is left out: work never waits for its reader. One thread at a time.
class ProgressLines {
 public:
  /// -1: nothing is reported.
  explicit ProgressLines(int descriptor) : descriptor_(descriptor) {}

  /// Whether the descriptor is -1, or open for writing.
  static bool can_write_to(int descriptor) noexcept;
  /// False if nobody reads any longer.
  bool progress(double fraction, std::string_view step);
  void note(std::string_view sentence) { write("note", sentence); }
  void error(std::string_view sentence) { write("error", sentence); }

 private:
  void write(const char* name, std::string_view sentence);
  void put(std::string line);

  int descriptor_;
  bool is_read_ = true;
  std::chrono::steady_clock::time_point last_;
};

}  // namespace palpable::cli
