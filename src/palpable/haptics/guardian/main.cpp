// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// Waits until the program that started it ends, for whatever reason, and then writes the bytes that set the
// device to zero force; also while the program's servo stands still. Descriptors: 3 is the read end of a pipe
// whose write end only that program holds, 4 is the device, 5 is shared memory: SharedBeats;
// into 6, a pipe, kGuardianReady is written when it watches. Arguments: the
// bytes in hexadecimal, the time without a tick that counts as stillness, ms, and the endpoint if the device
// is one of USB, else 0.
#include "palpable/haptics/safety/shared_beats.hpp"

#include <atomic>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>
#include <vector>

#include <linux/usbdevice_fs.h>
#include <poll.h>
#include <sched.h>
#include <sys/ioctl.h>
#include <sys/mman.h>
#include <unistd.h>

namespace {

constexpr int kProgram = 3, kDevice = 4, kBeats = 5, kReady = 6;
constexpr int kLook_ms = 3;

int digit(char c) { return c >= 'a' ? c - 'a' + 10 : c - '0'; }

std::vector<unsigned char> bytes_in(std::string_view text) {
  std::vector<unsigned char> bytes;
  for (std::size_t k = 0; k + 1 < text.size(); k += 2)
    bytes.push_back(static_cast<unsigned char>(16 * digit(text[k]) + digit(text[k + 1])));
  return bytes;
}

/// One bulk transfer to a USB device, whose interface the shared descriptor has claimed.
bool send_usb(std::vector<unsigned char> bytes, unsigned endpoint) {
  constexpr unsigned kPatience_ms = 5;
  usbdevfs_bulktransfer transfer{endpoint, static_cast<unsigned>(bytes.size()), kPatience_ms, bytes.data()};
  return ioctl(kDevice, USBDEVFS_BULK, &transfer) == static_cast<int>(bytes.size());
}

struct Zero {
  std::vector<unsigned char> bytes;
  unsigned usb_endpoint = 0;
};

bool write_all(const Zero& zero) {
  const auto& bytes = zero.bytes;
  if (zero.usb_endpoint != 0) return send_usb(bytes, zero.usb_endpoint);
  // Fails on a serial line or a socket, which have no start.
  lseek(kDevice, 0, SEEK_SET);
  for (std::size_t done = 0; done < bytes.size();) {
    const ssize_t n = write(kDevice, bytes.data() + done, bytes.size() - done);
    if (n < 0 && errno != EINTR) return false;
    if (n > 0) done += static_cast<std::size_t>(n);
  }
  return true;
}

/// Writes the bytes once each time that the counter, once it counts, stands still. Returns when the program
/// has ended.
void watch(const std::atomic<std::uint64_t>& beats, std::chrono::milliseconds still, const Zero& zero) {
  using Clock = std::chrono::steady_clock;
  std::uint64_t last = 0;
  auto since = Clock::now();
  bool written = true;
  while (true) {
    pollfd program{kProgram, POLLIN, 0};
    const int ready = poll(&program, 1, kLook_ms);
    if (ready > 0 || (ready < 0 && errno != EINTR)) return;
    const std::uint64_t now = beats.load(std::memory_order_relaxed);
    if (now != last) {
      last = now;
      since = Clock::now();
      written = false;
    } else if (!written && Clock::now() - since > still) {
      write_all(zero);
      written = true;
    }
  }
}

}  // namespace

int main(int argc, char** argv) {
  constexpr int kWrongUsage = 2;
  if (argc != 4) return kWrongUsage;
  void* shared = mmap(nullptr, sizeof(palpable::haptics::SharedBeats), PROT_READ, MAP_SHARED, kBeats, 0);
  if (shared == MAP_FAILED) return kWrongUsage;
  const Zero zero{bytes_in(argv[1]), static_cast<unsigned>(std::atoi(argv[3]))};
  for (const int number : {SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGTSTP, SIGPIPE}) std::signal(number, SIG_IGN);
  // Neither is always permitted; the program works without them.
  sched_param priority{};
  constexpr int kPriority = 85;
  priority.sched_priority = kPriority;
  sched_setscheduler(0, SCHED_FIFO, &priority);
  mlockall(MCL_CURRENT | MCL_FUTURE);
  const std::uint64_t ready = palpable::haptics::kGuardianReady;
  if (write(kReady, &ready, sizeof ready) != sizeof ready) return kWrongUsage;
  close(kReady);
  watch(*static_cast<const palpable::haptics::SharedBeats*>(shared),
        std::chrono::milliseconds(std::atoi(argv[2])), zero);
  return write_all(zero) ? 0 : 1;
}
