// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

namespace palpable::device {

/// Where the system looks for the rules below.
inline constexpr std::string_view kRulesFile = "/etc/udev/rules.d/60-palpable.rules";

/// The rules that give the logged-in user access to devices, and keep ModemManager away from them; as in
/// docs/devices.md. Serial ports: Haply 2DIY, 3D Systems Touch. USB: Novint Falcon, Force Dimension.
/// Joysticks have the system's own rule.
inline constexpr std::string_view kRules =
    R"(SUBSYSTEM=="tty", KERNEL=="ttyACM[0-9]*", TAG+="uaccess", ENV{ID_MM_PORT_IGNORE}="1"
SUBSYSTEM=="usb", ATTR{idVendor}=="0403", ATTR{idProduct}=="cb48", TAG+="uaccess"
SUBSYSTEM=="usb", ATTR{idVendor}=="1451", TAG+="uaccess"
)";

}  // namespace palpable::device
