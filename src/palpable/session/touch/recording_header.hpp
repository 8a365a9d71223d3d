// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/result.hpp"
#include "palpable/device/device.hpp"
#include "palpable/haptics/tick/tick.hpp"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace palpable::session {

/// Data of a whole recorded session.
struct RecordedSession {
  /// Format 2 contains everything below. Format 1 (read, but no longer written) has no traits, tick options,
  /// URL and command.
  int format = 2;
  std::string made_by;
  std::vector<std::string> command;
  std::uint64_t seed = 1;
  double rate_hz = 1000.0;
  std::string device_url;
  std::string device_name;
  /// nullopt in format 1.
  std::optional<device::Traits> traits;
  haptics::TickOptions tick;
  std::string as_published;
  /// Whether the recording program used the same velocity estimator and energy reserve as this one.
  bool has_our_estimator = true;

  /// Whether every tick can be recomputed to the last bit.
  bool repeats() const { return traits && has_our_estimator; }
};

/// The header as one JSON object (docs/recording.md); numbers are restored to the last bit.
std::string header_json(const RecordedSession& session);
/// Reads a header. Errors (invalid_input), without a place: another kind of object, a later format, or values
/// that no touch has (rate, the device's traits, the tick's options). Whoever reads a recording asks it:
/// `check`, `export` and `replay:` (device::OpenOptions::check_header).
Result<RecordedSession> parse_header(const std::string& json);
/// The same of a file. Errors: also those of device::RecordingReader::open().
Result<RecordedSession> read_recorded_session(const std::filesystem::path& file);

}  // namespace palpable::session
