// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/result.hpp"

#include <string>

namespace palpable::device {

/// The functions of Force Dimension's library (DHD, and one of DRD) that the driver calls, with their C
/// signatures. Lengths are metres, forces newtons. A negative answer is an error; 1 and 2 are not (a force
/// that was sent too early, motors at their limit).
struct DhdFunctions {
  int (*dhdGetDeviceCount)() = nullptr;
  int (*dhdOpenID)(char) = nullptr;
  int (*dhdClose)(char) = nullptr;
  int (*dhdStop)(char) = nullptr;
  int (*dhdEnableForce)(unsigned char, char) = nullptr;
  int (*dhdGetPosition)(double*, double*, double*, char) = nullptr;
  int (*dhdSetForce)(double, double, double, char) = nullptr;
  int (*dhdGetButton)(int, char) = nullptr;
  double (*dhdGetMaxForce)(char) = nullptr;
  const char* (*dhdGetSystemName)(char) = nullptr;
  const char* (*dhdErrorGetLastStr)() = nullptr;
  /// Moves the handle by its motors until its position is known; nullptr if the library is not there.
  int (*drdAutoInit)(char) = nullptr;
};

/// Loads the library from `file`, or where it is installed if that is empty. Errors (device): not installed,
/// cannot be loaded, or lacks a function.
Result<DhdFunctions> load_dhd(const std::string& file);

}  // namespace palpable::device
