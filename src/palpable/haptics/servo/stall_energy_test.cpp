// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// What comes back to a hand after a stall in contact: the touch goes on from no force inside a surface, whose
// spring holds energy that the motors no longer do.
#include "palpable/haptics/law/law_making.hpp"
#include "palpable/haptics/law/penalty.hpp"
#include "palpable/haptics/law/stroke_scenes.hpp"
#include "palpable/haptics/law/tool.hpp"
#include "palpable/haptics/safety/limits.hpp"
#include "palpable/haptics/safety/stability.hpp"
#include "palpable/haptics/safety/test_hands.hpp"
#include "palpable/haptics/servo/tick.hpp"
#include "palpable/haptics/servo/turn.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace palpable::haptics {

/// Balls on a plate. It is not in an unnamed namespace, so that its read_pages() is found.
class StalledPebbles : public Pebbles {};
inline void read_pages(const StalledPebbles&) noexcept {}

namespace {

constexpr double kT_s = 0.001;

/// A simulated hand, and what it received from its motors by its true movements since it was last in free
/// air.
class CountedHand final : public device::Device {
 public:
  explicit CountedHand(const device::HandOptions& options)
      : hand_(options), on_the_way_(static_cast<std::size_t>(options.delay_samples)) {}

  const device::Traits& traits() const noexcept override { return hand_.traits(); }
  device::Reading read() noexcept override { return hand_.read(); }
  void write_torque(Vector<DeviceFrame> torque_Nm) noexcept override { written_Nm_ = torque_Nm; }
  void write(Vector<DeviceFrame> force_N) noexcept override {
    written_N_ = force_N;
    on_the_way_.push_back({force_N, written_Nm_});
    const Motors acts = on_the_way_.front();
    on_the_way_.erase(on_the_way_.begin());
    const Vec3 before_m = hand_.true_position_m();
    const device::Rotation before = hand_.read().rotation;
    hand_.write_torque(written_Nm_);
    hand_.write(force_N);
    received_J_ += dot(acts.force_N.v, hand_.true_position_m() - before_m) +
                   dot(acts.torque_Nm, turn_between(before, hand_.read().rotation));
  }
  void stop() noexcept override { hand_.stop(); }

  /// No tick comes for so long; after 5 ms the watchdog cuts the force.
  void stall(int ticks) {
    for (int n = 1; n < ticks; ++n) {
      if (n == 5) {
        hand_.cut_force();
        written_N_ = written_Nm_ = {};
        std::fill(on_the_way_.begin(), on_the_way_.end(), Motors{});
      }
      write(written_N_);
    }
  }
  void begin_account() noexcept { received_J_ = 0.0; }
  double received_J() const noexcept { return received_J_; }
  Vector<DeviceFrame> written_N() const noexcept { return written_N_; }

 private:
  struct Motors {
    Vector<DeviceFrame> force_N;
    Vector<DeviceFrame> torque_Nm;
  };
  device::SimulatedHand hand_;
  std::vector<Motors> on_the_way_;
  Vector<DeviceFrame> written_N_;
  Vector<DeviceFrame> written_Nm_;
  double received_J_ = 0.0;
};

/// Makes one of two scenes with a law.
using MakeScene = std::shared_ptr<const Touchable> (*)(const SafeContact&, unsigned seed);

template <Law law, int kFrictionPercent>
std::shared_ptr<const Touchable> on_hills(const SafeContact& safe, unsigned seed) {
  LawParameters parameters;
  parameters.law = law;
  parameters.static_friction = 0.01 * kFrictionPercent;
  parameters.stiffness_N_per_m = safe.stiffness_N_per_m;
  parameters.damping_Ns_per_m = safe.damping_Ns_per_m;
  return made(scene_of(random_hills(200, 160, seed)), parameters);
}

std::shared_ptr<const Touchable> in_grooves(const SafeContact& safe, unsigned /*seed*/) {
  Raster<float> plate(200, 160, 0.005F);
  for (int y = 0; y < plate.height(); ++y)
    for (int x = 0; x < plate.width(); ++x)
      plate(x, y) -=
          0.0001F * static_cast<float>(std::max({0, 10 - std::abs(x % 40 - 20), 10 - std::abs(y % 50 - 25)}));
  models::Scene scene;
  scene.model = std::make_shared<const models::Contours>(models::Contours{
      *models::BoundaryMap::from_edges(Raster<models::BoundaryPixel>(200, 160), kPixel_m, 2.0, {}, Work{}),
      models::relief_of(scene_of(std::move(plate)))});
  LawParameters parameters;
  parameters.law = Law::groove;
  parameters.stiffness_N_per_m = safe.stiffness_N_per_m;
  parameters.damping_Ns_per_m = safe.damping_Ns_per_m;
  return made(scene, parameters);
}

template <class SolidLaw>
std::shared_ptr<const Touchable> solid_law(SolidLaw law) {
  return std::make_shared<LawTouchable<SolidLaw>>(std::move(law), 1);
}

std::shared_ptr<const Touchable> penalty_on_balls(const SafeContact& safe, unsigned /*seed*/) {
  return solid_law(PenaltyLaw<StalledPebbles>(
      std::make_shared<const StalledPebbles>(),
      MaterialMap({safe.stiffness_N_per_m, safe.damping_Ns_per_m, 0.0, 0.0}), 0.0, 0.0));
}

std::shared_ptr<const Touchable> tool_on_balls(const SafeContact& safe, unsigned /*seed*/) {
  return solid_law(ToolLaw<StalledPebbles>(
      std::make_shared<const StalledPebbles>(),
      MaterialMap({safe.stiffness_N_per_m, safe.damping_Ns_per_m, 0.0, 0.0}), ToolShape{0.003, 0.0, 32}));
}

struct Stalled {
  const char* name;
  MakeScene scene;
  /// A change of scene begins up to 5 ticks before every second stall.
  bool scenes_change = false;
  bool has_torque = false;
  /// Within its depth, a penalty's force says nothing of what it stores.
  bool force_shows_energy = true;
};

/// The worst of all stalls, J.
struct Outcome {
  /// Received beyond what the hand gave in the same contact; and after the stall beyond what the spring held
  /// before it.
  double beyond_given_J = 0.0;
  double beyond_held_J = 0.0;
  /// As the account says.
  double said_J = 0.0;
  double beyond_rise_N = 0.0;
  int in_contact = 0;
};

/// One hand that explores hills.
class StalledTouch {
 public:
  StalledTouch(const Stalled& stalled, const device::HandOptions& options, unsigned seed)
      : random_(seed), hand_(options) {
    const auto safe = safe_contact(hand_.traits(), options.rate_hz, 1.0, 1e5, 0.5);
    stiffness_N_per_m_ = safe.stiffness_N_per_m;
    for (unsigned k = 0; k < 2; ++k) scenes_[k].touchable = stalled.scene(safe, 5 + k);
    options_.passivity = Passivity::observe;
    tick_.emplace(hand_, scenes_[0], options_, events_);
  }

  void explore(int ticks) {
    while (ticks-- > 0) step(kT_s);
    for (int n = 0; n < 5000 && !in_contact_; ++n) step(kT_s);
  }

  void stall(bool change) {
    if (change && !tick_->fading()) {
      tick_->change(scenes_[shown_ = 1 - shown_]);
      for (auto n = random_() % 6; n > 0; --n) step(kT_s);
    }
    const int late = random_() % 2 == 0 ? 15 : 50;
    const double force_N = norm(hand_.written_N());
    const double held_J = 0.5 * force_N * force_N / stiffness_N_per_m_;
    hand_.stall(late);
    const double before_J = hand_.received_J();
    tick_->note_cut_force();
    step(late * kT_s);
    worst_.in_contact += in_contact_ ? 1 : 0;
    for (int n = 0; n < 600 && in_contact_; ++n) {
      worst_.beyond_held_J = std::max(worst_.beyond_held_J, hand_.received_J() - before_J - held_J);
      step(kT_s);
    }
  }

  Outcome worst() {
    worst_.said_J = tick_->counts().made_max_J;
    return worst_;
  }

 private:
  void step(double dt_s) {
    const Vector<DeviceFrame> before = hand_.written_N();
    const TouchSample& sample = tick_->step(t_s_ += dt_s, dt_s);
    while (events_.take()) {
    }
    const auto risen = cap_rise(hand_.written_N(), before, 1.5 * kT_s * options_.max_force_rate_N_per_s);
    worst_.beyond_rise_N = std::max(worst_.beyond_rise_N, norm(risen.force_N - hand_.written_N()));
    in_contact_ = sample.has(flag::kContact);
    worst_.beyond_given_J = std::max(worst_.beyond_given_J, hand_.received_J());
    if (!in_contact_ && hand_.written_N() == Vector<DeviceFrame>{}) hand_.begin_account();
  }

  std::mt19937 random_;
  CountedHand hand_;
  double stiffness_N_per_m_ = 0.0;
  std::array<HapticScene, 2> scenes_;
  std::size_t shown_ = 0;
  TickOptions options_;
  Ring<TouchEvent> events_{1024};
  std::optional<TickPipeline> tick_;
  double t_s_ = 0.0;
  bool in_contact_ = false;
  Outcome worst_;
};

class StallIn : public testing::TestWithParam<Stalled> {};

TEST_P(StallIn, ContactGivesNothingBackThatTheHandDidNotGive) {
  Hands hands(29);
  std::mt19937 random(5);
  int in_contact = 0;
  for (unsigned k = 1; k <= 10; ++k) {
    device::HandOptions options = hands.next();
    options.resolution_m = 1e-6;
    options.explorer.script = device::ExplorerOptions::Script::random;
    options.explorer.workspace_m = {0.04, 0.03, 0.03};
    options.explorer.seed = k;
    options.has_torque = GetParam().has_torque;
    StalledTouch touch(GetParam(), options, k);
    for (int n = 0; n < 20; ++n) {
      touch.explore(std::uniform_int_distribution<int>(100, 600)(random));
      touch.stall(GetParam().scenes_change && n % 2 == 0);
    }
    const Outcome worst = touch.worst();
    EXPECT_LE(worst.beyond_given_J, 1e-6) << "hand " << k;
    if (GetParam().force_shows_energy) {
      EXPECT_LE(worst.beyond_held_J, 1e-6) << "hand " << k;
    }
    // The account forgets friction of long ago, and says a little more.
    EXPECT_LE(worst.said_J, 1e-5) << "hand " << k;
    EXPECT_LT(worst.beyond_rise_N, 1e-9) << "hand " << k;
    in_contact += worst.in_contact;
  }
  EXPECT_GT(in_contact, 150);
}

TEST(FrictionlessProxy, GivesNothingBackThatTheHandDidNotGiveAndIsNotSaidTo) {
  // Without friction nothing hides what a spring gives whose direction turns under a crease.
  Hands hands(29);
  for (unsigned k = 1; k <= 12; ++k) {
    device::HandOptions options = hands.next();
    options.resolution_m = 1e-6;
    options.explorer.script = device::ExplorerOptions::Script::random;
    options.explorer.workspace_m = {0.04, 0.03, 0.03};
    options.explorer.seed = k;
    StalledTouch touch({"frictionless_proxy", on_hills<Law::proxy, 0>}, options, k);
    touch.explore(8000);
    const Outcome outcome = touch.worst();
    EXPECT_LE(outcome.beyond_given_J, 1e-6) << "hand " << k;
    EXPECT_LE(outcome.said_J, 1e-6) << "hand " << k;
  }
}

INSTANTIATE_TEST_SUITE_P(
    Laws, StallIn,
    testing::Values(
        Stalled{"proxy", on_hills<Law::proxy, 50>}, Stalled{"slippery_proxy", on_hills<Law::proxy, 20>},
        Stalled{.name = "proxy_on_changing_scenes", .scene = on_hills<Law::proxy, 50>, .scenes_change = true},
        Stalled{.name = "penalty", .scene = on_hills<Law::penalty, 0>, .force_shows_energy = false},
        Stalled{"groove", in_grooves},
        Stalled{.name = "penalty_on_a_field", .scene = penalty_on_balls, .force_shows_energy = false},
        Stalled{.name = "tool", .scene = tool_on_balls, .has_torque = true, .force_shows_energy = false}),
    [](const auto& stalled) { return std::string(stalled.param.name); });

}  // namespace
}  // namespace palpable::haptics
