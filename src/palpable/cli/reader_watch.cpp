// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/cli/reader_watch.hpp"

#include <array>
#include <csignal>

#include <poll.h>
#include <sys/eventfd.h>
#include <sys/stat.h>
#include <unistd.h>

namespace palpable::cli {
namespace {

bool has_a_reader(int descriptor) {
  struct stat status {};
  return ::fstat(descriptor, &status) == 0 && (S_ISFIFO(status.st_mode) || S_ISSOCK(status.st_mode));
}

void wait_for_either(int descriptor, int wake) {
  while (true) {
    // Without an event asked for, only the end of the reader is told.
    std::array<pollfd, 2> places{{{descriptor, 0, 0}, {wake, POLLIN, 0}}};
    if (::poll(places.data(), places.size(), -1) < 0) continue;
    if (places[1].revents != 0) return;
    if ((places[0].revents & (POLLERR | POLLHUP)) == 0) continue;
    ::kill(::getpid(), SIGTERM);
    return;
  }
}

}  // namespace

ReaderWatch::ReaderWatch(int descriptor) {
  if (descriptor < 0 || !has_a_reader(descriptor)) return;
  wake_ = ::eventfd(0, EFD_CLOEXEC);
  if (wake_ >= 0) thread_ = std::thread(wait_for_either, descriptor, wake_);
}

ReaderWatch::~ReaderWatch() {
  if (!thread_.joinable()) return;
  ::eventfd_write(wake_, 1);
  thread_.join();
  ::close(wake_);
}

}  // namespace palpable::cli
