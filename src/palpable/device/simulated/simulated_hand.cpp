// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/device/simulated/simulated_hand.hpp"

#include "palpable/core/check.hpp"
#include "palpable/device/open_options.hpp"
#include "palpable/device/url.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace palpable::device {
namespace {

constexpr int kSteps = 10;

Traits traits_of(const HandOptions& options) {
  Traits traits;
  traits.name = options.degrees_of_freedom == 3 ? "simulated hand" : "simulated hand in the plane";
  traits.degrees_of_freedom = options.degrees_of_freedom;
  traits.workspace_m = options.script.workspace_m;
  traits.max_force_N = options.max_force_N;
  traits.continuous_force_N = options.continuous_force_N;
  traits.mass_kg = options.device_mass_kg;
  traits.damping_Ns_per_m = options.device_damping_Ns_per_m;
  traits.coulomb_friction_N = options.device_friction_N;
  traits.position_resolution_m = options.resolution_m;
  traits.delay_samples = options.delay_samples;
  traits.rate_hz = options.rate_hz;
  traits.sensor_period_s = options.sensor_period_s;
  traits.has_torque = options.has_torque;
  if (!options.has_torque) return traits;
  traits.name = "simulated hand with torque";
  traits.max_torque_Nm = options.max_torque_Nm;
  traits.inertia_kg_m2 = options.device_inertia_kg_m2;
  traits.rotational_damping_Nm_s = options.device_rotational_damping_Nm_s;
  return traits;
}

Vec3 column(const Rotation& r, std::size_t k) { return {r[k], r[3 + k], r[6 + k]}; }

/// Rotates by a small rotation vector in the outer frame and orthonormalises the result.
Rotation turned(const Rotation& rotation, Vec3 by_rad) {
  const auto moved = [&](std::size_t k) {
    const Vec3 c = column(rotation, k);
    return c + cross(by_rad, c) + 0.5 * cross(by_rad, cross(by_rad, c));
  };
  const Vec3 x = unit(moved(0));
  const Vec3 z = unit(cross(x, moved(1)));
  const Vec3 y = cross(z, x);
  return {x.x, y.x, z.x, x.y, y.y, z.y, x.z, y.z, z.z};
}

double rounded(double value, double step) { return step > 0.0 ? step * std::round(value / step) : value; }

}  // namespace

SimulatedHand::SimulatedHand(const HandOptions& options, std::unique_ptr<MotorFile> motors)
    : options_(options), motors_(std::move(motors)), traits_(traits_of(options)), script_(options.script) {
  PALPABLE_CHECK(options.device_mass_kg + options.arm_mass_kg > 0.0 && options.rate_hz > 0.0);
  PALPABLE_CHECK(options.delay_samples >= 0 && options.delay_samples <= kMostDelay);
  goal_m_ = script_.step({}, {}, 0.0);
  position_m_ = sensed_m_ = goal_m_;
}

void SimulatedHand::place(Vec3 position_m) noexcept {
  position_m_ = sensed_m_ = position_m;
  velocity_m_per_s_ = {};
  goal_m_ = position_m;
  script_.set_goal(position_m);
}

Reading SimulatedHand::read() noexcept {
  const double step = options_.resolution_m;
  Reading reading;
  reading.position.v = {rounded(sensed_m_.x, step), rounded(sensed_m_.y, step), rounded(sensed_m_.z, step)};
  reading.is_repeated = is_repeated_;
  reading.rotation = rotation_;
  reading.buttons = pressed();
  return reading;
}

std::uint32_t SimulatedHand::pressed() const noexcept {
  if (options_.button == 0 || passed_s_ < options_.press_at_s) return 0;
  const double since_s = passed_s_ - options_.press_at_s;
  const double every_s = options_.press_every_s;
  const double in_round_s = every_s > 0.0 ? std::fmod(since_s, every_s) : since_s;
  return in_round_s < options_.press_for_s ? 1U << static_cast<unsigned>(options_.button - 1) : 0;
}

void SimulatedHand::write(Vector<DeviceFrame> force_N) noexcept {
  if (cut_.exchange(false, std::memory_order_acq_rel)) stop();
  const auto size = static_cast<std::size_t>(options_.delay_samples) + 1;
  on_the_way_N_[(delayed_ + size - 1) % size] = force_N.v;
  on_the_way_Nm_[(delayed_ + size - 1) % size] = std::exchange(torque_Nm_, {});
  const Vec3 motor_N = on_the_way_N_[delayed_ % size];
  const Vec3 motor_Nm = on_the_way_Nm_[delayed_ % size];
  delayed_ = (delayed_ + 1) % size;
  if (motors_) motors_->write(motor_N);

  const double period_s = 1.0 / options_.rate_hz;
  passed_s_ += period_s;
  const Vec3 goal_before = goal_m_;
  goal_m_ = script_.step(position_m_, motor_N, period_s);
  const Vec3 goal_velocity = (goal_m_ - goal_before) / period_s;
  for (int i = 1; options_.has_torque && i <= kSteps; ++i) turn(motor_Nm, period_s / kSteps);
  is_repeated_ = true;
  for (int i = 1; i <= kSteps; ++i) {
    move(motor_N, goal_before + (static_cast<double>(i) / kSteps) * (goal_m_ - goal_before), goal_velocity,
         period_s / kSteps);
    sense(period_s / kSteps);
  }
}

void SimulatedHand::sense(double dt_s) noexcept {
  constexpr double kRounding_s = 1e-9;
  unsensed_s_ += dt_s;
  if (unsensed_s_ < options_.sensor_period_s - kRounding_s) return;
  unsensed_s_ = std::fmod(unsensed_s_ - options_.sensor_period_s, dt_s);
  sensed_m_ = position_m_;
  is_repeated_ = false;
}

void SimulatedHand::turn(Vec3 motor_Nm, double dt_s) noexcept {
  turning_s_ += dt_s;
  const double inertia = options_.device_inertia_kg_m2 + options_.hand_inertia_kg_m2;
  const double damping = options_.device_rotational_damping_Nm_s + options_.hand_rotational_damping_Nm_s;
  // The handle's axis is pulled towards the hand's tilt, and its rotation about that axis towards zero.
  const double phase = 2.0 * std::numbers::pi * options_.tilt_hz * turning_s_;
  const Vec3 upright{std::sin(options_.tilt_rad * std::sin(phase)), 0.0,
                     std::cos(options_.tilt_rad * std::sin(phase))};
  const Vec3 off = cross(column(rotation_, 2), upright) + cross(column(rotation_, 1), Vec3{0.0, 1.0, 0.0});
  const Vec3 push_Nm = motor_Nm + options_.hand_rotational_stiffness_Nm * off;
  angular_velocity_rad_per_s_ =
      (angular_velocity_rad_per_s_ + (dt_s / inertia) * push_Nm) / (1.0 + dt_s * damping / inertia);
  rotation_ = turned(rotation_, dt_s * angular_velocity_rad_per_s_);
}

void SimulatedHand::move(Vec3 motor_N, Vec3 goal_m, Vec3 goal_velocity_m_per_s, double dt_s) noexcept {
  const double mass = options_.device_mass_kg + options_.arm_mass_kg;
  const double damping = options_.device_damping_Ns_per_m + options_.arm_damping_Ns_per_m;
  const Vec3 push_N = motor_N + options_.arm_stiffness_N_per_m * (goal_m - position_m_) +
                      options_.arm_damping_Ns_per_m * goal_velocity_m_per_s;
  Vec3 velocity = (velocity_m_per_s_ + (dt_s / mass) * push_N) / (1.0 + dt_s * damping / mass);
  // Coulomb friction reduces the speed, at most to zero.
  const double speed = norm(velocity);
  const double lost = options_.device_friction_N * dt_s / mass;
  velocity = speed > lost ? (1.0 - lost / speed) * velocity : Vec3{};
  if (options_.degrees_of_freedom < 3) velocity.z = 0.0;
  velocity_m_per_s_ = velocity;
  position_m_ += dt_s * velocity;
}

void SimulatedHand::stop() noexcept {
  on_the_way_N_.fill({});
  on_the_way_Nm_.fill({});
  if (motors_) motors_->write({});
}

void SimulatedHand::cut_force() noexcept {
  cut_.store(true, std::memory_order_release);
  if (motors_) motors_->write({});
}

std::optional<ZeroWrite> SimulatedHand::zero_write() const {
  return motors_ ? std::optional(motors_->zero_write()) : std::nullopt;
}

Result<std::unique_ptr<Device>> open_simulated_hand(DeviceUrl& url, const OpenOptions& options) {
  if (!url.path().empty())
    return Error{ErrorCode::usage, "the simulated hand has no name: its options follow '?'", "sim"};
  HandOptions hand;
  hand.device_mass_kg = url.take_number("mass", hand.device_mass_kg, 0.01, 5.0);
  hand.device_damping_Ns_per_m = url.take_number("damping", hand.device_damping_Ns_per_m, 0.0, 100.0);
  hand.device_friction_N = url.take_number("friction", hand.device_friction_N, 0.0, 5.0);
  hand.arm_mass_kg = url.take_number("arm-mass", hand.arm_mass_kg, 0.0, 5.0);
  hand.arm_damping_Ns_per_m = url.take_number("arm-damping", hand.arm_damping_Ns_per_m, 0.0, 200.0);
  hand.arm_stiffness_N_per_m = url.take_number("arm-stiffness", hand.arm_stiffness_N_per_m, 0.0, 5000.0);
  hand.resolution_m = 1e-6 * url.take_number("resolution-um", 1e6 * hand.resolution_m, 0.0, 1000.0);
  hand.delay_samples = url.take_count("delay", 0, 0, SimulatedHand::kMostDelay);
  hand.sensor_period_s = 1e-3 * url.take_number("sensor-ms", 0.0, 0.0, 100.0);
  hand.max_force_N = url.take_number("max-force", hand.max_force_N, 0.1, 40.0);
  hand.continuous_force_N = take_continuous_force(url);
  hand.degrees_of_freedom = url.take_word("dof", {"3", "2"}) == "2" ? 2 : 3;
  hand.has_torque = url.take_number("torque", 0.0, 0.0, 1.0) > 0.0;
  hand.max_torque_Nm = url.take_number("max-torque", hand.max_torque_Nm, 0.001, 5.0);
  hand.tilt_rad = url.take_number("tilt", hand.tilt_rad, 0.0, 1.0);
  hand.button = url.take_count("button", 0, 0, 32);
  hand.press_at_s = url.take_number("button-at", hand.press_at_s, 0.0, 1e6);
  hand.press_for_s = url.take_number("button-for", hand.press_for_s, 0.0, 1e6);
  hand.press_every_s = url.take_number("button-every", hand.press_every_s, 0.0, 1e6);
  hand.rate_hz = options.rate_hz;
  HandScriptOptions& motion = hand.script;
  motion.speed_m_per_s = 1e-3 * url.take_number("speed-mm", 1e3 * motion.speed_m_per_s, 1.0, 500.0);
  motion.press_N = url.take_number("press", motion.press_N, 0.0, 10.0);
  motion.seed = static_cast<std::uint64_t>(
      url.take_number("seed", static_cast<double>(options.seed & 0xFFFFFFFFU), 0.0, 4294967295.0));
  motion.deep = hand.degrees_of_freedom == 3;
  const std::string script = url.take_word("script", {"scan", "random", "hold"});
  motion.kind = script == "scan"     ? HandScriptOptions::Kind::scan
                : script == "random" ? HandScriptOptions::Kind::random
                                     : HandScriptOptions::Kind::hold;
  if (options.strokes) motion.strokes = options.strokes(traits_of(hand));
  const std::string motor_path = url.take_text("motors");
  if (auto valid = url.finish(); !valid) return std::move(valid).error();
  std::unique_ptr<MotorFile> motors;
  if (!motor_path.empty()) {
    auto created = MotorFile::create(motor_path);
    if (!created) return std::move(created).error();
    motors = *std::move(created);
  }
  return std::unique_ptr<Device>(std::make_unique<SimulatedHand>(hand, std::move(motors)));
}

}  // namespace palpable::device
