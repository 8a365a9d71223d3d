// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// Linked into every test program. It gives the program its own temporary folder, used by testing::TempDir()
// and by the system's functions, and removes the folder at the end.
#include <cstdlib>
#include <filesystem>
#include <string>
#include <system_error>

#include <unistd.h>

namespace {

class TestFolder {
 public:
  TestFolder() : owner_(getpid()) {
    std::error_code none;
    std::string name = (std::filesystem::temp_directory_path(none) / "palpable-test-XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) return;
    path_ = name;
    // GoogleTest appends file names to it.
    setenv("TEST_TMPDIR", (name + "/").c_str(), 1);
    setenv("TMPDIR", name.c_str(), 1);
  }
  ~TestFolder() {
    // A forked process leaves the folder to its parent.
    if (path_.empty() || getpid() != owner_) return;
    std::error_code in_use;
    std::filesystem::remove_all(path_, in_use);
  }
  TestFolder(const TestFolder&) = delete;
  TestFolder& operator=(const TestFolder&) = delete;

 private:
  std::filesystem::path path_;
  pid_t owner_;
};

const TestFolder test_folder;

}  // namespace
