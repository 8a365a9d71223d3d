// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

// Live frames of a depth camera under a simulated hand, in simulated time.

#include "palpable/haptics/tick/counted_hand.hpp"
#include "palpable/haptics/tick/tick.hpp"
#include "palpable/sculpt/relief/relief_in_window.hpp"
#include "palpable/session/touch/haptic_scene.hpp"
#include "palpable/session/touch/rising_surface.hpp"
#include "palpable/vision/depth_camera/clean_depth.hpp"
#include "palpable/vision/depth_camera/steady_depth.hpp"

#include <array>
#include <cstdint>
#include <list>
#include <memory>
#include <random>
#include <utility>

namespace palpable::bench {

inline constexpr int kFramePeriod = 33;  // ticks of 1 ms
inline constexpr double kFade = 30.0;
/// From when a frame is taken to when its surface is handed over, ticks.
inline constexpr int kDelay = 20;
/// Of the touching ball: that of the laws unless another is chosen.
inline constexpr double kRadius_m = 0.001;

/// How depths become the relief: what a metre of depth is in the scene.
struct Scale {
  vision::DepthRange range;
  sculpt::WindowedReliefOptions relief;

  double per_m() const { return relief.size_m.z / (range.far_m - range.near_m); }
  double height_m(double depth_m) const { return (range.far_m - depth_m) * per_m(); }
  double depth_m(double height_m) const { return range.far_m - height_m / per_m(); }
};

inline Scale usual_scale() { return {{0.5, 1.0}, {}}; }
inline Scale true_scale() {
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
  const haptics::TickCounts& counts() const { return tick_.counts(); }
  Vec3 true_position_m() const { return hand_.true_position_m(); }
  /// What the hand received by its true movements, J.
  double received_J() const { return hand_.total_J(); }
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

}  // namespace palpable::bench
