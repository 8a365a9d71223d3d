// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/system/hand_off.hpp"
#include "palpable/core/vec3.hpp"
#include "palpable/device/hosted/futex.hpp"
#include "palpable/device/transport/force_hand_off.hpp"
#include "palpable/device/transport/library_call.hpp"

#include <array>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <string>

namespace palpable::device {

/// The descriptors with which `palpable-library-host` is started: the read end of a pipe whose write end only
/// the program holds, the shared memory, and the write end of a pipe for its answer to the opening.
inline constexpr int kHostAlive = 3;
inline constexpr int kHostMemory = 4;
inline constexpr int kHostAnswer = 5;

/// The first line of a host's answer. To be changed with HostExchange, the arguments or the descriptors, so
/// that another version's is refused.
inline constexpr const char* kHostGreeting = "palpable-library-host 1";

/// How often both sides look whether the other one still works, and for how long a call of the library may
/// last, before the host tries to free the motors from another thread, and before it is ended.
inline constexpr std::chrono::milliseconds kLibraryLook{2};
inline constexpr std::chrono::milliseconds kLateCall{5};
inline constexpr std::chrono::milliseconds kHungCall{25};

/// What the library has done with the device so far.
enum class HostStage : std::uint32_t { opens, serves, closes, closed };

/// The memory that a program and the host of its device share. Neither side waits without a limit.
struct HostExchange {
  struct State {
    Vec3 position_m;
    /// A device::Status.
    std::uint32_t status = 0;
    std::uint32_t buttons = 0;
    bool is_repeated = false;
  };
  /// Of the driver: Device::fault() and Device::guidance(), ended by a zero.
  struct Texts {
    std::array<char, 256> fault{};
    std::array<char, 256> guidance{};
  };

  // By the program. Advanced with each question, force and cut.
  FutexWord calls{0};
  /// The number of the newest question for a position.
  std::atomic<std::uint32_t> asked{0};
  /// How many forces were put.
  std::atomic<std::uint32_t> puts{0};
  ForceHandOff forces;

  // By the host. The question that was answered last, with `states`.
  FutexWord answered{0};
  LatestValue<State> states;
  LatestValue<Texts> texts;
  std::atomic<HostStage> stage{HostStage::opens};
  /// When the call of the library began that the host is in; 0: none.
  std::atomic<std::int64_t> in_call_since_ns{0};
  /// The same of the driver's own thread in the library (CallsByThread).
  std::atomic<std::int64_t> thread_in_call_since_ns{0};
};

inline void store_text(std::array<char, 256>& to, const std::string& text) {
  to[text.copy(to.data(), to.size() - 1)] = 0;
}

}  // namespace palpable::device
