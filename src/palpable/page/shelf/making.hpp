// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/result.hpp"

#include <atomic>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace palpable::page::shelf {

/// What a child process that makes or saves a scene may use. Beyond it the process is ended.
struct MakingLimits {
  /// Address space.
  std::uint64_t memory_bytes = std::uint64_t{4} << 30U;
  /// Of each file that it writes.
  std::uint64_t file_bytes = std::uint64_t{1} << 30U;
  /// Of all its threads together.
  std::chrono::seconds processor_time{900};
  /// From start to end.
  std::chrono::seconds time{1200};
  /// Lower than this program's, so that a touch goes on undisturbed: 0 (as it) to 19.
  int niceness = 0;
};

/// A command line of this program: "make" or "export", its arguments, ….
struct Making {
  std::filesystem::path program;
  std::vector<std::string> arguments;
  MakingLimits limits;
  /// Removed from the sentences of the process, so that they name files as the person does.
  std::vector<std::string> hidden_folders;
};

struct MakingNews {
  /// Of the step's finished part, 0 … 1, and its name.
  std::function<void(double fraction, std::string step)> progress;
  /// What the program says about the files.
  std::function<void(std::string sentence)> note;
};

/// Runs the command in a process of its own and blocks until it has ended; setting `cancel` ends it within
/// 0.2 s. When this program ends, it is interrupted at its next report. What it reports is untrusted:
/// sentences are shortened and freed of control characters. Errors: those of the command, with its sentence;
/// interrupted; failed, with a sentence that says how it ended, if it crashed or exceeded the limits. The
/// calling thread must live as long as the process.
Result<void> run_making(const Making& making, const std::atomic<bool>& cancel, const MakingNews& news);

}  // namespace palpable::page::shelf
