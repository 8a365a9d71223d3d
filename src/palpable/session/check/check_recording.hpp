// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/result.hpp"
#include "palpable/core/work.hpp"
#include "palpable/device/recording/recording.hpp"
#include "palpable/haptics/servo/latency_recorder.hpp"
#include "palpable/models/scene/scene.hpp"
#include "palpable/session/check/findings.hpp"
#include "palpable/session/touch/recording_header.hpp"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <memory>
#include <string>
#include <vector>

namespace palpable::session {

struct CheckOptions {
  /// Scenes that may have been touched; each is recognised by the hash of its shape.
  std::vector<std::shared_ptr<const models::Scene>> scenes;
  /// Greatest number of listed findings per kind; further ones are only counted.
  std::size_t most_of_a_kind = 100;
};

/// Contents of a recording and the problems that were found in it.
struct CheckReport {
  RecordedSession session;
  /// The laws in use, and where the scenes came from, each once.
  std::vector<std::string> laws;
  std::vector<std::string> scene_hashes;
  /// Ticks of the hand; and of further probes, which are only counted.
  std::uint64_t ticks = 0;
  std::uint64_t further_ticks = 0;
  std::uint64_t contact_ticks = 0;
  double duration_s = 0.0;
  double max_force_N = 0.0;
  double max_step_N = 0.0;
  haptics::LatencySummary periods;
  std::uint64_t missed = 0;
  std::uint64_t lost = 0;
  device::RecordingEnd end = device::RecordingEnd::complete;
  /// Ticks that were recomputed completely, and ticks of which only the law's force was recomputed.
  std::uint64_t recomputed = 0;
  std::uint64_t law_recomputed = 0;
  /// Recomputed ticks in which any bit differs, and the greatest difference of a force.
  std::uint64_t differing = 0;
  double max_difference_N = 0.0;
  /// Energy generated in contacts: from the recorded forces and positions alone (RecordedForces), and
  /// by the recomputed passivity observer with and without the controller (NaN if not recomputed).
  double work_made_max_J = 0.0;
  /// The plain sum of forces times movements, an upper bound (haptics::ShownWork::since_zero_max_J).
  double work_since_zero_force_max_J = 0.0;
  /// What changes of scene and of parameters brought (haptics::TickCounts; NaN if not recomputed).
  double scene_change_J = std::numeric_limits<double>::quiet_NaN();
  double made_max_J = std::numeric_limits<double>::quiet_NaN();
  double made_max_without_controller_J = std::numeric_limits<double>::quiet_NaN();
  std::vector<Finding> findings;
  /// Number of findings that are not listed.
  std::uint64_t not_listed = 0;
  std::uint64_t problems = 0;

  bool is_clean() const { return problems == 0; }
};

/// Checks a recording of any size in bounded memory: recomputes what it can and lists problems. Long work:
/// reports progress, polls cancel. Errors: as RecordingReader::open() and parse_header(); times that are not
/// finite or do not increase; interrupted.
Result<CheckReport> check_recording(const std::filesystem::path& file, const CheckOptions& options,
                                    const Work& work);

}  // namespace palpable::session
