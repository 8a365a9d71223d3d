// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/haptics/safety/guardian.hpp"

#include <array>
#include <cerrno>
#include <csignal>
#include <new>
#include <string>
#include <string_view>

#include <fcntl.h>
#include <poll.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

namespace palpable::haptics {
namespace {

std::string hexadecimal(const std::vector<std::byte>& bytes) {
  constexpr std::string_view kDigits = "0123456789abcdef";
  std::string text;
  for (const std::byte byte : bytes) {
    text += kDigits[std::to_integer<unsigned>(byte) >> 4U];
    text += kDigits[std::to_integer<unsigned>(byte) & 15U];
  }
  return text;
}

}  // namespace

Result<std::unique_ptr<Guardian>> Guardian::start(const device::ZeroWrite& zero) {
  auto program = helper_program("palpable-guardian", "PALPABLE_GUARDIAN", PALPABLE_GUARDIAN_FOLDER);
  if (!program) return std::move(program).error();
  auto pipe = make_pipe();
  if (!pipe) return std::move(pipe).error();
  auto& [its, ours] = *pipe;
  Descriptor memory = passable(Descriptor(::memfd_create("palpable-beats", MFD_CLOEXEC)));
  void* mapped =
      ::ftruncate(memory.number(), sizeof(SharedBeats)) == 0
          ? ::mmap(nullptr, sizeof(SharedBeats), PROT_READ | PROT_WRITE, MAP_SHARED, memory.number(), 0)
          : MAP_FAILED;
  if (mapped == MAP_FAILED) return Error{ErrorCode::failed, "no memory can be shared with the guardian", {}};
  auto* shared = new (mapped) SharedBeats{};
  Start start{*std::move(program),
              {hexadecimal(zero.bytes), std::to_string(kStill_ms), std::to_string(zero.usb_endpoint)},
              {std::move(its), passable(Descriptor(::dup(zero.descriptor))), std::move(memory)}};
  std::unique_ptr<Guardian> guardian(new Guardian(std::move(ours), shared, std::move(start)));
  if (auto started = guardian->start_process(); !started) return std::move(started).error();
  return guardian;
}

Result<void> Guardian::start_process() {
  auto pipe = make_pipe();
  if (!pipe) return std::move(pipe).error();
  auto& [answer, its] = *pipe;
  const auto& [program_ends, device, memory] = start_.descriptors;
  const auto process =
      start_child(start_.program, start_.arguments,
                  std::array{program_ends.number(), device.number(), memory.number(), its.number()});
  if (!process)
    return Error{
        ErrorCode::failed, start_.program.string() + " cannot be started: " + process.error().message, {}};
  process_ = *process;
  its.close();
  return wait_until_ready(answer);
}

/// Whatever else is started in its place would let a force stand.
Result<void> Guardian::wait_until_ready(const Descriptor& answer) {
  constexpr int kPatience_ms = 2000;
  pollfd waited{answer.number(), POLLIN, 0};
  std::uint64_t ready = 0;
  int answers = -1;
  do answers = ::poll(&waited, 1, kPatience_ms);
  while (answers < 0 && errno == EINTR);
  const bool is_in_time = answers == 1;
  if (is_in_time && ::read(answer.number(), &ready, sizeof ready) == sizeof ready && ready == kGuardianReady)
    return {};
  ::kill(process_, SIGKILL);
  end_process();
  return Error{ErrorCode::failed,
               start_.program.string() + " is no guardian of this version: it " +
                   (is_in_time ? "ends, or answers otherwise" : "does not answer"),
               {}};
}

Result<void> Guardian::keep_alive() {
  if (process_ >= 0 && ::waitpid(process_, nullptr, WNOHANG) == 0) return {};
  process_ = -1;
  return start_process();
}

void Guardian::end_process() {
  if (process_ < 0) return;
  while (::waitpid(process_, nullptr, 0) < 0 && errno == EINTR) {
  }
  process_ = -1;
}

Guardian::~Guardian() {
  alive_.close();
  ::munmap(shared_, sizeof(SharedBeats));
  end_process();
}

}  // namespace palpable::haptics
