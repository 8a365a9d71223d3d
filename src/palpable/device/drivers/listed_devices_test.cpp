// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// What the list of devices says of serial ports, and the same device by two names.
#include "palpable/device/drivers/open.hpp"
#include "palpable/device/transport/port_state.hpp"
#include "palpable/device/two_diy/two_diy.hpp"

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

namespace palpable::device {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

/// A folder of serial ports as the system has it, with one port, ttyACM0.
fs::path folder_of_ports(const std::string& vendor, const std::string& maker, const std::string& product) {
  const fs::path root = fs::path(testing::TempDir()) / ("ports" + vendor + std::to_string(::getpid()));
  fs::remove_all(root);
  const fs::path device = root / "devices/1-1";
  fs::create_directories(device / "1-1:1.0");
  fs::create_directories(root / "tty/ttyACM0");
  fs::create_directory_symlink(device / "1-1:1.0", root / "tty/ttyACM0/device");
  std::ofstream(device / "idVendor") << vendor << "\n";
  std::ofstream(device / "idProduct") << "804d\n";
  std::ofstream(device / "manufacturer") << maker << "\n";
  std::ofstream(device / "product") << product << "\n";
  return root / "tty";
}

TEST(ListedSerialPort, IsA2DiyOnlyIfItSaysSo) {
  DeviceKind board{.url = "2diy:/dev/ttyACM0", .name = {}, .description = {}, .note = {}, .advice = {}};
  const auto arduino = usb_identity("/dev/ttyACM0", folder_of_ports("2341", "Arduino LLC", "Arduino Zero"));
  ASSERT_TRUE(arduino);
  EXPECT_EQ(arduino->numbers, "2341:804d");
  describe_serial_port(board, "/nowhere/ttyACM0", arduino);
  EXPECT_TRUE(board.available && board.may_be);
  EXPECT_EQ(board.note, "a serial port that may be one (Arduino Zero, USB 2341:804d)");

  DeviceKind real = board;
  real.may_be = false;
  real.note.clear();
  const auto haply = usb_identity("/dev/ttyACM0", folder_of_ports("1209", "Haply Robotics", "Board"));
  ASSERT_TRUE(haply);
  describe_serial_port(real, "/nowhere/ttyACM0", haply);
  EXPECT_TRUE(real.available && !real.may_be && real.note.empty());
  EXPECT_FALSE(usb_identity("/dev/ttyACM7", folder_of_ports("2341", "x", "y")));
}

TEST(ListedSerialPort, IsNotReadyWhileAProgramHoldsIt) {
  const int line = ::posix_openpt(O_RDWR | O_NOCTTY | O_CLOEXEC);
  ASSERT_TRUE(line >= 0 && ::grantpt(line) == 0 && ::unlockpt(line) == 0);
  const std::string port = ::ptsname(line);  // NOLINT(concurrency-mt-unsafe): one thread
  EXPECT_FALSE(holder_of(port));
  {
    const int open = ::open(port.c_str(), O_RDWR | O_NOCTTY | O_CLOEXEC);
    ASSERT_GE(open, 0);
    const auto holder = holder_of(port);
    ::close(open);
    ASSERT_TRUE(holder);
    EXPECT_EQ(holder->process, ::getpid());
    EXPECT_FALSE(holder->program.empty());
  }
  EXPECT_FALSE(holder_of(port));
  const std::string link = testing::TempDir() + "port" + std::to_string(::getpid());
  ::unlink(link.c_str());
  fs::create_symlink(port, link);
  const int open = ::open(port.c_str(), O_RDWR | O_NOCTTY | O_CLOEXEC);
  DeviceKind kind{.url = {}, .name = {}, .description = {}, .note = {}, .advice = {}};
  describe_serial_port(kind, link, std::nullopt);
  ::close(open);
  ::close(line);
  ::unlink(link.c_str());
  EXPECT_FALSE(kind.available);
  EXPECT_THAT(kind.note, HasSubstr("in use by "));
  EXPECT_EQ(kind.advice, "end that program");
}

TEST(DevicesTogether, AreRefusedIfTheyAreOneByTwoNames) {
  const fs::path folder = fs::path(testing::TempDir()) / ("names" + std::to_string(::getpid()));
  fs::remove_all(folder);
  fs::create_directories(folder / "other");
  std::ofstream(folder / "motors") << "x";
  fs::create_symlink(folder / "motors", folder / "link");
  fs::create_hard_link(folder / "motors", folder / "hard");
  const auto sim = [&](const char* name) { return "sim:?motors=" + (folder / name).string(); };
  for (const char* other : {"motors", "link", "hard", "other/../motors"})
    EXPECT_FALSE(check_together({sim("motors"), sim(other)})) << other;
  EXPECT_TRUE(check_together({sim("motors"), sim("second")}));
  EXPECT_FALSE(check_together({sim("second"), sim("other/../second")}));
  const auto port = [&](const char* name) { return "2diy:" + (folder / name).string(); };
  for (const char* other : {"link", "hard"})
    EXPECT_FALSE(check_together({port("motors"), port(other) + "?variant=v1"})) << other;
  EXPECT_TRUE(check_together({port("motors"), port("second")}));
  fs::remove_all(folder);
}

}  // namespace
}  // namespace palpable::device
