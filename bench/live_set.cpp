// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// Live surfaces under hands, in simulated time: palpable_live_set [HANDS [FIRST [all|resting|swings]]]. Under
// resting hands a still scene with a depth camera's noise, and a plate that comes at 0.1 m/s in the room,
// stays, and goes away; under hands that rest, push and swing a plate that swings, in touches that begin in
// the air and in contact. In the usual size of a relief, and in its true size. A line for each, with the
// figures of all hands.
#include "palpable/core/numbers/quantile.hpp"
#include "palpable/core/text/number_text.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <optional>
#include <string_view>
#include <vector>

#include "live_swings.hpp"
#include "live_touch.hpp"
#include <fmt/format.h>

namespace palpable::bench {
namespace {

constexpr double kPlate_m_per_s = 0.1;

/// What happened to one hand.
struct Outcome {
  /// Greatest changes of the force in a tick, and from the end of one frame to that of the next, N.
  double tick_N = 0.0, update_N = 0.0;
  double mean_N = 0.0;
  /// Ticks in which the hand was more than 1.2 mm below the newest surface without contact.
  int through = 0;
  /// Greatest difference from the spring on the plate as the pictures show it, of it: from two pictures after
  /// the hand was lifted as slowly as it may, and before.
  double error = 0.0, limited_error = 0.0;
  double made_J = 0.0;
};

/// A slope with a box on it, and a hand that rests on it for 4 s with 0.5 to 2 N.
Outcome still_scene(std::uint64_t seed) {
  Hands hands(seed);
  const Scale scale = usual_scale();
  const auto depth = [](int u, int v) { return 0.9 - 0.004 * v - (u > 12 && u < 25 && v > 10 ? 0.1 : 0.0); };
  const auto frame = [&] { return hands.frame(depth); };
  const device::HandOptions hand = hands.hand();
  LiveTouch touch(scale, hand, frame());
  const double x_m = hands.between(-0.04, 0.04), y_m = hands.between(-0.03, 0.03);
  const double force_N = hands.between(0.5, 2.0);
  const double below_m = force_N * (1.0 / touch.stiffness_N_per_m() + 1.0 / hand.arm_stiffness_N_per_m);
  const double goal_m = touch.height_m(x_m, y_m) + 0.001 - below_m;
  Outcome out;
  Vec3 before_N, at_frame_N;
  std::optional<Raster<float>> taken;
  constexpr int kSettle = 1500, kEnd = 5500;
  for (int n = 0; n < kEnd; ++n) {
    if (n % kFramePeriod == 0) taken = frame();
    const auto& sample = touch.step({x_m, y_m, std::max(goal_m, 0.02 - 0.00005 * n)});
    if (taken && n % kFramePeriod == kDelay) touch.hand_over(*taken);
    const Vec3 force = sample.written_force_N.v;
    if (n > kSettle) {
      out.tick_N = std::max(out.tick_N, norm(force - before_N));
      out.mean_N += norm(force) / (kEnd - kSettle - 1);
    }
    before_N = force;
    if (n % kFramePeriod != kDelay) continue;
    if (n > kSettle + kFramePeriod) out.update_N = std::max(out.update_N, norm(force - at_frame_N));
    at_frame_N = force;
  }
  out.made_J = touch.counts().made_max_without_controller_J;
  return out;
}

/// A level plate that comes from below the hand, stays for 0.7 s, and goes away.
Outcome plate(std::uint64_t seed, const Scale& scale) {
  Hands hands(seed);
  const device::HandOptions hand = hands.hand();
  const double x_m = hands.between(-0.04, 0.04), y_m = hands.between(-0.03, 0.03);
  const double rest_m = hands.between(0.3, 0.4) * scale.relief.size_m.z;
  const double speed = kPlate_m_per_s * scale.per_m();
  const double into_m = hands.between(0.003, 0.008);
  const double low_m = rest_m - kRadius_m - 0.003, high_m = rest_m - kRadius_m + into_m;
  const double phase_s = hands.between(0.0, 0.033), up_s = (high_m - low_m) / speed;
  constexpr double kBegin_s = 0.5, kStay_s = 0.7, kAfter_s = 0.5;
  const auto height_at = [&](double t_s) {
    const double rise_s = t_s - kBegin_s - phase_s;
    const double fall_s = rise_s - up_s - kStay_s;
    return std::clamp(low_m + speed * std::min(rise_s, up_s) - speed * std::max(fall_s, 0.0), low_m, high_m);
  };
  const auto frame_at = [&](double t_s) {
    const double z = scale.depth_m(height_at(t_s));
    return hands.frame([&](int, int) { return z; });
  };
  LiveTouch touch(scale, hand, frame_at(0.0));
  touch.place({x_m, y_m, rest_m});
  const double k = touch.stiffness_N_per_m();
  // As the pictures show it: straight from each to the next, which is reached when its fade ends.
  const auto seen_at = [&](int n) {
    const int age = (n + kFramePeriod - kDelay) % kFramePeriod, newest = n - kDelay - age;
    const double part = std::min(1.0, age / kFade);
    return std::lerp(height_at(0.001 * (newest - kFramePeriod)), height_at(0.001 * newest), part);
  };
  constexpr double kLeast_N = 0.3, kThrough_m = 0.0012;
  Outcome out;
  Vec3 before_N;
  double due_m = 0.0;
  int limited = -2 * kFramePeriod;
  std::optional<Raster<float>> taken;
  const int end = static_cast<int>(1000.0 * (kBegin_s + 2.0 * up_s + kStay_s + kAfter_s));
  for (int n = 0; n < end; ++n) {
    const double t_s = 0.001 * n;
    if (n % kFramePeriod == 0) taken = frame_at(t_s);
    const auto& sample = touch.step({x_m, y_m, rest_m});
    if (taken && n % kFramePeriod == kDelay) touch.hand_over(*taken);
    const Vec3 force = sample.written_force_N.v;
    out.tick_N = std::max(out.tick_N, norm(force - before_N));
    before_N = force;
    const double deep_m = touch.height_m(x_m, y_m) + kRadius_m - sample.position.v.z;
    out.through += deep_m > kThrough_m && !sample.has(haptics::flag::kContact) ? 1 : 0;
    // It comes to the hand as it is seen, and lifts it by 30 mm/s at most.
    const double hand_m = sample.position.v.z, seen_m = seen_at(n) + kRadius_m;
    due_m = std::min(seen_m, std::max(due_m + 0.001 * haptics::kLift_m_per_s, hand_m));
    if (due_m < seen_m) limited = n;
    const double due_N = k * (due_m - hand_m);
    if (due_N < kLeast_N) continue;
    double& error = n - limited > 2 * kFramePeriod ? out.error : out.limited_error;
    error = std::max(error, std::abs(force.z - due_N) / due_N);
  }
  out.mean_N = before_N.z;
  out.made_J = touch.counts().made_max_without_controller_J;
  return out;
}

template <class Of, class Value>
void print(const char* what, const std::vector<Of>& all, const Value& value, double factor) {
  std::vector<double> values;
  for (const Of& out : all) values.push_back(factor * static_cast<double>(value(out)));
  const double middle = quantile_of(values, 0.5), late = quantile_of(values, 0.99);
  fmt::print(" | {} {:.3f} {:.3f} {:.3f}", what, middle, late, quantile_of(values, 1.0));
}

/// The outcomes of so many hands.
template <class Run>
auto all_of(const char* name, std::uint64_t first, int count, const Run& run) {
  std::vector<decltype(run(first))> all;
  for (int k = 0; k < count; ++k) all.push_back(run(first + static_cast<std::uint64_t>(k)));
  fmt::print("{} ({} hands; median, 99 %, greatest)", name, count);
  return all;
}

void print_swings(const char* name, std::uint64_t first, int count, SwingSize size, SwingBegins begins) {
  const auto all = all_of(name, first, count, [&](std::uint64_t seed) { return swing(seed, size, begins); });
  const auto figure = [&](const char* what, auto Swung::*value, double factor) {
    print(
        what, all, [&](const Swung& s) { return s.*value; }, factor);
  };
  figure("change in a tick, N", &Swung::tick_N, 1.0);
  figure("beyond stiffness x movement, N", &Swung::step_N, 1.0);
  figure("received beyond what it brings, uJ", &Swung::beyond_J, 1e6);
  figure("made, without controller, uJ", &Swung::said_J, 1e6);
  figure("made, uJ", &Swung::said_with_J, 1e6);
  figure("brought, mJ", &Swung::brought_J, 1e3);
  figure("ticks through", &Swung::through, 1.0);
  figure("ticks in contact", &Swung::in_contact, 1.0);
  const auto over = [&](double Swung::*value, double most) {
    return std::count_if(all.begin(), all.end(), [&](const Swung& s) { return s.*value > most; });
  };
  fmt::print(" | steps over 0.05 N: {}, over 1 uJ beyond: {}, said: {}\n", over(&Swung::step_N, 0.05),
             over(&Swung::beyond_J, 1e-6), over(&Swung::said_J, 1e-6));
  std::fflush(stdout);
}

template <class Run>
void print_all(const char* name, std::uint64_t first, int count, const Run& run) {
  const std::vector<Outcome> all = all_of(name, first, count, run);
  print(
      "change in a tick, N", all, [](const Outcome& o) { return o.tick_N; }, 1.0);
  print(
      "change at an update, N", all, [](const Outcome& o) { return o.update_N; }, 1.0);
  print(
      "of the force, %", all, [](const Outcome& o) { return o.update_N / std::max(o.mean_N, 0.01); }, 100.0);
  print(
      "from theory, %", all, [](const Outcome& o) { return o.error; }, 100.0);
  print(
      "while it is lifted slowly, %", all, [](const Outcome& o) { return o.limited_error; }, 100.0);
  print(
      "ticks through", all, [](const Outcome& o) { return static_cast<double>(o.through); }, 1.0);
  print(
      "force at the end, N", all, [](const Outcome& o) { return o.mean_N; }, 1.0);
  print(
      "made, uJ", all, [](const Outcome& o) { return o.made_J; }, 1e6);
  const auto over = std::count_if(all.begin(), all.end(), [](const Outcome& o) {
    return o.update_N > 0.05 && o.update_N > 0.07 * o.mean_N;
  });
  const auto off = std::count_if(all.begin(), all.end(), [](const Outcome& o) { return o.error > 0.1; });
  fmt::print(" | updates over both limits: {}, over 10 % from theory: {}\n", over, off);
  std::fflush(stdout);
}

int run(int count, const char* const* words) {
  const auto hands = whole_number(count > 1 ? words[1] : "1000"),
             first = whole_number(count > 2 ? words[2] : "1");
  const std::string_view cases = count > 3 ? words[3] : "all";
  if (!hands || !first || *hands < 1 || *first < 0) {
    fmt::print(stderr, "palpable_live_set [HANDS [FIRST [all|resting|swings]]]\n");
    return 2;
  }
  const int most = static_cast<int>(*hands);
  const auto from = static_cast<std::uint64_t>(*first);
  if (cases != "swings") {
    print_all("still", from, std::min(most, 200), still_scene);
    print_all("plate", from, most, [](std::uint64_t seed) { return plate(seed, usual_scale()); });
    print_all("plate, true size", from, most, [](std::uint64_t seed) { return plate(seed, true_scale()); });
  }
  if (cases == "resting") return 0;
  using enum SwingSize;
  using enum SwingBegins;
  print_swings("swings, begins in the air", from, most, usual, in_air);
  print_swings("swings, begins in contact", from, most, usual, in_contact);
  print_swings("swings, true size, begins in the air", from, most, true_size, in_air);
  print_swings("swings, true size, begins in contact", from, most, true_size, in_contact);
  return 0;
}

}  // namespace
}  // namespace palpable::bench

int main(int count, char** words) { return palpable::bench::run(count, words); }
