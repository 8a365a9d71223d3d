// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/result.hpp"

#include <string>

namespace palpable::device {

/// What hdGetError() returns, by value.
struct HdError {
  unsigned code;
  int internal_code;
  unsigned handle;
};

/// The functions of libHD that the driver calls, with their C signatures. Lengths are millimetres, forces
/// newtons.
struct HdFunctions {
  unsigned (*hdInitDevice)(const char*) = nullptr;
  void (*hdDisableDevice)(unsigned) = nullptr;
  void (*hdMakeCurrentDevice)(unsigned) = nullptr;
  void (*hdBeginFrame)(unsigned) = nullptr;
  void (*hdEndFrame)(unsigned) = nullptr;
  void (*hdEnable)(unsigned) = nullptr;
  void (*hdDisable)(unsigned) = nullptr;
  void (*hdGetDoublev)(unsigned, double*) = nullptr;
  void (*hdGetIntegerv)(unsigned, int*) = nullptr;
  void (*hdSetDoublev)(unsigned, const double*) = nullptr;
  const char* (*hdGetString)(unsigned) = nullptr;
  HdError (*hdGetError)() = nullptr;
  const char* (*hdGetErrorString)(unsigned) = nullptr;
  void (*hdStartScheduler)() = nullptr;
  void (*hdStopScheduler)() = nullptr;
  unsigned long (*hdScheduleAsynchronous)(unsigned (*)(void*), void*, unsigned short) = nullptr;
  void (*hdUnschedule)(unsigned long) = nullptr;
  unsigned (*hdCheckCalibration)() = nullptr;
  void (*hdUpdateCalibration)(unsigned) = nullptr;
};

/// libHD's numbers for parameters, capabilities and answers.
namespace hd {
inline constexpr unsigned kButtons = 0x2000;
inline constexpr unsigned kPosition = 0x2050;
inline constexpr unsigned kModel = 0x2501;
inline constexpr unsigned kUsableWorkspace = 0x2551;
inline constexpr unsigned kCalibrationStyles = 0x2555;
inline constexpr unsigned kNominalMaxForce = 0x2603;
inline constexpr unsigned kNominalMaxContinuousForce = 0x2604;
inline constexpr unsigned kCurrentForce = 0x2700;
inline constexpr unsigned kForceOutput = 0x4000;
inline constexpr unsigned kCalibrationOk = 0x5000;
inline constexpr unsigned kCalibrationNeedsUpdate = 0x5001;
inline constexpr unsigned kCalibrationNeedsManualInput = 0x5002;
/// Bits of kCalibrationStyles.
inline constexpr unsigned kResetEncoders = 1;
inline constexpr unsigned kAutomatic = 2;
inline constexpr unsigned kInkwell = 4;
inline constexpr unsigned kCallbackDone = 0;
inline constexpr unsigned kCallbackContinue = 1;
inline constexpr unsigned kNoHandle = 0xFFFFFFFF;
/// Errors after which the loop goes on: motors that are warm, a force or velocity above the limit.
inline constexpr unsigned kFirstForceError = 0x0200;
inline constexpr unsigned kWarmMotors = 0x0200;
inline constexpr unsigned kLastForceError = 0x02FF;
inline constexpr unsigned short kHighestPriority = 0xFFFF;
}  // namespace hd

/// Loads libHD from `file`, or where it is installed if that is empty. Errors (device): not installed, cannot
/// be loaded, or lacks a function.
Result<HdFunctions> load_hd(const std::string& file);

}  // namespace palpable::device
