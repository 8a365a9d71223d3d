// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/result.hpp"
#include "palpable/core/system/child_process.hpp"
#include "palpable/device/hosted/exchange.hpp"

#include <chrono>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <sys/types.h>

namespace palpable::device {

/// A running `palpable-library-host`, its pipes and the memory that is shared with it. The destructor ends it
/// by force.
class HostProcess {
 public:
  /// Errors: failed, if the helper program is missing, is another version or none, or the system refuses.
  static Result<HostProcess> start(std::vector<std::string> arguments);
  HostProcess(HostProcess&& other) noexcept;
  HostProcess& operator=(HostProcess&&) = delete;
  HostProcess(const HostProcess&) = delete;
  HostProcess& operator=(const HostProcess&) = delete;
  ~HostProcess();

  HostExchange& exchange() const noexcept { return *shared_; }

  /// The next line of its answer; nullopt if it has ended. Errors: device, if neither happens within
  /// `longest`.
  Result<std::optional<std::string>> next_line(std::chrono::milliseconds longest);
  /// Whether it ended; waits for that for at most `longest`.
  bool has_ended(std::chrono::milliseconds longest);
  /// Tells it to free the motors, close the device and end.
  void ask_to_end() noexcept { alive_.close(); }
  /// Kills it if it runs. How it ended, as a clause about the library: "crashed (Segmentation fault)".
  std::string end();
  /// It ended by itself with code 0; after end().
  bool has_succeeded() const { return succeeded_; }

 private:
  HostProcess() = default;
  void reap(int status);

  Descriptor alive_;
  Descriptor answers_;
  std::string unread_;
  HostExchange* shared_ = nullptr;
  /// -1: none runs.
  pid_t process_ = -1;
  std::string how_;
  bool succeeded_ = false;
};

}  // namespace palpable::device
