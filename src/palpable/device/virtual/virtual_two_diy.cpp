// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/device/virtual/virtual_two_diy.hpp"

#include "palpable/core/check.hpp"

#include <chrono>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <numbers>
#include <random>
#include <utility>

#include <fcntl.h>
#include <poll.h>
#include <termios.h>
#include <unistd.h>

namespace palpable::device {
namespace {

constexpr double kMass_kg = 0.3;
constexpr double kDamping_Ns_per_m = 5.0;
constexpr double kStiffness_N_per_m = 100.0;
constexpr double kStep_s = 0.001;
constexpr std::chrono::seconds kLongestWait{20};
constexpr double kDegrees = 180.0 / std::numbers::pi;

InPlane plus(InPlane a, double s, InPlane b) { return {a.x + s * b.x, a.y + s * b.y}; }

/// The force that the torques of both motors make: the solution of J^T F = tau.
InPlane force_of(const Pantograph& linkage, LinkAngles angles, std::array<double, 2> by_motor_Nm) {
  const auto j = linkage.jacobian(angles);
  if (!j) return {};
  const auto [a, b] = *j;
  const double determinant = a.x * b.y - a.y * b.x;
  return {(by_motor_Nm[0] * b.y - by_motor_Nm[1] * a.y) / determinant,
          (by_motor_Nm[1] * a.x - by_motor_Nm[0] * b.x) / determinant};
}

}  // namespace

VirtualTwoDiy::VirtualTwoDiy(const TwoDiyVariant& variant, bool ordered_by_motor)
    : variant_(variant),
      ordered_by_motor_(ordered_by_motor),
      terminal_(::posix_openpt(O_RDWR | O_NOCTTY | O_CLOEXEC)),
      place_(variant.centre),
      goal_(variant.centre) {
  PALPABLE_CHECK(terminal_.number() >= 0 && ::grantpt(terminal_.number()) == 0 &&
                 ::unlockpt(terminal_.number()) == 0);
  std::array<char, 64> name{};
  PALPABLE_CHECK(::ptsname_r(terminal_.number(), name.data(), name.size()) == 0);
  path_ = name.data();
  port_ = Descriptor(::open(path_.c_str(), O_RDWR | O_NOCTTY | O_CLOEXEC));
  termios raw{};
  ::tcgetattr(port_.number(), &raw);
  ::cfmakeraw(&raw);
  ::tcsetattr(port_.number(), TCSANOW, &raw);
  thread_ = std::thread([this] { run(); });
}

VirtualTwoDiy::~VirtualTwoDiy() {
  {
    const std::lock_guard lock(mutex_);
    ended_ = true;
  }
  thread_.join();
}

std::array<float, 2> VirtualTwoDiy::torques() const {
  const std::lock_guard lock(mutex_);
  return torques_;
}

InPlane VirtualTwoDiy::handle() const {
  const std::lock_guard lock(mutex_);
  return place_;
}

std::array<double, 2> VirtualTwoDiy::torques_by_motor() const {
  return {static_cast<double>(torques_[is_swapped() ? 1 : 0]),
          static_cast<double>(torques_[is_swapped() ? 0 : 1])};
}

InPlane VirtualTwoDiy::force_N() const {
  const std::lock_guard lock(mutex_);
  const auto angles = variant_.linkage.angles_at(place_);
  return angles ? force_of(variant_.linkage, *angles, torques_by_motor()) : InPlane{};
}

std::vector<std::uint8_t> VirtualTwoDiy::setup() const {
  const std::lock_guard lock(mutex_);
  return setup_;
}

std::uint64_t VirtualTwoDiy::messages() const {
  const std::lock_guard lock(mutex_);
  return messages_;
}

std::uint64_t VirtualTwoDiy::strange() const {
  const std::lock_guard lock(mutex_);
  return strange_;
}

void VirtualTwoDiy::wait_for(std::uint64_t messages) const {
  std::unique_lock lock(mutex_);
  changed_.wait_for(lock, kLongestWait, [&] { return messages_ >= messages; });
}

bool VirtualTwoDiy::wait_until_free() const {
  std::unique_lock lock(mutex_);
  return changed_.wait_for(lock, kLongestWait, [&] { return torques_ == std::array{0.0F, 0.0F}; });
}

void VirtualTwoDiy::pull_to(InPlane goal) {
  const std::lock_guard lock(mutex_);
  goal_ = goal;
}

void VirtualTwoDiy::inject(Fault fault) {
  const std::lock_guard lock(mutex_);
  fault_ = fault;
}

void VirtualTwoDiy::run() {
  std::uint8_t head[2];
  while (read_into(head, 2)) {
    bool whole = true;
    if (head[0] == 0) {
      const std::lock_guard lock(mutex_);
      torques_ = {};
      changed_.notify_all();
    } else if (head[0] == 1) {
      whole = take_setup();
    } else if (head[0] == 2) {
      whole = take_torques(head[1]);
    } else {
      const std::lock_guard lock(mutex_);
      ++strange_;
    }
    if (!whole) return;
  }
}

/// Waits for so many bytes; false when the test has ended or the port has hung up.
bool VirtualTwoDiy::read_into(std::uint8_t* bytes, std::size_t count) {
  std::size_t got = 0;
  while (got < count) {
    bool is_stalled = false;
    {
      const std::lock_guard lock(mutex_);
      if (ended_) return false;
      is_stalled = fault_ == Fault::stalled;
      if (fault_ == Fault::unplugged) {
        port_.close();
        terminal_.close();
        return false;
      }
    }
    if (is_stalled) {
      std::this_thread::sleep_for(std::chrono::microseconds(100));
      continue;
    }
    pollfd waited{terminal_.number(), POLLIN, 0};
    constexpr int kLookAgain_ms = 20;
    if (::poll(&waited, 1, kLookAgain_ms) <= 0) continue;
    {
      const std::lock_guard lock(mutex_);
      if (fault_ == Fault::stalled) continue;
    }
    const ssize_t read = ::read(terminal_.number(), bytes + got, count - got);
    if (read > 0) got += static_cast<std::size_t>(read);
  }
  return true;
}

bool VirtualTwoDiy::take_setup() {
  std::vector<std::uint8_t> message{1, 1};
  const auto take = [&](std::size_t count) {
    message.resize(message.size() + count);
    return read_into(message.data() + message.size() - count, count);
  };
  const auto bits = [](std::uint8_t mask) { return static_cast<std::size_t>(__builtin_popcount(mask)); };
  if (!take(1) || !take(bits(message.back()))) return false;
  if (!take(1)) return false;
  const std::size_t encoders = bits(message.back());
  if (!take(encoders) || !take(1) || !take(message.back()) || !take(1) || !take(message.back())) return false;
  if (!take(8 * encoders)) return false;
  const std::lock_guard lock(mutex_);
  setup_ = std::move(message);
  // The encoders begin with their angles at home.
  LinkAngles home{};
  for (std::size_t k = 0; k < 2; ++k) home[k] = static_cast<double>(variant_.joints[k].home_deg) / kDegrees;
  if (const auto place = variant_.linkage.handle_at(home)) place_ = *place;
  return true;
}

bool VirtualTwoDiy::take_torques(std::uint8_t id) {
  std::uint8_t bytes[8];
  if (!read_into(bytes, 8)) return false;
  const std::lock_guard lock(mutex_);
  std::memcpy(torques_.data(), bytes, 8);
  if (!std::isfinite(torques_[0]) || !std::isfinite(torques_[1])) ++strange_;
  if (const auto angles = variant_.linkage.angles_at(place_); angles && on_force)
    on_force(force_of(variant_.linkage, *angles, torques_by_motor()));
  if (on_torques) on_torques(torques_by_motor());
  move();
  answer(id);
  ++messages_;
  changed_.notify_all();
  return true;
}

void VirtualTwoDiy::move() {
  const auto angles = variant_.linkage.angles_at(place_);
  InPlane force = angles ? force_of(variant_.linkage, *angles, torques_by_motor()) : InPlane{};
  force = plus(force, kStiffness_N_per_m, {goal_.x - place_.x, goal_.y - place_.y});
  force = plus(force, -kDamping_Ns_per_m, velocity_);
  velocity_ = plus(velocity_, kStep_s / kMass_kg, force);
  const InPlane moved = plus(place_, kStep_s, velocity_);
  if (variant_.linkage.angles_at(moved)) place_ = moved;
}

void VirtualTwoDiy::answer(std::uint8_t id) {
  std::uint8_t bytes[9] = {id};
  if (const auto angles = variant_.linkage.angles_at(place_); angles && fault_ != Fault::stuck) {
    for (std::size_t k = fault_ == Fault::stuck_encoder ? 1 : 0; k < 2; ++k)
      last_answer_[is_swapped() ? 1 - k : k] = static_cast<float>(kDegrees * (*angles)[k]);
  }
  std::array<float, 2> sent = last_answer_;
  if (fault_ == Fault::reordered && messages_ % 2 == 0)
    sent = older_answer_;
  else
    older_answer_ = std::exchange(newest_answer_, sent);
  if (fault_ == Fault::wrong_calibration)
    for (float& angle : sent) angle += 60.0F;
  if (fault_ == Fault::not_finite) sent.fill(std::numeric_limits<float>::quiet_NaN());
  std::memcpy(bytes + 1, sent.data(), 8);
  std::size_t count = sizeof bytes;
  if (fault_ == Fault::silent || fault_ == Fault::unplugged) count = 0;
  if (fault_ == Fault::cut_answers) count = 4;
  if (fault_ == Fault::dropped && messages_ % 2 == 0) count = 0;
  if (fault_ == Fault::garbage) {
    static thread_local std::mt19937 random(7);
    for (std::uint8_t& byte : bytes) byte = static_cast<std::uint8_t>(random() & 0xFFU);
  }
  if (count > 0) PALPABLE_CHECK(::write(terminal_.number(), bytes, count) == static_cast<ssize_t>(count));
}

}  // namespace palpable::device
