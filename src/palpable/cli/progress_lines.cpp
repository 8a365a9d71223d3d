// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/cli/progress_lines.hpp"

#include <algorithm>
#include <cerrno>
#include <climits>

#include <fcntl.h>
#include <nlohmann/json.hpp>
#include <poll.h>
#include <unistd.h>

namespace palpable::cli {
namespace {

constexpr std::chrono::milliseconds kEvery{100};

std::string line_of(const nlohmann::ordered_json& report) {
  return report.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace

bool ProgressLines::progress(double fraction, std::string_view step) {
  const auto now = std::chrono::steady_clock::now();
  if (descriptor_ < 0 || now - last_ < kEvery) return is_read_;
  last_ = now;
  put(line_of({{"progress", fraction}, {"step", step}}));
  return is_read_;
}

void ProgressLines::write(const char* name, std::string_view sentence) {
  if (descriptor_ >= 0) put(line_of({{name, sentence}}));
}

bool ProgressLines::can_write_to(int descriptor) noexcept {
  if (descriptor < 0) return true;
  const int flags = ::fcntl(descriptor, F_GETFL);
  return flags >= 0 && (flags & O_ACCMODE) != O_RDONLY;
}

void ProgressLines::put(std::string line) {
  std::string_view left = line;
  while (!left.empty() && is_read_) {
    pollfd place{descriptor_, POLLOUT, 0};
    if (::poll(&place, 1, 0) == 0) return;
    // A pipe with room has room for this much (pipe(7)).
    const ssize_t written = ::write(descriptor_, left.data(), std::min<std::size_t>(left.size(), PIPE_BUF));
    if (written >= 0) {
      left.remove_prefix(static_cast<std::size_t>(written));
    } else if (errno == EAGAIN) {
      return;
    } else if (errno != EINTR) {
      is_read_ = false;
    }
  }
}

}  // namespace palpable::cli
