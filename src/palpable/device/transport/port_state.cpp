// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/device/transport/port_state.hpp"

#include "palpable/device/transport/vendor_text.hpp"

#include <algorithm>
#include <cctype>
#include <fstream>
#include <sstream>
#include <string_view>
#include <system_error>

#include <sys/stat.h>
#include <sys/sysmacros.h>

namespace palpable::device {
namespace {

namespace fs = std::filesystem;

/// The first line of a file of the system, if it can be shown.
std::string line_of(const fs::path& file) {
  std::string line;
  std::getline(std::ifstream(file), line);
  return vendor_text(line.c_str(), {});
}

bool is_number(const std::string& text) {
  return !text.empty() && std::ranges::all_of(text, [](unsigned char c) { return std::isdigit(c) != 0; });
}

PortHolder holder_with(const std::string& process) {
  return {static_cast<pid_t>(std::stol(process)), line_of(fs::path("/proc") / process / "comm")};
}

bool has_open(const fs::path& process, const fs::path& port) {
  std::error_code none;
  for (const auto& entry : fs::directory_iterator(process / "fd", none))
    if (fs::read_symlink(entry.path(), none) == port) return true;
  return false;
}

/// The process of a line of /proc/locks, "1: FLOCK  ADVISORY  WRITE 123 00:05:77 0 EOF", which locks `file`.
std::optional<std::string> locker_of(const struct stat& file) {
  std::ifstream locks("/proc/locks");
  for (std::string line; std::getline(locks, line);) {
    std::istringstream words(line);
    std::string number, kind, mode, access, process;
    unsigned device_major = 0, device_minor = 0;
    std::uint64_t inode = 0;
    char colon = 0;
    words >> number >> kind >> mode >> access >> process >> std::hex >> device_major >> colon >>
        device_minor >> colon >> std::dec >> inode;
    if (words && is_number(process) && inode == file.st_ino && device_major == major(file.st_dev) &&
        device_minor == minor(file.st_dev))
      return process;
  }
  return std::nullopt;
}

}  // namespace

std::optional<UsbIdentity> usb_identity(const std::string& port, const fs::path& classes) {
  std::error_code none;
  const fs::path real = fs::canonical(port, none);
  const auto interface = fs::canonical(classes / (none ? fs::path(port) : real).filename() / "device", none);
  if (none) return std::nullopt;
  const fs::path device = interface.parent_path();
  const std::string vendor = line_of(device / "idVendor"), product = line_of(device / "idProduct");
  if (vendor.empty() || product.empty()) return std::nullopt;
  return UsbIdentity{vendor + ":" + product, line_of(device / "manufacturer"), line_of(device / "product")};
}

std::optional<PortHolder> holder_of(const std::string& port) {
  std::error_code none;
  const fs::path real = fs::canonical(port, none);
  struct stat file {};
  if (none || ::stat(real.c_str(), &file) != 0) return std::nullopt;
  for (const auto& entry : fs::directory_iterator("/proc", none)) {
    const std::string process = entry.path().filename().string();
    if (is_number(process) && has_open(entry.path(), real)) return holder_with(process);
  }
  if (const auto process = locker_of(file)) return holder_with(*process);
  return std::nullopt;
}

}  // namespace palpable::device
