// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/device/virtual/library_board.hpp"
#include "palpable/session/check/driver_bench.hpp"

#include <atomic>
#include <chrono>
#include <memory>
#include <string>
#include <thread>
#include <utility>

#include <gtest/gtest.h>
#include <unistd.h>

// For tests: a vendor's virtual library in a process of its own, as a touch has it.
namespace palpable::session {

/// The board of one library, and a thread that tells the forces that were set on it.
class HostedBoard {
 public:
  using Axes = Vec3 (*)(Vec3);

  /// `ours` turns the library's axes into ours.
  HostedBoard(OnForce on_force, Axes ours)
      : file_(testing::TempDir() + "board-" + std::to_string(::getpid())) {
    ::unlink(file_.c_str());
    ::setenv(device::LibraryBoard::kVariable, file_.c_str(), 1);
    board_ = device::share_board(file_.c_str());
    thread_ = std::thread([this, told = std::move(on_force), ours] { tell(told, ours); });
  }
  ~HostedBoard() {
    ends_ = true;
    thread_.join();
    ::unsetenv(device::LibraryBoard::kVariable);
    ::munmap(board_, sizeof(device::LibraryBoard));
    ::unlink(file_.c_str());
  }
  HostedBoard(const HostedBoard&) = delete;
  HostedBoard& operator=(const HostedBoard&) = delete;

  device::LibraryBoard& board() const { return *board_; }

 private:
  void tell(const OnForce& on_force, Axes ours) const {
    for (std::uint64_t told = 0; !ends_;) {
      const std::uint64_t sets = board_->sets.load(std::memory_order_acquire);
      for (; told < sets; ++told)
        if (on_force) on_force(ours(board_->forces_N[told % device::LibraryBoard::kForces]));
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
  }
  std::string file_;
  device::LibraryBoard* board_;
  std::atomic<bool> ends_{false};
  std::thread thread_;
};

/// `theirs` turns our axes into the library's.
inline DriverBench hosted_bench(const OnForce& on_force, const std::string& url, HostedBoard::Axes ours,
                                HostedBoard::Axes theirs) {
  const auto hosted = std::make_shared<HostedBoard>(on_force, ours);
  DriverBench bench;
  bench.open = [url] { return device::open_device(url, {}); };
  bench.pull_to = [hosted, theirs](Vec3 goal) { hosted->board().goal_m.put(theirs(goal)); };
  bench.pass_tick = [] { std::this_thread::sleep_for(std::chrono::milliseconds(1)); };
  bench.is_real_time = true;
  bench.motors_N = [hosted, ours] { return ours(hosted->board().held()); };
  return bench;
}

inline DriverBench hosted_force_dimension_bench(const OnForce& on_force) {
  return hosted_bench(
      on_force, "forcedimension:?library=" PALPABLE_VIRTUAL_DHD,
      [](Vec3 theirs) {
        return Vec3{theirs.y, theirs.z, theirs.x};
      },
      [](Vec3 ours) {
        return Vec3{ours.z, ours.x, ours.y};
      });
}

inline DriverBench hosted_open_haptics_bench(const OnForce& on_force) {
  const auto same = [](Vec3 vector) { return vector; };
  return hosted_bench(on_force, "touch:?library=" PALPABLE_VIRTUAL_HD, same, same);
}

}  // namespace palpable::session
