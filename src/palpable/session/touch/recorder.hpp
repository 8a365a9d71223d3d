// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/result.hpp"
#include "palpable/device/recording/recording.hpp"
#include "palpable/haptics/servo/servo_loop.hpp"

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

namespace palpable::session {

/// Writes what a servo loop's recording ring holds into a file, from a thread of its own, until it is ended.
/// The loop must outlive it.
class Recorder {
 public:
  /// Switches the loop's recording on; where it is on already, what it holds is recorded too. Errors
  /// (failed): the file cannot be created.
  static Result<std::unique_ptr<Recorder>> start(haptics::ServoLoop& loop, const std::filesystem::path& file,
                                                 const std::string& header_json,
                                                 const device::RecordedScene& scene);
  /// Ends the file as finish() does, its error lost.
  ~Recorder();
  Recorder(const Recorder&) = delete;
  Recorder& operator=(const Recorder&) = delete;

  /// What is touched from now on. Any thread.
  void note(const device::RecordedScene& scene);
  /// Why writing has failed (the disk is full), once, as soon as it has: what was written before stays
  /// readable, and the touch goes on. Any thread.
  std::optional<Error> take_fault();
  /// Writes what is left and ends the file. Errors met at any time come here.
  Result<void> finish();

 private:
  struct Impl;
  explicit Recorder(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace palpable::session
