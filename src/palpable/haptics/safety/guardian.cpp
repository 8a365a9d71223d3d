// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/haptics/safety/guardian.hpp"

#include <array>
#include <cerrno>
#include <string>
#include <string_view>

#include <fcntl.h>
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
  const auto process =
      start_child(*program, {hexadecimal(zero.bytes)}, std::array{its.number(), device.number()});
  if (!process) return process.error();
  return std::unique_ptr<Guardian>(new Guardian(std::move(ours), *process));
}

Guardian::~Guardian() {
  alive_.close();
  while (::waitpid(process_, nullptr, 0) < 0 && errno == EINTR) {
  }
}

}  // namespace palpable::haptics
