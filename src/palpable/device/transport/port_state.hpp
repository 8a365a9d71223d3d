// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include <sys/types.h>

// What the system knows of a serial port without opening it: opening resets some boards.
namespace palpable::device {

/// What a serial port's USB device says of itself; texts are empty where it says nothing that can be shown.
struct UsbIdentity {
  /// "2341:804d": vendor and product, hexadecimal.
  std::string numbers;
  std::string maker;
  std::string product;
};

/// nullopt if the port is none of USB, or is not there. `classes`: the system's folder of serial ports.
std::optional<UsbIdentity> usb_identity(const std::string& port,
                                        const std::filesystem::path& classes = "/sys/class/tty");

/// A program that holds a port.
struct PortHolder {
  pid_t process = 0;
  /// Its name, or empty if the system does not say.
  std::string program;

  /// "screen (process 1234)".
  std::string words() const {
    return (program.empty() ? "another program" : program) + " (process " + std::to_string(process) + ")";
  }
};

/// A program that has the port open, or has locked it by flock(). nullopt: none is known; programs of other
/// users are only seen by their locks.
std::optional<PortHolder> holder_of(const std::string& port);

}  // namespace palpable::device
