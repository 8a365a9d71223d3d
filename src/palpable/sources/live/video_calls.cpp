// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sources/live/video_calls.hpp"

#include <cerrno>

#include <fcntl.h>
#include <poll.h>
#include <sys/ioctl.h>
#include <sys/mman.h>
#include <unistd.h>

namespace palpable::sources {
namespace {

class SystemCalls final : public VideoCalls {
 public:
  int open(const char* path) override { return ::open(path, O_RDWR | O_NONBLOCK | O_CLOEXEC); }
  void close(int descriptor) override { ::close(descriptor); }
  int control(int descriptor, unsigned long request, void* argument) override {
    int result = -1;
    do result = ::ioctl(descriptor, request, argument);
    while (result < 0 && errno == EINTR);
    return result;
  }
  void* map(int descriptor, std::size_t bytes, std::size_t offset) override {
    void* begin =
        ::mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_SHARED, descriptor, static_cast<off_t>(offset));
    return begin == MAP_FAILED ? nullptr : begin;
  }
  void unmap(void* begin, std::size_t bytes) override { ::munmap(begin, bytes); }
  void wait(int descriptor, std::chrono::milliseconds longest) override {
    pollfd waited{descriptor, POLLIN, 0};
    ::poll(&waited, 1, static_cast<int>(longest.count()));
  }
};

}  // namespace

VideoCalls& system_video_calls() {
  static SystemCalls calls;
  return calls;
}

}  // namespace palpable::sources
