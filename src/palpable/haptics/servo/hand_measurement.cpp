// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/haptics/servo/hand_measurement.hpp"

#include "palpable/core/numbers/quantile.hpp"
#include "palpable/haptics/servo/servo_loop.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <numbers>
#include <thread>
#include <utility>
#include <vector>

namespace palpable::haptics {
namespace {

constexpr std::size_t kUnknowns = 5;
using Row = std::array<double, kUnknowns>;
constexpr std::array kAxes{&Vec3::x, &Vec3::y, &Vec3::z};

/// Normal equations of a linear least-squares problem, solved by Gaussian elimination with pivoting.
struct NormalEquations {
  std::array<Row, kUnknowns> matrix{};
  Row right{};

  void add(const Row& row, double value) {
    for (std::size_t i = 0; i < kUnknowns; ++i) {
      right[i] += row[i] * value;
      for (std::size_t j = 0; j < kUnknowns; ++j) matrix[i][j] += row[i] * row[j];
    }
  }
  std::optional<Row> solve() {
    Row scale{};
    for (std::size_t i = 0; i < kUnknowns; ++i) {
      if (!(matrix[i][i] > 0.0)) return std::nullopt;
      scale[i] = 1.0 / std::sqrt(matrix[i][i]);
    }
    for (std::size_t i = 0; i < kUnknowns; ++i) {
      right[i] *= scale[i];
      for (std::size_t j = 0; j < kUnknowns; ++j) matrix[i][j] *= scale[i] * scale[j];
    }
    for (std::size_t k = 0; k < kUnknowns; ++k) {
      std::size_t pivot = k;
      for (std::size_t i = k + 1; i < kUnknowns; ++i)
        if (std::abs(matrix[i][k]) > std::abs(matrix[pivot][k])) pivot = i;
      constexpr double kSingular = 1e-12;
      if (!(std::abs(matrix[pivot][k]) > kSingular)) return std::nullopt;
      std::swap(matrix[k], matrix[pivot]);
      std::swap(right[k], right[pivot]);
      for (std::size_t i = k + 1; i < kUnknowns; ++i) {
        const double share = matrix[i][k] / matrix[k][k];
        for (std::size_t j = k; j < kUnknowns; ++j) matrix[i][j] -= share * matrix[k][j];
        right[i] -= share * right[k];
      }
    }
    Row solution{};
    for (std::size_t k = kUnknowns; k-- > 0;) {
      double value = right[k];
      for (std::size_t j = k + 1; j < kUnknowns; ++j) value -= matrix[k][j] * solution[j];
      solution[k] = value / matrix[k][k];
    }
    for (std::size_t i = 0; i < kUnknowns; ++i) solution[i] *= scale[i];
    return solution;
  }
};

/// The pulse at a time since the start of the touch: its axis and sign.
struct Pulse {
  std::size_t axis = 0;
  double sign = 1.0;
};
Pulse pulse_of(int number) {
  return {static_cast<std::size_t>(number) % kAxes.size(),
          (static_cast<std::size_t>(number) / kAxes.size()) % 2 == 0 ? 1.0 : -1.0};
}

class Pulses final : public Touchable {
 public:
  struct State {
    double t_s = 0.0;
  };
  explicit Pulses(const PulseOptions& options) : options_(options) {}

  LawOutput evaluate(const Hand& hand, TouchState& state) const noexcept override {
    double& t_s = state_as<State>(state).t_s;
    LawOutput output;
    const double since_s = t_s - options_.settling_s;
    t_s += hand.dt_s;
    const int number = static_cast<int>(std::floor(since_s / options_.every_s));
    if (number < 0 || number >= options_.pulses) return output;
    const double within_s = since_s - options_.every_s * number;
    if (within_s >= options_.pulse_s) return output;
    const Pulse pulse = pulse_of(number);
    output.force_N.v.*kAxes[pulse.axis] =
        pulse.sign * options_.pulse_N * std::sin(std::numbers::pi * within_s / options_.pulse_s);
    return output;
  }
  std::uint64_t state_family() const noexcept override { return 0; }
  EnergyModel energy_model() const noexcept override { return EnergyModel::self_limited; }
  double damping_Ns_per_m() const noexcept override { return 0.0; }
  void touch_pages() const noexcept override {}

 private:
  PulseOptions options_;
};

double known_trait(double value) { return std::isfinite(value) ? value : 0.0; }

/// The samples of one pulse on its axis, with the total force that acted.
std::vector<PushedSample> pushed_samples(std::span<const TouchSample> samples, std::size_t begin,
                                         std::size_t end, std::size_t axis, const device::Traits& device) {
  // Below this speed, the sign of a sensor step is not reliably that of the hand's velocity.
  constexpr double kMoves_m_per_s = 0.002;
  const double friction_N = known_trait(device.coulomb_friction_N);
  const auto delay = static_cast<std::size_t>(std::max(device.delay_samples, 0));
  std::vector<PushedSample> pushed;
  for (std::size_t n = begin; n + 1 < end; ++n) {
    const double velocity = samples[n].velocity_m_per_s.v.*kAxes[axis];
    double force_N = n >= delay ? samples[n - delay].written_force_N.v.*kAxes[axis] : 0.0;
    if (std::abs(velocity) > kMoves_m_per_s) force_N -= std::copysign(friction_N, velocity);
    pushed.push_back({samples[n].position.v.*kAxes[axis], force_N, samples[n + 1].dt_s});
  }
  return pushed;
}

}  // namespace

std::optional<Impedance> fit_impedance(std::span<const PushedSample> samples) {
  constexpr std::size_t kFewest = 20;
  if (samples.size() < kFewest) return std::nullopt;
  NormalEquations equations;
  double t_s = 0.0;
  // Position and force, integrated once and twice.
  double position_1 = 0.0, position_2 = 0.0, force_1 = 0.0, force_2 = 0.0;
  const double origin_m = samples.front().position_m;
  for (std::size_t n = 0; n + 1 < samples.size(); ++n) {
    const double dt_s = samples[n].dt_s;
    const double before_m = samples[n].position_m - origin_m;
    const double now_m = samples[n + 1].position_m - origin_m;
    const double grown_1 = 0.5 * dt_s * (before_m + now_m);
    position_2 += dt_s * (position_1 + 0.5 * grown_1);
    position_1 += grown_1;
    force_2 += dt_s * (force_1 + 0.5 * dt_s * samples[n].force_N);
    force_1 += dt_s * samples[n].force_N;
    t_s += dt_s;
    equations.add({now_m, position_1, position_2, t_s, 0.5 * t_s * t_s}, force_2);
  }
  const auto solution = equations.solve();
  if (!solution) return std::nullopt;
  const Impedance impedance{(*solution)[0], (*solution)[1], (*solution)[2]};
  if (!(impedance.mass_kg > 0.0 && impedance.damping_Ns_per_m > 0.0)) return std::nullopt;
  return impedance;
}

std::shared_ptr<const Touchable> make_pulses(const PulseOptions& options, const device::Traits& device) {
  PulseOptions gentle = options;
  gentle.pulse_N = std::min(gentle.pulse_N, device.max_force_N / 3.0);
  return std::make_shared<const Pulses>(gentle);
}

Result<MeasuredHand> hand_of(std::span<const TouchSample> samples, const device::Traits& device,
                             const PulseOptions& options) {
  std::vector<double> masses, dampings, stiffnesses;
  std::size_t begin = 0;
  for (int number = 0; number < options.pulses; ++number) {
    const double from_s = options.settling_s + options.every_s * number;
    while (begin < samples.size() && samples[begin].t_s < from_s) ++begin;
    std::size_t end = begin;
    while (end < samples.size() && samples[end].t_s < from_s + options.fitted_s) ++end;
    const Pulse pulse = pulse_of(number);
    if (pulse.axis + 1 > static_cast<std::size_t>(device.degrees_of_freedom)) continue;
    const auto fitted = fit_impedance(pushed_samples(samples, begin, end, pulse.axis, device));
    if (!fitted) continue;
    masses.push_back(fitted->mass_kg);
    dampings.push_back(fitted->damping_Ns_per_m);
    stiffnesses.push_back(fitted->stiffness_N_per_m);
  }
  if (dampings.empty())
    return Error{
        ErrorCode::failed, "no damping can be determined from the hand's response to the pulses", {}};
  MeasuredHand hand;
  hand.pulses = static_cast<int>(dampings.size());
  hand.together = {quantile_of(masses, 0.5), quantile_of(dampings, 0.5), quantile_of(stiffnesses, 0.5)};
  const double own = known_trait(device.damping_Ns_per_m);
  const auto [least, greatest] = std::minmax_element(dampings.begin(), dampings.end());
  hand.least_damping_Ns_per_m = *least - own;
  hand.median_damping_Ns_per_m = hand.together.damping_Ns_per_m - own;
  hand.greatest_damping_Ns_per_m = *greatest - own;
  return hand;
}

Result<MeasuredHand> measure_hand(std::unique_ptr<device::Device> device, const PulseOptions& options) {
  const device::Traits traits = device->traits();
  if (!traits.pushes_back)
    return Error{ErrorCode::usage, "the device has no motors, so the hand's damping does not matter",
                 traits.name};
  ServoOptions servo;
  servo.recording = Recording::on;
  auto loop = ServoLoop::start(std::move(device), {make_pulses(options, traits), {}, 1}, servo);
  if (!loop) return std::move(loop).error();
  std::vector<TouchSample> samples;
  while (samples.empty() || samples.back().t_s < options.duration_s()) {
    if (std::string fault = (*loop)->device_fault(); !fault.empty())
      return Error{ErrorCode::device, std::move(fault), traits.name};
    constexpr auto kPoll = std::chrono::milliseconds(20);
    std::this_thread::sleep_for(kPoll);
    while (const auto sample = (*loop)->take_recorded()) samples.push_back(*sample);
  }
  (*loop)->stop();
  return hand_of(samples, traits, options);
}

}  // namespace palpable::haptics
