// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/device/virtual/virtual_falcon.hpp"

#include "palpable/device/falcon/falcon_kinematics.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <initializer_list>
#include <numbers>
#include <span>
#include <utility>

namespace palpable::device {
namespace {

constexpr double kFalconStep_s = 1e-4;
constexpr double kDegree = std::numbers::pi / 180.0;
constexpr double kCount_rad = 0.036435 * kDegree;
constexpr double kPerWord_Nm = -1e-4;
constexpr std::uint16_t kRunBaud = 0x0002, kGreetBaud = 0x4138, kLoadBaud = 0x0015;

std::vector<std::byte> bytes(std::initializer_list<int> values) {
  std::vector<std::byte> out;
  for (const int value : values) out.push_back(static_cast<std::byte>(value));
  return out;
}

int word_of(std::span<const std::byte> letters) {
  unsigned word = 0;
  for (std::size_t n = 0; n < 4; ++n) word |= (std::to_integer<unsigned>(letters[n]) - 0x41U) << (4U * n);
  return static_cast<std::int16_t>(word);
}

}  // namespace

class VirtualFalcon::Transfers final : public UsbTransfers {
 public:
  explicit Transfers(VirtualFalcon& falcon) : falcon_(falcon) {}
  bool control(std::uint8_t request, std::uint16_t value) noexcept override {
    return falcon_.control(request, value);
  }
  bool send(std::span<const std::byte> bytes) noexcept override { return falcon_.send(bytes); }
  std::size_t receive(Packet& packet, double longest_s) noexcept override {
    return falcon_.receive(packet, longest_s);
  }
  double now_s() const noexcept override { return falcon_.now_s_; }
  bool lost() const noexcept override { return falcon_.fault_ == Fault::unplugged; }

 private:
  VirtualFalcon& falcon_;
};

VirtualFalcon::VirtualFalcon(Options options)
    : options_(std::move(options)),
      state_(options_.firmware_runs ? State::running : State::boot),
      homed_(options_.homed) {
  grip_.position_m = falcon::kCentre_m;
  grip_.goal_m = falcon::kCentre_m;
}

std::unique_ptr<UsbTransfers> VirtualFalcon::plug_in() { return std::make_unique<Transfers>(*this); }

bool VirtualFalcon::control(std::uint8_t request, std::uint16_t value) {
  if (fault_ == Fault::unplugged) return false;
  if (request == 0 && value == 1) line_.clear();
  if (request == 0 && value == 2) command_.clear();
  if (request == 1) dtr_ = (value & 0xFF00U) == 0x0100 ? (value & 1U) != 0 : dtr_;
  if (request == 3) set_baud(value);
  if (request == 9) latency_s_ = 1e-3 * value;
  return true;
}

void VirtualFalcon::set_baud(std::uint16_t divisor) {
  // The boot program starts what was loaded; something else than the firmware does not answer.
  if (divisor == kRunBaud && state_ == State::loading)
    state_ = image_ == options_.firmware ? State::running : State::dead;
  if (divisor == kGreetBaud && state_ != State::running) {
    state_ = State::boot;
    image_.clear();
  }
  baud_ = divisor;
}

bool VirtualFalcon::send(std::span<const std::byte> sent) {
  if (fault_ == Fault::unplugged || fault_ == Fault::stalled) return false;
  if (state_ != State::running) {
    boot_with(sent);
    return true;
  }
  if (baud_ != kRunBaud) return true;
  for (const std::byte byte : sent) {
    if (command_.empty() && byte != std::byte{'<'}) {
      ++strange_;
      continue;
    }
    command_.push_back(byte);
    if (command_.size() == 16) take_command();
  }
  return true;
}

void VirtualFalcon::boot_with(std::span<const std::byte> sent) {
  if (!options_.boots || state_ == State::dead) return;
  if (state_ == State::boot && baud_ == kGreetBaud && dtr_ && std::ranges::equal(sent, bytes({10, 67, 13}))) {
    queue(bytes({0, 0x0A, 0x44, 0x2C, 0x0D}));
    state_ = State::greeted;
  } else if (state_ == State::greeted && baud_ == kLoadBaud && !dtr_ && sent.front() == std::byte{0x41}) {
    queue(sent);
    state_ = State::loading;
  } else if (state_ == State::loading) {
    image_.insert(image_.end(), sent.begin(), sent.end());
    std::vector<std::byte> echo(sent.begin(), sent.end());
    if (options_.good_echoes > 0) {
      --options_.good_echoes;
    } else if (options_.wrong_echoes > 0) {
      --options_.wrong_echoes;
      echo[random_() % echo.size()] ^= static_cast<std::byte>(1U << (random_() % 8));
    }
    queue(echo);
  }
}

void VirtualFalcon::take_command() {
  const auto whole = std::exchange(command_, {});
  const bool letters = std::ranges::all_of(std::span(whole).subspan(1, 12), [](std::byte b) {
    return std::to_integer<int>(b) >= 0x41 && std::to_integer<int>(b) <= 0x50;
  });
  if (!letters || whole[15] != std::byte{'>'}) {
    strange_ += whole.size();
    return;
  }
  for (std::size_t k = 0; k < 3; ++k) motors_[k] = word_of(std::span(whole).subspan(1 + 4 * k, 4));
  lights_ = static_cast<std::uint8_t>(std::to_integer<unsigned>(whole[13]) - 0x41U);
  ++commands_;
  if (on_command) on_command();
  reply();
}

std::array<int, 3> VirtualFalcon::counts() const {
  std::array<int, 3> out{};
  const auto angles = falcon::angles_at(grip_.position_m);
  if (!angles) return out;
  for (std::size_t k = 0; k < 3; ++k)
    out[k] = static_cast<int>(std::lround(((*angles)[k] - 35.0 * kDegree) / kCount_rad));
  return out;
}

std::vector<std::byte> VirtualFalcon::reply_packet() {
  auto measured = counts();
  if (fault_ != Fault::stuck_encoder) {
    stuck_count_ = measured[1];
  } else {
    measured[1] = stuck_count_;
  }
  if (fault_ == Fault::wrong_calibration)
    for (int& count : measured) count += 4000;
  std::vector<std::byte> packet{std::byte{'<'}};
  for (const int count : measured)
    for (unsigned n = 0; n < 4; ++n)
      packet.push_back(static_cast<std::byte>(0x41U + ((static_cast<unsigned>(count) >> (4U * n)) & 15U)));
  packet.push_back(static_cast<std::byte>(0x41U + buttons_ + (homed_ ? 0x70U : 0U)));
  packet.push_back(std::byte{0x41});
  packet.push_back(std::byte{'>'});
  return packet;
}

void VirtualFalcon::reply() {
  auto packet = reply_packet();
  if (fault_ == Fault::silent) return;
  if (fault_ == Fault::garbage)
    for (std::byte& byte : packet) byte = static_cast<std::byte>(random_() & 0xFFU);
  if (fault_ == Fault::short_packets) packet.resize(8);
  if (fault_ == Fault::dropped && commands_ % 2 == 0) return;
  if (fault_ == Fault::reordered) {
    if (kept_reply_.empty()) {
      kept_reply_ = packet;
      return;
    }
    packet.insert(packet.end(), kept_reply_.begin(), kept_reply_.end());
    kept_reply_.clear();
  }
  queue(packet);
}

Vec3 VirtualFalcon::force_N() const {
  const auto angles = falcon::angles_at(grip_.position_m);
  const auto moved = angles ? falcon::jacobian(*angles, grip_.position_m) : std::nullopt;
  if (!moved) return {};
  // Solves J^T F = tau for the force.
  const auto& [a, b, c] = *moved;
  const double determinant = dot(a, cross(b, c));
  const auto torque = [&](std::size_t k) { return kPerWord_Nm * motors_[k]; };
  return (1.0 / determinant) * (torque(0) * cross(b, c) + torque(1) * cross(c, a) + torque(2) * cross(a, b));
}

void VirtualFalcon::step() {
  now_s_ += kFalconStep_s;
  const MovedHandle before = grip_;
  grip_.move(fault_ == Fault::unplugged ? Vec3{} : force_N(), kFalconStep_s);
  // The stops.
  if (!falcon::angles_at(grip_.position_m)) {
    grip_.position_m = before.position_m;
    grip_.velocity_m_per_s = {};
  }
  if (on_step) on_step();
}

std::size_t VirtualFalcon::receive(UsbTransfers::Packet& packet, double longest_s) {
  constexpr std::size_t kMost = 62;
  const double until_s = now_s_ + longest_s - 0.5 * kFalconStep_s;
  do {
    step();
    if (fault_ == Fault::unplugged || fault_ == Fault::stalled) continue;
    if (line_.size() < kMost && now_s_ - packet_s_ < latency_s_ - 0.5 * kFalconStep_s) continue;
    packet_s_ = now_s_;
    packet[0] = std::byte{1};
    packet[1] = std::byte{0x60};
    const std::size_t count = std::min(kMost, line_.size());
    std::copy_n(line_.begin(), count, packet.begin() + UsbTransfers::kStatus_bytes);
    line_.erase(line_.begin(), line_.begin() + static_cast<std::ptrdiff_t>(count));
    return count + UsbTransfers::kStatus_bytes;
  } while (now_s_ < until_s);
  return 0;
}

}  // namespace palpable::device
