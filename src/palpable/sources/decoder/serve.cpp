// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sources/decoder/serve.hpp"

#include "palpable/core/text/number_text.hpp"
#include "palpable/sources/decoder/confine.hpp"
#include "palpable/sources/decoder/write_all.hpp"
#include "palpable/sources/isolated/protocol.hpp"

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <exception>
#include <system_error>
#include <vector>

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

bool report_begin() {
  constexpr char kBegin = 'b';
  return write(protocol::kAliveDescriptor, &kBegin, 1) == 1;
}

/// The reply in its memory file. Small parts are collected, so that each write fills whole pages of the file:
/// those need not be cleared first.
class ReplyFile final : public ReplySink {
 public:
  bool put(std::span<const std::byte> part) override {
    if (held_.size() + part.size() > kTogether && !flush()) return false;
    if (part.size() > kTogether) return write_all(protocol::kReplyDescriptor, part);
    held_.insert(held_.end(), part.begin(), part.end());
    return true;
  }
  bool restart() override {
    held_.clear();
    return lseek(protocol::kReplyDescriptor, 0, SEEK_SET) == 0 &&
           ftruncate(protocol::kReplyDescriptor, 0) == 0;
  }
  bool flush() {
    const bool written = write_all(protocol::kReplyDescriptor, held_);
    held_.clear();
    return written;
  }

 private:
  static constexpr std::size_t kTogether = std::size_t{1} << 18U;

  std::vector<std::byte> held_;
};

/// The exit code.
int run_decoder(int argc, char** argv, const Decoder& decoder) {
  constexpr int kWords = 6;
  if (argc != kWords || argv[1] != protocol::kProtocolVersion) {
    std::fputs("this program is started by palpable, to read one file\n", stderr);
    return protocol::kWrongVersion;
  }
  const auto job = protocol::job_from(argv[2]);
  const auto memory = whole_number(argv[3]), written = whole_number(argv[4]), seconds = whole_number(argv[5]);
  if (!job || !memory || !written || !seconds) return protocol::kWrongVersion;
  if (decoder.prepare != nullptr) decoder.prepare();
  // A write beyond the limit is an error, not a signal.
  std::signal(SIGXFSZ, SIG_IGN);
  const Allowance allowance{static_cast<std::uint64_t>(*memory), static_cast<std::uint64_t>(*written),
                            static_cast<std::uint64_t>(*seconds)};
  const auto file = input();
  if (file.empty()) return protocol::kNoInput;
  if (!confine(allowance, protocol::kAliveDescriptor + 1) || !report_begin()) return protocol::kNotConfined;
  ReplyFile reply;
  const bool replied = run_guarded(decoder.run, *job, file, reply) && reply.flush();
  return replied ? protocol::kReplied : protocol::kNotWritten;
}

}  // namespace

void serve(int argc, char** argv, const Decoder& decoder) {
  // Without running the libraries' destructors: the reply is written, and nothing else is left to do.
  try {
    _exit(run_decoder(argc, argv, decoder));
  } catch (const std::system_error&) {
    _exit(protocol::kNoThread);
  } catch (const std::exception&) {
    _exit(protocol::kNotWritten);
  }
}

}  // namespace palpable::sources::decoder
