// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/result.hpp"
#include "palpable/device/device.hpp"
#include "palpable/haptics/servo/tick.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace palpable::session {

/// What holds for a whole recorded session.
struct RecordedSession {
  /// 2: everything below. 1 (read, no longer written): no traits, tick options, URL and command.
  int format = 2;
  std::string made_by;
  std::vector<std::string> command;
  std::uint64_t seed = 1;
  double rate_hz = 1000.0;
  std::string device_url;
  std::string device_name;
  /// Not given in format 1.
  std::optional<device::Traits> traits;
  haptics::TickOptions tick;
  std::string as_published;
  /// The velocity estimator and energy reserve of the program that recorded are those of this one.
  bool has_our_estimator = true;

  /// Whether every tick can be recomputed to the last bit.
  bool repeats() const { return traits && has_our_estimator; }
};

/// One JSON object (docs/recording.md); numbers come back to the last bit.
std::string header_json(const RecordedSession& session);
/// Errors (invalid_input), without a place: not such an object, or of a later format.
Result<RecordedSession> parse_header(const std::string& json);

}  // namespace palpable::session
