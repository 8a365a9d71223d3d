// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/haptics/safety/guardian.hpp"

#include <array>
#include <cerrno>
#include <new>
#include <string>
#include <string_view>

#include <fcntl.h>
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
  const auto program = helper_program("palpable-guardian", "PALPABLE_GUARDIAN", PALPABLE_GUARDIAN_FOLDER);
  if (!program) return program.error();
  auto pipe = make_pipe();
  if (!pipe) return std::move(pipe).error();
  auto& [its, ours] = *pipe;
  const Descriptor device = passable(Descriptor(::dup(zero.descriptor)));
  const Descriptor shared = passable(Descriptor(::memfd_create("palpable-beats", MFD_CLOEXEC)));
  void* memory = ::ftruncate(shared.number(), sizeof(Beats)) == 0
                     ? ::mmap(nullptr, sizeof(Beats), PROT_READ | PROT_WRITE, MAP_SHARED, shared.number(), 0)
                     : MAP_FAILED;
  if (memory == MAP_FAILED) return Error{ErrorCode::failed, "no memory can be shared with the guardian", {}};
  auto* beats = new (memory) Beats{};
  const auto process = start_child(
      *program, {hexadecimal(zero.bytes), std::to_string(kStill_ms), std::to_string(zero.usb_endpoint)},
      std::array{its.number(), device.number(), shared.number()});
  std::unique_ptr<Guardian> guardian(new Guardian(std::move(ours), beats, process ? *process : -1));
  if (!process) return process.error();
  return guardian;
}

Guardian::~Guardian() {
  alive_.close();
  ::munmap(beats_, sizeof(Beats));
  if (process_ < 0) return;
  while (::waitpid(process_, nullptr, 0) < 0 && errno == EINTR) {
  }
}

}  // namespace palpable::haptics
