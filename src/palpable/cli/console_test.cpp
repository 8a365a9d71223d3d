// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/cli/console.hpp"

#include <algorithm>
#include <array>
#include <string>

#include <fcntl.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <unistd.h>

namespace palpable::cli {
namespace {

/// Redirects standard error to a pseudo-terminal.
class ATerminal : public testing::Test {
 protected:
  void SetUp() override {
    master_ = posix_openpt(O_RDWR | O_NOCTTY | O_CLOEXEC);
    ASSERT_GE(master_, 0);
    ASSERT_EQ(grantpt(master_), 0);
    ASSERT_EQ(unlockpt(master_), 0);
    std::array<char, 128> name{};
    ASSERT_EQ(ptsname_r(master_, name.data(), name.size()), 0);
    const int terminal = open(name.data(), O_RDWR | O_NOCTTY | O_CLOEXEC);
    ASSERT_GE(terminal, 0);
    kept_ = dup(STDERR_FILENO);
    dup2(terminal, STDERR_FILENO);
    close(terminal);
  }
  void TearDown() override {
    dup2(kept_, STDERR_FILENO);
    close(kept_);
    close(master_);
  }
  /// The text on the terminal after at most `patience_ms`.
  std::string written(int patience_ms) const {
    pollfd wait{master_, POLLIN, 0};
    if (poll(&wait, 1, patience_ms) <= 0) return {};
    std::array<char, 4096> bytes{};
    const ssize_t count = read(master_, bytes.data(), bytes.size());
    return {bytes.data(), static_cast<std::size_t>(std::max<ssize_t>(0, count))};
  }

  int master_ = -1;
  int kept_ = -1;
};

TEST_F(ATerminal, ShowsNoProgressAfterItsEnd) {
  Console console(CommonOptions{});
  const Work work = console.work();
  // Progress is shown from the first second on.
  int done = 0;
  const auto report_until = [&](int patience_ms, const auto& stop) {
    for (int waited = 0; waited < patience_ms; waited += 20) {
      work.report(0.001 * (++done % 1000), "matching");
      if (stop(written(20))) return true;
    }
    return false;
  };
  EXPECT_TRUE(report_until(
      20000, [](const std::string& text) { return text.find("matching") != std::string::npos; }));
  console.end_progress();
  EXPECT_EQ(written(0).find("matching"), std::string::npos);
  EXPECT_FALSE(
      report_until(1200, [](const std::string& text) { return text.find("matching") != std::string::npos; }));
}

}  // namespace
}  // namespace palpable::cli
