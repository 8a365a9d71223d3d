// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sources/decoder/confine_network.hpp"

#include <cstdint>
#include <string>

#include <fcntl.h>
#include <gtest/gtest.h>
#include <linux/landlock.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

namespace palpable::sources::decoder {
namespace {

/// What a process can do after confine_to_network().
enum Ability : unsigned { kReads = 1, kWrites = 2, kStarts = 4, kListens = 8, kConnects = 16, kLooksUp = 32 };

unsigned abilities_when_confined(const std::string& file) {
  if (!confine_to_network(std::uint64_t{1} << 30U)) return 0;
  unsigned abilities = 0;
  if (::open("/etc/passwd", O_RDONLY | O_CLOEXEC) >= 0) abilities |= kReads;
  if (::open(file.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0600) >= 0) abilities |= kWrites;
  if (const pid_t child = ::fork(); child == 0) {
    ::_exit(0);
  } else if (child > 0) {
    abilities |= kStarts;
  }
  const int socket = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  if (socket >= 0) abilities |= kConnects;
  if (::listen(socket, 1) == 0) abilities |= kListens;
  if (::open("/etc/hosts", O_RDONLY | O_CLOEXEC) >= 0) abilities |= kLooksUp;
  return abilities;
}

TEST(ConfineToNetwork, LeavesConnectionsAndWhatTheyNeed) {
#ifdef PALPABLE_SANITIZED
  GTEST_SKIP() << "sanitizers make calls of their own";
#endif
  const std::string file = testing::TempDir() + "/never_written";
  const pid_t child = ::fork();
  ASSERT_GE(child, 0);
  if (child == 0) ::_exit(static_cast<int>(abilities_when_confined(file)));
  int status = 0;
  ASSERT_EQ(::waitpid(child, &status, 0), child);
  ASSERT_TRUE(WIFEXITED(status)) << status;
  const auto abilities = static_cast<unsigned>(WEXITSTATUS(status));
  EXPECT_EQ(abilities & ~unsigned{kReads}, unsigned{kConnects | kLooksUp});
  // Kernels without Landlock cannot hide files.
  const bool can_hide =
      ::syscall(SYS_landlock_create_ruleset, nullptr, 0, LANDLOCK_CREATE_RULESET_VERSION) > 0;
  EXPECT_EQ((abilities & kReads) == 0, can_hide);
  EXPECT_NE(::access(file.c_str(), F_OK), 0);
}

}  // namespace
}  // namespace palpable::sources::decoder
