// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/cli/commands/touch/open_browser.hpp"

#include <array>
#include <cstdlib>
#include <thread>

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

namespace palpable::cli {
namespace {

bool has_screen() { return std::getenv("DISPLAY") != nullptr || std::getenv("WAYLAND_DISPLAY") != nullptr; }

/// Starts the browser without this program's descriptors: the browser lives on, and would keep the page's
/// port open.
void start_browser(const std::string& place) {
  std::string program = "xdg-open", word = place;
  std::array<char*, 3> words{program.data(), word.data(), nullptr};
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    posix_spawn_file_actions_addopen(&actions, stream, "/dev/null", O_RDWR, 0);
  posix_spawn_file_actions_addclosefrom_np(&actions, STDERR_FILENO + 1);
  pid_t pid = 0;
  if (posix_spawnp(&pid, program.c_str(), &actions, nullptr, words.data(), environ) == 0)
    std::thread([pid] { waitpid(pid, nullptr, 0); }).detach();
  posix_spawn_file_actions_destroy(&actions);
}

}  // namespace

std::filesystem::path write_redirect(const std::string& address) {
  const char* const runtime = std::getenv("XDG_RUNTIME_DIR");
  std::error_code none;
  const std::filesystem::path folder = runtime != nullptr && std::filesystem::is_directory(runtime, none)
                                           ? std::filesystem::path(runtime)
                                           : std::filesystem::temp_directory_path(none);
  constexpr int kSuffixLength = 5;
  std::string name = (folder / "palpable-XXXXXX.html").string();
  // mkstemps() makes it readable by this user alone.
  const int descriptor = mkostemps(name.data(), kSuffixLength, O_CLOEXEC);
  if (descriptor < 0) return {};
  const std::string page = fmt::format(
      "<!doctype html><meta charset=\"utf-8\"><title>Palpable</title>"
      "<meta http-equiv=\"refresh\" content=\"0;url={0}\"><p><a href=\"{0}\">Touch the scene</a></p>\n",
      address);
  const bool whole = write(descriptor, page.data(), page.size()) == static_cast<ssize_t>(page.size());
  close(descriptor);
  if (whole) return name;
  unlink(name.c_str());
  return {};
}

OpenedBrowser::OpenedBrowser(const std::string& address) {
  if (!has_screen()) return;
  redirect_ = write_redirect(address);
  if (!redirect_.empty()) start_browser(redirect_.string());
}

OpenedBrowser::~OpenedBrowser() {
  std::error_code none;
  if (!redirect_.empty()) std::filesystem::remove(redirect_, none);
}

}  // namespace palpable::cli
