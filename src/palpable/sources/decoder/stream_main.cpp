// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sources/decoder/confine_network.hpp"
#include "palpable/sources/decoder/write_all.hpp"
#include "palpable/sources/stream/stream_protocol.hpp"
#include "palpable/sources/stream/stream_reader.hpp"

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <exception>
#include <string>
#include <string_view>

#include <poll.h>
#include <unistd.h>

namespace palpable::sources {
namespace {

using stream::PartHeader;
using stream::PartKind;

enum ExitCode { kDone = 0, kWrongVersion = 10, kNotConfined = 11, kNoRequest = 13, kFault = 14 };

/// Writes parts into the pipe.
class PartsPipe final : public stream::StreamTaker {
 public:
  void take(const stream::StreamPicture& picture) override {
    // What the other side has not read yet is newer than what would wait for it.
    pollfd free{stream::kPartsDescriptor, POLLOUT, 0};
    if (::poll(&free, 1, 0) != 1 || (free.revents & POLLOUT) == 0) return;
    PartHeader header;
    header.kind = PartKind::picture;
    header.width = picture.width, header.height = picture.height;
    header.number = picture.number;
    header.arrival_ns = picture.arrival_ns;
    put(header, picture.rows);
  }
  bool is_there() override {
    pollfd other{stream::kPartsDescriptor, 0, 0};
    return is_there_ && (::poll(&other, 1, 0) != 1 || (other.revents & POLLERR) == 0);
  }
  void put(PartHeader header, std::span<const std::byte> content) {
    header.bytes = content.size();
    const auto write = [](std::span<const std::byte> bytes) {
      return decoder::write_all(stream::kPartsDescriptor, bytes);
    };
    is_there_ = is_there_ && write(std::as_bytes(std::span(&header, 1))) && write(content);
  }

 private:
  bool is_there_ = true;
};

/// '0' or '1' and the address; empty if it is too long, or no such request.
std::string read_request() {
  std::string request;
  std::array<char, 1024> some{};
  for (;;) {
    const ssize_t count = ::read(stream::kRequestDescriptor, some.data(), some.size());
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) break;
    request.append(some.data(), static_cast<std::size_t>(count));
    if (request.size() > stream::kLongestAddress + 1) return {};
  }
  ::close(stream::kRequestDescriptor);
  return request;
}

int run(int argc, char** argv) {
  if (argc != 2 || argv[1] != stream::kProtocolVersion) {
    std::fputs("this program is started by palpable, to read one network stream\n", stderr);
    return kWrongVersion;
  }
  std::signal(SIGPIPE, SIG_IGN);
  const std::string request = read_request();
  if (request.size() < 2) return kNoRequest;
  constexpr std::uint64_t kMemory = std::uint64_t{2} << 30U;
  if (!decoder::confine_to_network(kMemory)) return kNotConfined;
  PartsPipe parts;
  parts.put({}, {});
  auto reason = stream::read_stream(request.substr(1), request.front() == '1', parts);
  reason.resize(std::min<std::size_t>(reason.size(), stream::kLongestReason));
  PartHeader last;
  last.kind = PartKind::ended;
  parts.put(last, std::as_bytes(std::span(reason)));
  return kDone;
}

}  // namespace
}  // namespace palpable::sources

int main(int argc, char** argv) {
  // Without running the libraries' destructors: nothing is left to do.
  try {
    _exit(palpable::sources::run(argc, argv));
  } catch (const std::exception&) {
    _exit(palpable::sources::kFault);
  }
}
