// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/work.hpp"
#include "palpable/session/touch/live_source.hpp"
#include "palpable/vision/stereo/problem/stereo.hpp"

#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

namespace palpable::session {

/// Two pictures of a live stereo camera, taken at one time, whose rows correspond.
struct LivePair {
  /// As in LiveFrame.
  std::uint64_t number = 0;
  std::chrono::steady_clock::time_point arrival;
  Image left;
  Image right;
  std::optional<double> stamp_s = {};
  /// The cameras, as the source states them.
  std::optional<StereoRig> rig = {};
};

/// A source of pairs that arrive whether they are taken or not. One thread takes them.
class PairSource {
 public:
  PairSource() = default;
  virtual ~PairSource() = default;
  PairSource(const PairSource&) = delete;
  PairSource& operator=(const PairSource&) = delete;

  /// As LiveSource::take().
  virtual Result<std::optional<LivePair>> take(std::chrono::steady_clock::time_point deadline) = 0;
  virtual bool has_ended() const = 0;
  /// As LiveSource::loss().
  virtual std::optional<std::string> loss() { return std::nullopt; }
  /// As LiveSource::notice().
  virtual std::optional<std::string> notice() { return std::nullopt; }
};

/// The depth of a stereo camera's pairs, matched by `fast`, in at most 240 x 180 pixels. `rig`: for pictures
/// of its size, or of the same proportions; nullopt: as each pair states it, else typical cameras, so that
/// only the proportions of depths are right. Its take() also has the errors of vision::match(), and
/// invalid_input for pictures of other proportions than those of the rig. `work`: threads, and a cancellation
/// that ends the matching.
std::unique_ptr<LiveSource> matched_source(std::unique_ptr<PairSource> pairs, std::optional<StereoRig> rig,
                                           const Work& work);

}  // namespace palpable::session
