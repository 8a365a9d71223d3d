// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/core/text/number_text.hpp"
#include "palpable/sources/decoder/confine.hpp"
#include "palpable/sources/decoder/jobs.hpp"
#include "palpable/sources/isolated/protocol.hpp"

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <exception>

#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

namespace palpable::sources::decoder {
namespace {

namespace protocol = isolated;

std::span<const std::byte> input() {
  struct stat now {};
  if (fstat(protocol::kInputDescriptor, &now) != 0 || now.st_size <= 0) return {};
  const auto size = static_cast<std::size_t>(now.st_size);
  const void* begin = mmap(nullptr, size, PROT_READ, MAP_PRIVATE, protocol::kInputDescriptor, 0);
  if (begin == MAP_FAILED) return {};
  return {static_cast<const std::byte*>(begin), size};
}

bool write_bytes(std::span<const std::byte> bytes) {
  while (!bytes.empty()) {
    const ssize_t n = write(protocol::kReplyDescriptor, bytes.data(), bytes.size());
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return false;
    bytes = bytes.subspan(static_cast<std::size_t>(n));
  }
  return true;
}

int serve(int argc, char** argv) {
  constexpr int kWords = 6;
  if (argc != kWords || argv[1] != protocol::kProtocolVersion) {
    std::fputs("palpable-decoder is started by palpable, to read one file\n", stderr);
    return protocol::kWrongVersion;
  }
  const auto job = protocol::job_from(argv[2]);
  const auto memory = whole_number(argv[3]), written = whole_number(argv[4]), seconds = whole_number(argv[5]);
  if (!job || !memory || !written || !seconds) return protocol::kWrongVersion;
  prepare(*job);
  // A write beyond the limit is an error, not a signal.
  std::signal(SIGXFSZ, SIG_IGN);
  const Allowance allowance{static_cast<std::uint64_t>(*memory), static_cast<std::uint64_t>(*written),
                            static_cast<std::uint64_t>(*seconds)};
  const auto file = input();
  if (file.empty() || !confine(allowance, protocol::kAliveDescriptor + 1)) return protocol::kNotConfined;
  const ReplyBytes reply = run(*job, file);
  return write_bytes(reply.head) && write_bytes(reply.body) ? protocol::kReplied : protocol::kNotWritten;
}

}  // namespace
}  // namespace palpable::sources::decoder

int main(int argc, char** argv) {
  // Without running the libraries' destructors: the reply is written, and nothing else is left to do.
  try {
    _exit(palpable::sources::decoder::serve(argc, argv));
  } catch (const std::exception&) {
    _exit(palpable::sources::isolated::kNotWritten);
  }
}
