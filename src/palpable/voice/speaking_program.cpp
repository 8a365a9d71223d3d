// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/voice/speaker.hpp"

#include <cerrno>
#include <csignal>
#include <cstring>
#include <utility>

#include <fcntl.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

namespace palpable::voice {
namespace {

// The child process and its standard input: a socket, since send() can suppress SIGPIPE.
struct Child {
  int input = -1;
  pid_t id = 0;
};

Result<Child> start(const std::vector<std::string>& command) {
  int ends[2];
  if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0)
    return Error{ErrorCode::failed, std::strerror(errno), command.front()};
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, ends[1], STDIN_FILENO);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
  std::vector<std::string> words = command;
  std::vector<char*> arguments;
  arguments.reserve(words.size() + 1);
  for (auto& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  Child child{ends[0], 0};
  const int failed = posix_spawnp(&child.id, arguments.front(), &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  close(ends[1]);
  if (failed == 0) return child;
  close(ends[0]);
  return Error{ErrorCode::failed, std::string("cannot be started (") + std::strerror(failed) + ")",
               command.front()};
}

void end(const Child& child) {
  close(child.input);
  kill(child.id, SIGTERM);
  waitpid(child.id, nullptr, 0);
}

class SpeakingProgram final : public Speaker {
 public:
  SpeakingProgram(std::vector<std::string> command, Child child)
      : command_(std::move(command)), child_(child) {}
  ~SpeakingProgram() override {
    if (child_.id != 0) end(child_);
  }

  void finish() override {
    if (child_.id == 0) return;
    close(child_.input);
    waitpid(child_.id, nullptr, 0);
    child_ = {};
  }

  // Such a program speaks each line to its end. To interrupt it, it is stopped and started again.
  Result<void> say(std::string_view sentence) override {
    if (child_.id == 0) return Error{ErrorCode::failed, "has finished speaking", command_.front()};
    if (spoke_) {
      auto again = start(command_);
      if (!again) return again.error();
      end(std::exchange(child_, *again));
    }
    spoke_ = true;
    std::string line(sentence);
    for (char& c : line)
      if (c == '\n' || c == '\0') c = ' ';
    line += '\n';
    if (send(child_.input, line.data(), line.size(), MSG_NOSIGNAL) != static_cast<ssize_t>(line.size()))
      return Error{ErrorCode::failed, "does not speak any more", command_.front()};
    return {};
  }

 private:
  std::vector<std::string> command_;
  Child child_;
  bool spoke_ = false;
};

}  // namespace

Result<std::unique_ptr<Speaker>> open_speaking_program(const std::vector<std::string>& command) {
  const auto child = start(command);
  if (!child) return child.error();
  return std::unique_ptr<Speaker>(std::make_unique<SpeakingProgram>(command, *child));
}

}  // namespace palpable::voice
