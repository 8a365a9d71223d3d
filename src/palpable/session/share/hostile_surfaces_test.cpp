// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// What a scene at another computer can make a device give to a hand, whatever surfaces it sends.
#include "palpable/device/remote/shared_device.hpp"
#include "palpable/device/simulated/simulated_hand.hpp"
#include "palpable/haptics/law/local_touch.hpp"
#include "palpable/haptics/safety/stability.hpp"
#include "palpable/haptics/servo/start_touch.hpp"
#include "palpable/haptics/tick/tick.hpp"
#include "palpable/models/scene/route_guide.hpp"
#include "palpable/session/share/shared_limits.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <iostream>
#include <memory>
#include <ostream>
#include <random>
#include <string>

#include <gtest/gtest.h>

namespace palpable::session {
namespace {

using device::HandAccount;
using device::LocalSurface;
using Kind = LocalSurface::Kind;

constexpr double kHostileTick_s = 0.001;

/// What a hostile scene knows of the hand.
struct SeenHand {
  Vec3 place_m;
  Vec3 moved_m;
  int tick = 0;
};

/// A simulated hand at a shared device, and another computer that sends a surface in each tick.
class HostileBench {
 public:
  HostileBench() {
    device::HandOptions options;
    options.script.kind = device::HandScriptOptions::Kind::hold;
    auto hand = std::make_unique<device::SimulatedHand>(options);
    traits_ = hand->traits();
    exchange_->connected = true;
    shared_ =
        std::make_unique<device::SharedDevice>(std::move(hand), exchange_, current_, [this] { return t_s_; });
    for (const Kind kind : {Kind::plane, Kind::slope, Kind::force}) {
      haptics::HapticScene& scene = scenes_[static_cast<std::size_t>(kind)];
      scene.touchable = std::make_shared<const haptics::LocalTouch>(kind, current_);
      scene.id = static_cast<std::uint32_t>(kind);
    }
    tick_ = std::make_unique<haptics::TickPipeline>(*shared_, scenes_[static_cast<std::size_t>(Kind::plane)],
                                                    haptics::tick_options(shared_servo({})), events_);
  }

  /// The most that the hand had got from all forces since the beginning, J.
  double most_given_J(double seconds, const std::function<LocalSurface(const SeenHand&)>& sends) {
    double work_J = 0.0, most_J = 0.0;
    Vec3 held_N, before_m;
    SeenHand seen;
    for (; t_s_ < seconds; ++seen.tick) {
      t_s_ += kHostileTick_s;
      const haptics::TouchSample& sample = tick_->step(t_s_, kHostileTick_s);
      while (events_.take()) {
      }
      const Vec3 place_m = sample.device_position.v;
      seen.moved_m = seen.tick > 0 ? place_m - before_m : Vec3{};
      seen.place_m = before_m = place_m;
      work_J += dot(held_N, seen.moved_m);
      most_J = std::max(most_J, work_J);
      held_N = sample.written_force_N.v;
      send(sends(seen));
    }
    return most_J;
  }

 private:
  void send(LocalSurface surface) {
    surface.read_at_s = t_s_;
    if (!device::is_valid(surface)) return;
    const LocalSurface limited =
        limited_surface(surface, traits_, 1.0 / kHostileTick_s, haptics::kLeastHandDamping_Ns_per_m);
    exchange_->surfaces.put(limited);
    if (limited.kind <= Kind::free || limited.kind == rendered_ || tick_->fading()) return;
    rendered_ = limited.kind;
    tick_->change(scenes_[static_cast<std::size_t>(rendered_)]);
  }

  double t_s_ = 0.0;
  Kind rendered_ = Kind::plane;
  device::Traits traits_;
  std::shared_ptr<device::SharedExchange> exchange_ = std::make_shared<device::SharedExchange>();
  std::shared_ptr<device::CurrentSurface> current_ = std::make_shared<device::CurrentSurface>();
  std::unique_ptr<device::SharedDevice> shared_;
  haptics::HapticScene scenes_[5];
  Ring<haptics::TouchEvent> events_{1024};
  std::unique_ptr<haptics::TickPipeline> tick_;
};

/// A level plane, so far above the hand.
LocalSurface plane_above(const SeenHand& hand, double depth_m) {
  LocalSurface surface;
  surface.kind = Kind::plane;
  surface.hand.v = hand.place_m;
  surface.place.v = hand.place_m + Vec3{0.0, 0.0, depth_m};
  surface.normal.v = {0.0, 0.0, 1.0};
  surface.stiffness_N_per_m = 300.0;
  return surface;
}

/// Along the hand's movement.
Vec3 onward_N(const SeenHand& hand, double size_N) {
  const double moved_m = norm(hand.moved_m);
  return moved_m > 0.0 ? (size_N / moved_m) * hand.moved_m : Vec3{size_N, 0.0, 0.0};
}

LocalSurface pulls(const SeenHand& hand, double reserve_J) {
  LocalSurface surface = plane_above(hand, 0.002);
  surface.pull_N.v = onward_N(hand, models::kMaxGuideForce_N);
  surface.pull_reserve_J = reserve_J;
  return surface;
}

/// To and fro, with two reserves in turn.
LocalSurface alternates_reserves(const SeenHand& hand) {
  constexpr int kSlowly = 400;
  const bool is_first = hand.tick % (2 * kSlowly) < kSlowly;
  LocalSurface surface = pulls(hand, is_first ? 0.01 : 0.02);
  surface.pull_N.v = {is_first ? models::kMaxGuideForce_N : -models::kMaxGuideForce_N, 0.0, 0.0};
  return surface;
}

LocalSurface begins_pulls_again(const SeenHand& hand) {
  return hand.tick % 400 < 300 ? pulls(hand, 0.05) : LocalSurface{};
}

LocalSurface pushes_by_slopes(const SeenHand& hand) {
  LocalSurface surface;
  surface.kind = Kind::slope;
  surface.hand.v = hand.place_m;
  surface.force_N.v = onward_N(hand, 3.0);
  // As if that were still to be given back.
  surface.stored_J = 1e5 - hand.tick;
  return surface;
}

LocalSurface pushes_by_forces(const SeenHand& hand) {
  LocalSurface surface = pushes_by_slopes(hand);
  surface.kind = hand.tick % 50 < 2 ? Kind::free : Kind::force;
  return surface;
}

LocalSurface brings_planes_up(const SeenHand& hand) {
  return hand.tick % 300 < 150 ? plane_above(hand, 0.02) : LocalSurface{};
}

LocalSurface sends_anything(const SeenHand& hand) {
  static std::mt19937 random(1);
  const auto from = [](double least, double most) {
    return std::uniform_real_distribution<double>(least, most)(random);
  };
  static LocalSurface surface;
  if (random() % 20 == 0) {
    surface = plane_above(hand, from(-0.01, 0.02));
    surface.kind = static_cast<Kind>(random() % 5);
    surface.stiffness_N_per_m = std::pow(10.0, from(-2.0, 6.0));
    surface.damping_Ns_per_m = random() % 2 == 0 ? 0.0 : std::pow(10.0, from(-2.0, 6.0));
    surface.static_friction = surface.dynamic_friction = from(0.0, 3.0);
    surface.stored_J = from(-1e6, 1e6);
    surface.pull_reserve_J = std::pow(10.0, from(-3.0, 6.0));
    surface.transient = {from(0.0, 10.0), from(50.0, 200.0), from(20.0, 100.0)};
    if (random() % 5 == 0) surface.force_N.v.x = std::nan("");
  }
  surface.force_N.v = onward_N(hand, 1e3);
  surface.pull_N.v = onward_N(hand, 1e3);
  return surface;
}

struct Hostile {
  const char* name;
  LocalSurface (*sends)(const SeenHand&);
  /// Pulls end where the reserve does, and slopes before.
  double most_J;
};

void PrintTo(const Hostile& hostile, std::ostream* out) { *out << hostile.name; }

class HostileSurfaces : public testing::TestWithParam<Hostile> {};

TEST_P(HostileSurfaces, GiveAHandNoMoreThanOneAccount) {
  constexpr double kHostile_s = 20.0;
  HostileBench bench;
  const double given_J = bench.most_given_J(kHostile_s, GetParam().sends);
  EXPECT_LE(given_J, GetParam().most_J);
  std::cout << GetParam().name << ": " << 1e3 * given_J << " mJ\n";
}

constexpr double kAll_J = HandAccount::kReserve_J + HandAccount::kPlanes_J + 1e-3;
constexpr double kPulled_J = HandAccount::kReserve_J + 1e-3;

INSTANTIATE_TEST_SUITE_P(Scenes, HostileSurfaces,
                         testing::Values(Hostile{"alternates_reserves", alternates_reserves, kPulled_J},
                                         Hostile{"begins_pulls_again", begins_pulls_again, kAll_J},
                                         Hostile{"pushes_by_slopes", pushes_by_slopes, kPulled_J},
                                         Hostile{"pushes_by_forces", pushes_by_forces, kPulled_J},
                                         Hostile{"brings_planes_up", brings_planes_up, kAll_J},
                                         Hostile{"sends_anything", sends_anything, kAll_J}),
                         [](const auto& tested) { return std::string(tested.param.name); });

TEST(HandAccount, GivesAnotherPullWhatTheHandHasGivenMeanwhile) {
  HandAccount account;
  EXPECT_EQ(account.pull_share(), 1.0);
  account.add(HandAccount::kReserve_J + HandAccount::kFirst_J, 0.001);
  EXPECT_EQ(account.pull_share(), 0.0);
  EXPECT_EQ(account.plane_share(), 1.0);
  // As by three seconds of strokes of 60 mm/s against friction of 0.2 N.
  account.add(-0.036, 3.0);
  EXPECT_EQ(account.pull_share(), 1.0);
}

TEST(HandAccount, RemembersABoundedPartOfWhatTheHandGave) {
  HandAccount account;
  account.add(-1000.0, 0.001);
  account.add(HandAccount::kMostGiven_J + HandAccount::kReserve_J, 0.002);
  EXPECT_EQ(account.pull_share(), 0.0);
}

TEST(PotentialAccount, LetsASlopeGiveWhatItsPotentialStored) {
  device::PotentialAccount account;
  EXPECT_EQ(account.left_J(), 0.0) << "no slope has come";
  account.add(0.0, 1.0);
  account.note(1.0, 0.003);
  EXPECT_EQ(account.left_J(), 0.0) << "nothing lower is known";
  // Uphill, and read again.
  account.add(-0.002, 1.01);
  account.note(1.01, 0.005);
  EXPECT_NEAR(account.left_J(), 0.002, 1e-12);
  account.add(0.0015, 1.02);
  EXPECT_NEAR(account.left_J(), 0.0005, 1e-12);
  account.add(0.0, 1.2);
  EXPECT_EQ(account.left_J(), 0.0) << "it is too old";
}

}  // namespace
}  // namespace palpable::session
