// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/work.hpp"
#include "palpable/haptics/servo/moved_workspace.hpp"
#include "palpable/haptics/servo/servo_options.hpp"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace palpable::session {

struct SessionOptions {
  haptics::ServoOptions servo;
  /// Written to recordings, and used for a simulated hand whose URL has no seed. Further hands take the next
  /// numbers.
  std::uint64_t seed = 1;
  /// Written to recordings: "shi", "park", ... if the parameters of a paper were chosen.
  std::string as_published;
  /// Written to recordings: "palpable 0.1.0", and the command line as given.
  std::string made_by = "palpable";
  std::vector<std::string> command;
  /// File in which the touch is recorded from the first tick; empty = none. The second hand has a file of its
  /// own, and so on (recording_of_hand()).
  std::filesystem::path recording;
  /// Preparing a scene (haptic_scene.hpp) takes seconds for a large relief and a ball.
  Work work;
  /// For devices with motors at this computer.
  haptics::WorkspaceOptions workspace;
  /// Called before a device is opened whose handle must be held in some way (device::hold_words()); returns
  /// when the person does. May be empty.
  std::function<void(const std::string& sentence)> hold;
  /// URLs of the devices of the hands after the first.
  std::vector<std::string> further_devices;
  /// Number of probes besides the hands, moved by move_pointer(). Hands and these: at most
  /// haptics::kMaxLiveProbes.
  std::size_t further_probes = 0;
};

/// The recording of a hand: `file` for hand 0; for hand 1 with "-2" before its suffix. Empty stays empty.
std::filesystem::path recording_of_hand(const std::filesystem::path& file, std::size_t hand);

}  // namespace palpable::session
