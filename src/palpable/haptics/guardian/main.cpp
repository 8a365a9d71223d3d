// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// Waits until the program that started it ends, for whatever reason, and then writes the bytes that set the
// device to zero force. Descriptors: 3 is the read end of a pipe whose write end only that program holds, 4
// is the device. Argument: the bytes in hexadecimal.
#include <cerrno>
#include <csignal>
#include <cstddef>
#include <string_view>
#include <vector>

#include <sched.h>
#include <sys/mman.h>
#include <unistd.h>

namespace {

constexpr int kProgram = 3, kDevice = 4;

int digit(char c) { return c >= 'a' ? c - 'a' + 10 : c - '0'; }

std::vector<unsigned char> bytes_in(std::string_view text) {
  std::vector<unsigned char> bytes;
  for (std::size_t k = 0; k + 1 < text.size(); k += 2)
    bytes.push_back(static_cast<unsigned char>(16 * digit(text[k]) + digit(text[k + 1])));
  return bytes;
}

void wait_for_end() {
  char byte = 0;
  while (true) {
    const ssize_t got = read(kProgram, &byte, 1);
    if (got == 0 || (got < 0 && errno != EINTR)) return;
  }
}

bool write_all(const std::vector<unsigned char>& bytes) {
  // Fails on a serial line or a socket, which have no start.
  lseek(kDevice, 0, SEEK_SET);
  for (std::size_t done = 0; done < bytes.size();) {
    const ssize_t n = write(kDevice, bytes.data() + done, bytes.size() - done);
    if (n < 0 && errno != EINTR) return false;
    if (n > 0) done += static_cast<std::size_t>(n);
  }
  return true;
}

}  // namespace

int main(int argc, char** argv) {
  constexpr int kWrongUsage = 2;
  if (argc != 2) return kWrongUsage;
  const auto bytes = bytes_in(argv[1]);
  for (const int number : {SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGTSTP, SIGPIPE}) std::signal(number, SIG_IGN);
  // Neither is always permitted; the program works without them.
  sched_param priority{};
  constexpr int kPriority = 85;
  priority.sched_priority = kPriority;
  sched_setscheduler(0, SCHED_FIFO, &priority);
  mlockall(MCL_CURRENT | MCL_FUTURE);
  wait_for_end();
  return write_all(bytes) ? 0 : 1;
}
