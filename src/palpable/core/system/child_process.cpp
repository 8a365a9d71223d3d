// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/core/system/child_process.hpp"

#include "palpable/core/system/system_failure.hpp"

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <system_error>

#include <fcntl.h>
#include <spawn.h>
#include <unistd.h>

namespace palpable {
namespace {

constexpr int kFirstPassed = 3;
/// Greater than every descriptor number of a child at its start, so that no copy overwrites the source of
/// another one.
constexpr int kPassable = 16;

bool is_executable(const std::filesystem::path& path) { return ::access(path.c_str(), X_OK) == 0; }

class SpawnSettings {
 public:
  SpawnSettings() {
    ::posix_spawn_file_actions_init(&actions);
    ::posix_spawnattr_init(&attributes);
  }
  SpawnSettings(const SpawnSettings&) = delete;
  SpawnSettings& operator=(const SpawnSettings&) = delete;
  ~SpawnSettings() {
    ::posix_spawn_file_actions_destroy(&actions);
    ::posix_spawnattr_destroy(&attributes);
  }
  posix_spawn_file_actions_t actions{};
  posix_spawnattr_t attributes{};
};

}  // namespace

void Descriptor::close() {
  if (number_ >= 0) ::close(std::exchange(number_, -1));
}

Descriptor passable(Descriptor descriptor) {
  if (descriptor.number() < 0) return Descriptor();
  const int copy = ::fcntl(descriptor.number(), F_DUPFD_CLOEXEC, kPassable);
  // The system says so of a number that the limit of open files does not allow.
  if (copy < 0 && errno == EINVAL) errno = EMFILE;
  return Descriptor(copy);
}

Result<std::pair<Descriptor, Descriptor>> make_pipe() {
  std::array<int, 2> ends{-1, -1};
  if (::pipe2(ends.data(), O_CLOEXEC) != 0) return system_failure(errno);
  std::pair pipe{passable(Descriptor(ends[0])), passable(Descriptor(ends[1]))};
  if (pipe.first.number() < 0 || pipe.second.number() < 0) return system_failure(errno);
  return pipe;
}

namespace {

/// The first place of a helper that `is_usable`; `obstacle`: why one that is there is not.
Result<std::filesystem::path> find_helper(std::string_view name, const char* variable,
                                          const std::filesystem::path& installed,
                                          bool (*is_usable)(const std::filesystem::path&),
                                          const char* obstacle) {
  std::error_code none;
  if (const char* named = std::getenv(variable); named != nullptr && *named != '\0')
    return std::filesystem::absolute(named, none);
  const auto beside = std::filesystem::read_symlink("/proc/self/exe", none).parent_path() / name;
  const std::array places{beside, installed / name};
  for (const auto& place : places)
    if (is_usable(place)) return place;
  for (const auto& place : places)
    if (std::filesystem::exists(place, none)) return Error{ErrorCode::failed, place.string() + obstacle, {}};
  return Error{ErrorCode::failed,
               "neither " + beside.string() + " nor " + (installed / name).string() + " is there (" +
                   variable + " names another place)",
               {}};
}

}  // namespace

Result<std::filesystem::path> helper_program(std::string_view name, const char* variable,
                                             const std::filesystem::path& installed) {
  return find_helper(name, variable, installed, is_executable, " may not be executed");
}

Result<std::filesystem::path> helper_module(std::string_view name, const char* variable,
                                            const std::filesystem::path& installed) {
  const auto is_file = [](const std::filesystem::path& path) {
    std::error_code none;
    return std::filesystem::is_regular_file(path, none);
  };
  return find_helper(name, variable, installed, is_file, " is no file");
}

Result<pid_t> start_child(const std::filesystem::path& program, std::vector<std::string> arguments,
                          std::span<const int> descriptors) {
  SpawnSettings settings;
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    ::posix_spawn_file_actions_addopen(&settings.actions, stream, "/dev/null", O_RDWR, 0);
  int next = kFirstPassed;
  for (const int descriptor : descriptors)
    ::posix_spawn_file_actions_adddup2(&settings.actions, descriptor, next++);
  ::posix_spawn_file_actions_addclosefrom_np(&settings.actions, next);
  sigset_t none, all;
  sigemptyset(&none);
  sigfillset(&all);
  ::posix_spawnattr_setsigmask(&settings.attributes, &none);
  ::posix_spawnattr_setsigdefault(&settings.attributes, &all);
  ::posix_spawnattr_setpgroup(&settings.attributes, 0);
  ::posix_spawnattr_setflags(&settings.attributes,
                             POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF | POSIX_SPAWN_SETPGROUP);
  std::string name = program.string();
  std::vector<char*> words{name.data()};
  for (std::string& argument : arguments) words.push_back(argument.data());
  words.push_back(nullptr);
  pid_t process = -1;
  const int fault =
      ::posix_spawn(&process, name.c_str(), &settings.actions, &settings.attributes, words.data(), environ);
  errno = fault;
  if (fault != 0) return system_failure(fault);
  return process;
}

}  // namespace palpable
