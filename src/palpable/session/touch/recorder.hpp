// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/result.hpp"
#include "palpable/device/recording/recording.hpp"
#include "palpable/haptics/servo/reopening_loop.hpp"

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

namespace palpable::session {

/// Writes a servo loop's recording ring to a file, on a separate thread. The loop must outlive it.
class Recorder {
 public:
  /// The loop must record from its first tick (ServoOptions::recording); the ticks so far are written too.
  /// Errors (failed): the file cannot be created.
  static Result<std::unique_ptr<Recorder>> start(haptics::ReopeningLoop& loop,
                                                 const std::filesystem::path& file,
                                                 const std::string& header_json,
                                                 const device::RecordedScene& scene);
  /// Ends the file as finish() does; errors are ignored.
  ~Recorder();
  Recorder(const Recorder&) = delete;
  Recorder& operator=(const Recorder&) = delete;

  /// Adds the description of what is touched from now on. Any thread.
  void note(const device::RecordedScene& scene);
  /// The reason why writing failed (for example a full disk), returned once. What was written before stays
  /// readable, and the touch continues. Any thread.
  std::optional<Error> take_fault();
  /// Writes the remaining ticks and ends the file: every tick if the loop has stopped, otherwise those up to
  /// this call. Errors of any earlier write are returned here.
  Result<void> finish();

 private:
  struct Impl;
  explicit Recorder(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace palpable::session
