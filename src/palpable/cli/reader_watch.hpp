// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <thread>

namespace palpable::cli {

/// Ends this program as SIGTERM does when nobody reads the other end of a pipe any longer: a command that
/// works for another program ends with it, also in steps of the work that report no progress.
class ReaderWatch {
 public:
  /// Watches a pipe's or a socket's descriptor until it is destroyed; -1, or another kind of file: does
  /// nothing.
  explicit ReaderWatch(int descriptor);
  ReaderWatch(const ReaderWatch&) = delete;
  ReaderWatch& operator=(const ReaderWatch&) = delete;
  ~ReaderWatch();

  bool watches() const { return thread_.joinable(); }

 private:
  int wake_ = -1;
  std::thread thread_;
};

}  // namespace palpable::cli
