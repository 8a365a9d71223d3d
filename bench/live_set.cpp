// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// Live surfaces under resting hands, in simulated time: palpable_live_set [HANDS [FIRST]]. A still scene with
// a depth camera's noise, and a plate that comes at the hand at 0.1 m/s in the room, stays, and goes away: in
// the usual size of a relief, and in its true size. A line for each, with the figures of all hands.
#include "palpable/core/numbers/quantile.hpp"
#include "palpable/core/text/number_text.hpp"
#include "palpable/haptics/tick/counted_hand.hpp"
#include "palpable/haptics/tick/tick.hpp"
#include "palpable/sculpt/relief/relief_in_window.hpp"
#include "palpable/session/touch/haptic_scene.hpp"
#include "palpable/session/touch/rising_surface.hpp"
#include "palpable/vision/depth_camera/clean_depth.hpp"
#include "palpable/vision/depth_camera/steady_depth.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <list>
#include <memory>
#include <optional>
#include <random>
#include <utility>
#include <vector>

#include <fmt/format.h>

namespace palpable::bench {
namespace {

constexpr int kFramePeriod = 33;  // ticks of 1 ms
constexpr double kFade = 30.0;
/// From when a frame is taken to when its surface is handed over, ticks.
constexpr int kDelay = 20;
constexpr double kPlate_m_per_s = 0.1;
/// Of the touching ball: that of the laws unless another is chosen.
constexpr double kRadius_m = 0.001;

/// How depths become the relief: what a metre of depth is in the scene.
struct Scale {
  vision::DepthRange range;
  sculpt::WindowedReliefOptions relief;

  double per_m() const { return relief.size_m.z / (range.far_m - range.near_m); }
  double height_m(double depth_m) const { return (range.far_m - depth_m) * per_m(); }
  double depth_m(double height_m) const { return range.far_m - height_m / per_m(); }
};

Scale usual_scale() { return {{0.5, 1.0}, {}}; }
Scale true_scale() {
  Scale scale{{0.6, 0.7}, {}};
  scale.relief.size_m.z = 0.1;
  return scale;
}

/// A touch of live frames, as LiveFeed and the servo make it.
class LiveTouch {
 public:
  LiveTouch(const Scale& scale, const device::HandOptions& hand, const Raster<float>& first)
      : scale_(scale), hand_(hand), tick_(hand_, prepared(relief_of(first)), options(), events_) {}
  /// Before the first step().
  void place(Vec3 hand_m) { hand_.place(hand_m); }

  /// 1 ms; the surface that was handed over last comes as soon as no other fades in.
  const haptics::TouchSample& step(Vec3 goal_m) {
    hand_.set_goal(goal_m);
    if (coming_ && !tick_.fading()) {
      tick_.change(prepared(std::exchange(coming_, nullptr)));
      static_cast<void>(tick_.take_retired());
      // One is felt, one comes.
      while (scenes_.size() > 3) scenes_.pop_front();
    }
    sample_ = &tick_.step(0.001 * static_cast<double>(n_++), 0.001);
    while (events_.take()) {
    }
    return *sample_;
  }
  void hand_over(const Raster<float>& depth_m) {
    const std::array hands{sample_->position};
    coming_ = session::risen_surface(*shown_, relief_of(depth_m), hands, kRadius_m, 0.001 * kFramePeriod);
  }
  double made_J() const { return tick_.counts().made_max_without_controller_J; }
  double stiffness_N_per_m() const { return stiffness_N_per_m_; }
  /// Of the surface that came last.
  double height_m(double x_m, double y_m) const { return shown_->sample(x_m, y_m).z_m; }

 private:
  static haptics::TickOptions options() {
    haptics::TickOptions options;
    options.fade_s = 0.001 * kFade;
    return options;
  }
  std::shared_ptr<const models::Relief> relief_of(const Raster<float>& depth_m) {
    const vision::DepthNoise noise;
    const auto& steady = steady_.add(vision::clean_depth(depth_m, noise), 0.001 * kFramePeriod);
    return std::make_shared<const models::Relief>(
        *sculpt::relief_in_window(steady, scale_.range, scale_.relief));
  }
  const haptics::HapticScene& prepared(std::shared_ptr<const models::Relief> relief) {
    shown_ = relief;
    models::Scene scene;
    scene.model = std::move(relief);
    auto made = session::prepare_scene(scene, {}, hand_.traits(), 1000.0, {}, kept_);
    stiffness_N_per_m_ = made->materials.front().stiffness_N_per_m;
    made->scene.id = ++id_;
    made->scene.succession = haptics::Succession::moves;
    return scenes_.emplace_back(std::move(made->scene));
  }

  Scale scale_;
  vision::SteadyDepth steady_{{}};
  session::KeptSurfaces kept_;
  std::list<haptics::HapticScene> scenes_;
  std::uint32_t id_ = 0;
  double stiffness_N_per_m_ = 0.0;
  std::shared_ptr<const models::Relief> shown_, coming_;
  Ring<haptics::TouchEvent> events_{1024};
  haptics::CountedHand hand_;
  haptics::TickPipeline tick_;
  const haptics::TouchSample* sample_ = nullptr;
  std::int64_t n_ = 0;
};

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

class Hands {
 public:
  explicit Hands(std::uint64_t seed) : random_(seed) {}

  double between(double low, double high) {
    return low + (high - low) * static_cast<double>(random_() >> 11U) * 0x1p-53;
  }
  device::HandOptions hand() {
    device::HandOptions hand;
    hand.arm_stiffness_N_per_m = between(60.0, 300.0);
    hand.arm_mass_kg = between(0.2, 0.7);
    hand.max_force_N = 8.0;
    hand.script.kind = device::HandScriptOptions::Kind::hold;
    return hand;
  }
  /// A frame of 40 x 30 pixels with the camera's noise. `depth`: of a pixel, m.
  template <class Depth>
  Raster<float> frame(const Depth& depth) {
    Raster<float> depth_m(40, 30);
    for (int v = 0; v < 30; ++v)
      for (int u = 0; u < 40; ++u) {
        const auto z = static_cast<float>(depth(u, v));
        depth_m(u, v) = z + vision::DepthNoise{}.deviation_m(z) * static_cast<float>(normal_(random_));
      }
    return depth_m;
  }

 private:
  std::mt19937_64 random_;
  std::normal_distribution<double> normal_;
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
  out.made_J = touch.made_J();
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
  out.made_J = touch.made_J();
  return out;
}

template <class Value>
void print(const char* what, const std::vector<Outcome>& all, const Value& value, double factor) {
  std::vector<double> values;
  for (const Outcome& out : all) values.push_back(factor * value(out));
  const double middle = quantile_of(values, 0.5), late = quantile_of(values, 0.99);
  fmt::print(" | {} {:.3f} {:.3f} {:.3f}", what, middle, late, quantile_of(values, 1.0));
}

template <class Run>
void print_all(const char* name, std::uint64_t first, int count, const Run& run) {
  std::vector<Outcome> all;
  for (int k = 0; k < count; ++k) all.push_back(run(first + static_cast<std::uint64_t>(k)));
  fmt::print("{} ({} hands; median, 99 %, greatest)", name, count);
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
  if (!hands || !first || *hands < 1 || *first < 0) {
    fmt::print(stderr, "palpable_live_set [HANDS [FIRST]]\n");
    return 2;
  }
  const int most = static_cast<int>(*hands);
  const auto from = static_cast<std::uint64_t>(*first);
  print_all("still", from, std::min(most, 200), still_scene);
  print_all("plate", from, most, [](std::uint64_t seed) { return plate(seed, usual_scale()); });
  print_all("plate, true size", from, most, [](std::uint64_t seed) { return plate(seed, true_scale()); });
  return 0;
}

}  // namespace
}  // namespace palpable::bench

int main(int count, char** words) { return palpable::bench::run(count, words); }
