// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/system/hand_off.hpp"
#include "palpable/core/vec3.hpp"

#include <array>
#include <atomic>
#include <cstdint>
#include <cstdlib>
#include <new>
#include <string>

#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

namespace palpable::device {

/// The calls of a vendor's library in which it may misbehave.
enum class VendorCall : int { none, opening, reading, forcing, closing };
/// And what it does there.
enum class Misdeed : int { none, exits, aborts, crashes, hangs };

/// The memory that a test and a virtual vendor's library in another process share: the device behind the
/// library outlives that process, as a real one does, and holds its last force. Vectors are in the library's
/// own axes.
struct LibraryBoard {
  static constexpr const char* kVariable = "PALPABLE_LIBRARY_BOARD";
  static constexpr std::size_t kForces = 1U << 16U;

  // By the test.
  std::atomic<VendorCall> where{VendorCall::none};
  std::atomic<Misdeed> what{Misdeed::none};
  /// How many calls misbehave.
  std::atomic<int> times{0};
  LatestValue<Vec3> goal_m;

  // By the library.
  std::array<std::atomic<double>, 3> held_N{};
  /// How many forces were set, and the last kForces of them.
  std::atomic<std::uint64_t> sets{0};
  std::array<Vec3, kForces> forces_N{};

  void set(Vec3 force_N) {
    const std::uint64_t number = sets.load(std::memory_order_relaxed);
    forces_N[number % kForces] = force_N;
    sets.store(number + 1, std::memory_order_release);
    hold(force_N);
  }
  void hold(Vec3 force_N) {
    held_N[0] = force_N.x;
    held_N[1] = force_N.y;
    held_N[2] = force_N.z;
  }
  Vec3 held() const { return {held_N[0], held_N[1], held_N[2]}; }

  /// The library was called.
  void pass(VendorCall call) {
    if (where.load() != call || times.fetch_sub(1) <= 0) return;
    switch (what.load()) {
      case Misdeed::exits:
        std::exit(3);  // NOLINT(concurrency-mt-unsafe): as a vendor's library may
      case Misdeed::aborts:
        std::abort();
      case Misdeed::crashes:
        *static_cast<volatile int*>(nullptr) = 1;
        break;
      case Misdeed::hangs:
        while (true) ::pause();
      case Misdeed::none:
        break;
    }
  }
};

/// The memory in the file with this name, which is made if it is missing; null: it cannot be shared.
inline LibraryBoard* share_board(const char* file) {
  const int descriptor = ::open(file, O_RDWR | O_CREAT | O_CLOEXEC, 0600);
  if (descriptor < 0) return nullptr;
  const bool is_new = ::lseek(descriptor, 0, SEEK_END) == 0;
  void* mapped =
      ::ftruncate(descriptor, sizeof(LibraryBoard)) == 0
          ? ::mmap(nullptr, sizeof(LibraryBoard), PROT_READ | PROT_WRITE, MAP_SHARED, descriptor, 0)
          : MAP_FAILED;
  ::close(descriptor);
  if (mapped == MAP_FAILED) return nullptr;
  return is_new ? new (mapped) LibraryBoard : static_cast<LibraryBoard*>(mapped);
}

/// The board that the environment names; null: there is none.
inline LibraryBoard* library_board() {
  static LibraryBoard* const board = [] {
    const char* file = std::getenv(LibraryBoard::kVariable);  // NOLINT(concurrency-mt-unsafe)
    return file != nullptr ? share_board(file) : nullptr;
  }();
  return board;
}

/// In a virtual library: it was called.
inline void pass(VendorCall call) {
  if (LibraryBoard* board = library_board(); board != nullptr) board->pass(call);
}

}  // namespace palpable::device
