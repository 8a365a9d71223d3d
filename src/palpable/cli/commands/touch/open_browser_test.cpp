// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/cli/commands/touch/open_browser.hpp"

#include "palpable/core/files/byte_reader.hpp"
#include "palpable/core/files/read_file.hpp"

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

namespace palpable::cli {
namespace {

namespace fs = std::filesystem;

TEST(OpenBrowser, WritesARedirectThatOnlyThisUserReads) {
  const fs::path file = write_redirect("http://127.0.0.1:4711/#token");
  ASSERT_FALSE(file.empty());
  EXPECT_EQ(fs::status(file).permissions(), fs::perms::owner_read | fs::perms::owner_write);
  const auto text = read_file(file);
  ASSERT_TRUE(text);
  EXPECT_NE(as_text(*text).find("url=http://127.0.0.1:4711/#token"), std::string_view::npos);
  fs::remove(file);
}

/// What a program writes into a FIFO until it closes it.
std::string text_through(const fs::path& fifo) {
  std::ifstream in(fifo);
  return {std::istreambuf_iterator<char>(in), {}};
}

TEST(OpenBrowser, GivesTheBrowserNeitherTheTokenNorADescriptor) {
  const fs::path folder = fs::path(::testing::TempDir()) / "palpable_open_browser_test";
  fs::remove_all(folder);
  fs::create_directories(folder);
  const fs::path program = folder / "xdg-open", seen = folder / "seen";
  std::ofstream(program) << "#!/bin/sh\n{ echo \"$@\"; ls /proc/$$/fd; } > " << seen.string() << "\n";
  fs::permissions(program, fs::perms::owner_all);
  ASSERT_EQ(mkfifo(seen.c_str(), S_IRUSR | S_IWUSR), 0);
  ASSERT_EQ(setenv("PATH", (folder.string() + ":" + std::getenv("PATH")).c_str(), 1), 0);
  ASSERT_EQ(setenv("DISPLAY", ":0", 1), 0);
  // Open and without close-on-exec, like the page's port.
  constexpr int kPort = 200;
  ASSERT_EQ(dup2(STDERR_FILENO, kPort), kPort);
  const OpenedBrowser browser("http://127.0.0.1:4711/#token");
  const std::string given = text_through(seen);
  close(kPort);
  EXPECT_NE(given.find(".html"), std::string::npos);
  EXPECT_EQ(given.find("token"), std::string::npos);
  EXPECT_EQ(given.find("\n200\n"), std::string::npos);
  fs::remove_all(folder);
}

}  // namespace
}  // namespace palpable::cli
