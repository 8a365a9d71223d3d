// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/device/hosted/host_process.hpp"

#include "palpable/core/system/system_failure.hpp"

#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <new>

#include <poll.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

namespace palpable::device {
namespace {

using Clock = std::chrono::steady_clock;

/// Waits until there is something to read, or the other end was closed; false: not until then.
bool wait_for(const Descriptor& pipe, Clock::time_point until) {
  while (true) {
    const auto left = std::chrono::ceil<std::chrono::milliseconds>(until - Clock::now()).count();
    pollfd waited{pipe.number(), POLLIN, 0};
    const int ready = ::poll(&waited, 1, left > 0 ? static_cast<int>(left) : 0);
    if (ready > 0) return true;
    if (ready == 0 || errno != EINTR) return false;
  }
}

}  // namespace

Result<HostProcess> HostProcess::start(std::vector<std::string> arguments) {
  const auto program =
      helper_program("palpable-library-host", "PALPABLE_LIBRARY_HOST", PALPABLE_LIBRARY_HOST_FOLDER);
  if (!program) return program.error();
  auto alive = make_pipe();
  if (!alive) return std::move(alive).error();
  auto answers = make_pipe();
  if (!answers) return std::move(answers).error();
  const Descriptor memory = passable(Descriptor(::memfd_create("palpable-library-host", MFD_CLOEXEC)));
  if (::ftruncate(memory.number(), sizeof(HostExchange)) != 0) return system_failure(errno);
  void* mapped =
      ::mmap(nullptr, sizeof(HostExchange), PROT_READ | PROT_WRITE, MAP_SHARED, memory.number(), 0);
  if (mapped == MAP_FAILED) return system_failure(errno);
  HostProcess host;
  host.shared_ = new (mapped) HostExchange;
  host.alive_ = std::move(alive->second);
  host.answers_ = std::move(answers->first);
  const auto process =
      start_child(*program, std::move(arguments),
                  std::array{alive->first.number(), memory.number(), answers->second.number()});
  if (!process)
    return Error{ErrorCode::failed, program->string() + " cannot be started: " + process.error().message, {}};
  host.process_ = *process;
  answers->second.close();
  constexpr std::chrono::milliseconds kBeginning{5000};
  const auto greeting = host.next_line(kBeginning);
  if (!greeting || *greeting != kHostGreeting)
    return Error{ErrorCode::failed, program->string() + " is no library host of this version", {}};
  return host;
}

HostProcess::HostProcess(HostProcess&& other) noexcept
    : alive_(std::move(other.alive_)),
      answers_(std::move(other.answers_)),
      unread_(std::move(other.unread_)),
      shared_(std::exchange(other.shared_, nullptr)),
      process_(std::exchange(other.process_, -1)),
      how_(std::move(other.how_)),
      succeeded_(other.succeeded_) {}

HostProcess::~HostProcess() {
  end();
  if (shared_ != nullptr) ::munmap(shared_, sizeof(HostExchange));
}

Result<std::optional<std::string>> HostProcess::next_line(std::chrono::milliseconds longest) {
  constexpr std::size_t kMost_bytes = 8192;
  const auto until = Clock::now() + longest;
  std::array<char, 512> part{};
  while (true) {
    if (const auto end = unread_.find('\n'); end != std::string::npos) {
      std::string line = unread_.substr(0, end);
      unread_.erase(0, end + 1);
      return std::optional(std::move(line));
    }
    if (!wait_for(answers_, until))
      return Error{ErrorCode::device,
                   "the vendor's library does not return within " +
                       std::to_string(std::chrono::ceil<std::chrono::seconds>(longest).count()) + " s",
                   {}};
    const ssize_t got = ::read(answers_.number(), part.data(), part.size());
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0 || unread_.size() > kMost_bytes) return std::optional<std::string>();
    unread_.append(part.data(), static_cast<std::size_t>(got));
  }
}

bool HostProcess::has_ended(std::chrono::milliseconds longest) {
  const auto until = Clock::now() + longest;
  if (process_ < 0) return true;
  // Its end of the pipe closes when it ends; the process can be waited for shortly after that.
  if (!wait_for(answers_, until)) return false;
  int status = 0;
  pid_t ended = 0;
  while ((ended = ::waitpid(process_, &status, WNOHANG)) == 0 && Clock::now() < until) ::poll(nullptr, 0, 1);
  if (ended == process_) reap(status);
  return process_ < 0;
}

void HostProcess::reap(int status) {
  process_ = -1;
  succeeded_ = WIFEXITED(status) && WEXITSTATUS(status) == 0;
  // NOLINTNEXTLINE(concurrency-mt-unsafe): names of signals are constant
  how_ = WIFSIGNALED(status) ? std::string("crashed (") + ::strsignal(WTERMSIG(status)) + ")"
                             : "ended its process (code " + std::to_string(WEXITSTATUS(status)) + ")";
}

std::string HostProcess::end() {
  if (process_ < 0) return how_;
  ::kill(process_, SIGKILL);
  int status = 0;
  while (::waitpid(process_, &status, 0) < 0 && errno == EINTR) {
  }
  reap(status);
  return how_;
}

}  // namespace palpable::device
