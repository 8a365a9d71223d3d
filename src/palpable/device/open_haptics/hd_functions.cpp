// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/device/open_haptics/hd_functions.hpp"

#include "palpable/core/system/shared_library.hpp"

namespace palpable::device {

Result<HdFunctions> load_hd(const std::string& file) {
  auto library = SharedLibrary::open(file, {"libHD.so"});
  if (!library) return std::move(library).error();
  HdFunctions hd;
  Result<void> bound;
  const auto bind = [&](auto*& function, const char* name) {
    if (bound) bound = library->bind(function, name);
  };
  bind(hd.hdInitDevice, "hdInitDevice");
  bind(hd.hdDisableDevice, "hdDisableDevice");
  bind(hd.hdMakeCurrentDevice, "hdMakeCurrentDevice");
  bind(hd.hdBeginFrame, "hdBeginFrame");
  bind(hd.hdEndFrame, "hdEndFrame");
  bind(hd.hdEnable, "hdEnable");
  bind(hd.hdDisable, "hdDisable");
  bind(hd.hdGetDoublev, "hdGetDoublev");
  bind(hd.hdGetIntegerv, "hdGetIntegerv");
  bind(hd.hdSetDoublev, "hdSetDoublev");
  bind(hd.hdGetString, "hdGetString");
  bind(hd.hdGetError, "hdGetError");
  bind(hd.hdGetErrorString, "hdGetErrorString");
  bind(hd.hdStartScheduler, "hdStartScheduler");
  bind(hd.hdStopScheduler, "hdStopScheduler");
  bind(hd.hdScheduleAsynchronous, "hdScheduleAsynchronous");
  bind(hd.hdUnschedule, "hdUnschedule");
  bind(hd.hdCheckCalibration, "hdCheckCalibration");
  bind(hd.hdUpdateCalibration, "hdUpdateCalibration");
  if (!bound) return bound.error();
  return hd;
}

}  // namespace palpable::device
