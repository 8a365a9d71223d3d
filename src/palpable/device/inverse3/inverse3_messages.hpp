// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/vec3.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace palpable::device {

/// How a force is written into a command: newer services take `vector`, older ones `values`; both ignore the
/// other silently.
enum class Inverse3Form : std::uint8_t { both, vector, values };

/// What a message of the service says about one device. Lengths are metres in the service's frame: x to the
/// right, y away from the user, z up.
struct Inverse3State {
  std::string device_id;
  std::optional<Vec3> position_m;
  /// The force that the service says it makes now, N.
  std::optional<Vec3> force_N;
  /// nullopt: the message does not say it.
  std::optional<bool> calibrated;
  std::optional<bool> ready;
  /// Names of the service's own filters that are switched on, which change forces: at most eight, of those
  /// that are short and can be shown.
  std::vector<std::string> filters;
};

/// The state of the device with this identifier in a message; with an empty one, of the first device. nullopt
/// if the message is no state, is nested deeper than any state is, or has no such device. A device whose
/// identifier is longer than 64 bytes or cannot be shown is none.
std::optional<Inverse3State> parse_inverse3_state(std::string_view message, std::string_view device_id);

/// Whether a message is a state or a list of devices, be it an empty one.
bool is_inverse3_list(std::string_view message);

/// The command that makes this force (in the service's frame, N, finite). The first one also names the
/// session.
std::string inverse3_command(std::string_view device_id, Vec3 force_N, Inverse3Form form, bool first);

}  // namespace palpable::device
