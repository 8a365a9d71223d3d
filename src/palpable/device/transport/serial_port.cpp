// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/device/transport/serial_port.hpp"

#include "palpable/device/transport/port_state.hpp"

#include <cerrno>
#include <system_error>

#include <fcntl.h>
#include <poll.h>
#include <sys/file.h>
#include <sys/ioctl.h>
#include <termios.h>
#include <unistd.h>

namespace palpable::device {
namespace {

Error not_opened(const std::string& path, int why) {
  std::string message = "cannot be opened: " + std::generic_category().message(why);
  if (why == ENOENT) message = "is not there: plug the device in, or name its port (palpable devices)";
  if (why == EACCES) message = "may not be opened: add yourself to the group dialout and log in again";
  if (why == EBUSY) {
    const auto holder = holder_of(path);
    message = "is used by " + (holder ? holder->words() : "another program");
  }
  return {ErrorCode::device, std::move(message), path};
}

/// Raw bytes, no flow control, no control of the modem lines.
bool make_raw(int descriptor) {
  termios settings{};
  if (::tcgetattr(descriptor, &settings) != 0) return false;
  ::cfmakeraw(&settings);
  settings.c_cflag |= CLOCAL | CREAD;
  settings.c_cflag &= ~static_cast<tcflag_t>(HUPCL | CRTSCTS);
  settings.c_cc[VMIN] = 0;
  settings.c_cc[VTIME] = 0;
  ::cfsetspeed(&settings, B115200);
  return ::tcsetattr(descriptor, TCSANOW, &settings) == 0;
}

}  // namespace

Result<std::unique_ptr<SerialPort>> SerialPort::open(const std::string& path) {
  Descriptor descriptor(::open(path.c_str(), O_RDWR | O_NOCTTY | O_CLOEXEC | O_NONBLOCK));
  if (descriptor.number() < 0) return not_opened(path, errno);
  if (::isatty(descriptor.number()) != 1) return Error{ErrorCode::device, "is not a serial port", path};
  if (::flock(descriptor.number(), LOCK_EX | LOCK_NB) != 0) return not_opened(path, EBUSY);
  ::ioctl(descriptor.number(), TIOCEXCL);
  auto before = std::make_unique<termios>();
  if (::tcgetattr(descriptor.number(), before.get()) != 0) return not_opened(path, errno);
  if (!make_raw(descriptor.number())) return not_opened(path, errno);
  ::tcflush(descriptor.number(), TCIOFLUSH);
  return std::unique_ptr<SerialPort>(new SerialPort(std::move(descriptor), std::move(before)));
}

SerialPort::SerialPort(Descriptor descriptor, std::unique_ptr<termios> before)
    : descriptor_(std::move(descriptor)), before_(std::move(before)) {}

SerialPort::~SerialPort() {
  ::ioctl(descriptor(), TIOCNXCL);
  before_->c_cflag &= ~static_cast<tcflag_t>(HUPCL);
  ::tcsetattr(descriptor(), TCSANOW, before_.get());
}

std::size_t SerialPort::read(std::span<std::byte> bytes) noexcept {
  const ssize_t got = ::read(descriptor(), bytes.data(), bytes.size());
  if (got > 0) return static_cast<std::size_t>(got);
  if (got < 0 && errno != EAGAIN && errno != EINTR) lost_ = true;
  return 0;
}

bool SerialPort::write(std::span<const std::byte> bytes) noexcept {
  const ssize_t sent = ::write(descriptor(), bytes.data(), bytes.size());
  if (sent < 0 && errno != EAGAIN && errno != EINTR) lost_ = true;
  return sent == static_cast<ssize_t>(bytes.size());
}

void SerialPort::drop_input() noexcept { ::tcflush(descriptor(), TCIFLUSH); }

void SerialPort::drop_output() noexcept { ::tcflush(descriptor(), TCOFLUSH); }

bool SerialPort::wait_for_input(int milliseconds) const noexcept {
  pollfd waited{descriptor(), POLLIN, 0};
  return ::poll(&waited, 1, milliseconds) > 0 && (waited.revents & POLLIN) != 0;
}

}  // namespace palpable::device
