// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/device/force_dimension/dhd_functions.hpp"

#include "palpable/core/system/shared_library.hpp"

namespace palpable::device {

Result<DhdFunctions> load_dhd(const std::string& file) {
  auto library = SharedLibrary::open(file, {"libdhd.so", "libdrd.so"});
  if (!library) return std::move(library).error();
  DhdFunctions dhd;
  Result<void> bound;
  const auto bind = [&](auto*& function, const char* name) {
    if (bound) bound = library->bind(function, name);
  };
  bind(dhd.dhdGetDeviceCount, "dhdGetDeviceCount");
  bind(dhd.dhdOpenID, "dhdOpenID");
  bind(dhd.dhdClose, "dhdClose");
  bind(dhd.dhdStop, "dhdStop");
  bind(dhd.dhdEnableForce, "dhdEnableForce");
  bind(dhd.dhdGetPosition, "dhdGetPosition");
  bind(dhd.dhdSetForce, "dhdSetForce");
  bind(dhd.dhdGetButton, "dhdGetButton");
  bind(dhd.dhdGetMaxForce, "dhdGetMaxForce");
  bind(dhd.dhdGetSystemName, "dhdGetSystemName");
  bind(dhd.dhdErrorGetLastStr, "dhdErrorGetLastStr");
  if (!bound) return bound.error();
  // The functions for robots may be in a library of their own.
  if (!library->bind(dhd.drdAutoInit, "drdAutoInit"))
    if (const auto robots = SharedLibrary::open({}, {"libdrd.so"}))
      if (!robots->bind(dhd.drdAutoInit, "drdAutoInit")) dhd.drdAutoInit = nullptr;
  return dhd;
}

}  // namespace palpable::device
