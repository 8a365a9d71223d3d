// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// Faults at random instants of a press, each kind separately and for each law with contact. Whatever happens
// to readings, ticks and scenes, the force never grows faster than the rise limit, never pulls and never
// pushes sideways. A single wrong reading is not felt; after a lasting jump, missing readings or a stall, the
// force restarts from zero.
#include "palpable/haptics/law/field_proxy.hpp"
#include "palpable/haptics/law/law_making.hpp"
#include "palpable/haptics/law/penalty.hpp"
#include "palpable/haptics/law/test_period.hpp"
#include "palpable/haptics/law/tool.hpp"
#include "palpable/haptics/servo/test_touch.hpp"
#include "palpable/haptics/tick/fault_scenes.hpp"
#include "palpable/haptics/tick/tick.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace palpable::haptics {

/// Level ground as a solid. It is not in an unnamed namespace, so that its read_pages() is found.
class LevelSolid {
 public:
  explicit LevelSolid(double ground_m = 0.005) : ground_m_(ground_m) {}
  models::FieldSample sample(Point<SceneFrame> p) const noexcept {
    return {p.v.z - ground_m_, {{0.0, 0.0, 1.0}}};
  }
  double cell_m() const noexcept { return 2e-4; }
  std::size_t memory_bytes() const noexcept { return sizeof(*this); }

 private:
  double ground_m_;
};
inline void read_pages(const LevelSolid&) noexcept {}

namespace {

std::vector<HapticScene> relief_scenes(Law law) {
  std::vector<HapticScene> scenes;
  for (const double radius_m : {0.0, 0.001})
    for (const double stiffness_N_per_m : {500.0, 1500.0})
      for (const float ground_m : {0.005F, 0.0052F})
        scenes.push_back(on_relief(law, flat_ground(ground_m), radius_m, stiffness_N_per_m));
  return scenes;
}

std::vector<HapticScene> scenes_of_all_laws() {
  std::vector<HapticScene> scenes;
  for (const Law law : {Law::proxy, Law::penalty, Law::averaged})
    for (const HapticScene& scene : relief_scenes(law)) scenes.push_back(scene);
  return scenes;
}

std::vector<HapticScene> hill_scenes() {
  std::vector<HapticScene> scenes;
  for (const Law law : {Law::proxy, Law::penalty, Law::averaged, Law::rolling, Law::sobel})
    for (const unsigned seed : {5U, 6U})
      scenes.push_back(on_relief(law, scene_of(random_hills(100, 80, seed)), 0.0, 1000.0));
  return scenes;
}

/// `law(solid, material, radius)` on level solids.
template <class Make>
std::vector<HapticScene> solid_scenes(Make law) {
  std::vector<HapticScene> scenes;
  for (const double radius_m : {0.0, 0.001})
    for (const double stiffness_N_per_m : {500.0, 1500.0})
      for (const double ground_m : {0.005, 0.0052}) {
        auto made_on = law(std::make_shared<const LevelSolid>(ground_m),
                           MaterialMap(Contact{stiffness_N_per_m, 2.0, 0.0, 0.0}), radius_m);
        using L = decltype(made_on);
        scenes.push_back({std::make_shared<LawTouchable<L>>(std::move(made_on), scenes.size()), {}, 0});
      }
  return scenes;
}

/// The model that is touched during a fault.
struct TouchedLaw {
  const char* name;
  std::vector<HapticScene> (*scenes)();
  /// Limit of the sideways force on level ground; infinite if the ground is not level. At a first contact the
  /// proxy is at the previous position of the hand, one tick behind: the resulting force is too small to be
  /// felt.
  double side_N = 0.02;
};

const TouchedLaw kTouched[]{
    {"proxy", [] { return relief_scenes(Law::proxy); }},
    {"penalty", [] { return relief_scenes(Law::penalty); }},
    {"averaged", [] { return relief_scenes(Law::averaged); }},
    {"groove", groove_scenes},
    // A plate also has a lower side, which pushes down a hand that jumped there.
    {"grid", grid_scenes, std::numeric_limits<double>::infinity()},
    {"proxy_on_a_field",
     [] {
       return solid_scenes([](auto solid, MaterialMap materials, double radius_m) {
         return FieldProxyLaw<LevelSolid>(std::move(solid), std::move(materials), radius_m);
       });
     }},
    {"penalty_on_a_field",
     [] {
       return solid_scenes([](auto solid, MaterialMap materials, double radius_m) {
         return PenaltyLaw<LevelSolid>(std::move(solid), std::move(materials), radius_m, 0.0);
       });
     }},
    {"tool",
     [] {
       return solid_scenes([](auto solid, MaterialMap materials, double) {
         return ToolLaw<LevelSolid>(std::move(solid), std::move(materials), ToolShape{0.001, 0.0, 32});
       });
     }},
    {"changing_laws", scenes_of_all_laws},
    {"laws_on_hills", hill_scenes, std::numeric_limits<double>::infinity()}};

/// What was found in all ticks.
struct Findings {
  int not_finite = 0;
  int pulls = 0;
  double most_sideways_N = 0.0;
  double most_above_rise_N = 0.0;
  /// Ticks of faults whose force was not the expected one.
  int unexpected = 0;
  int pressed = 0;
};

/// A hand that repeatedly presses the ground, at most 2 mm deep, with a device of at most 20 N.
class Press {
 public:
  explicit Press(const TouchedLaw& law) : side_N_(law.side_N) {
    device_.mutable_traits().max_force_N = 20.0;
    device_.mutable_traits().workspace_m = {0.1, 0.1, 0.1};
    for (HapticScene& scene : law.scenes())
      scenes_.push_back(std::make_unique<HapticScene>(std::move(scene)));
    tick_ = std::make_unique<TickPipeline>(device_, *scenes_.front(), options_, events_);
  }

  /// The fault in the next ticks.
  double shift_m = 0.0;
  bool is_silent = false;
  bool is_nan = false;
  double dt_s = kT_s;
  Findings found;

  void change(std::size_t scene) {
    if (!tick_->fading()) tick_->change(*scenes_[scene % scenes_.size()]);
  }

  void step() {
    t_s_ += dt_s;
    device_.reading = {};
    device_.reading.position = {
        {0.003 * std::sin(2.0 * t_s_), 0.0, 0.005 + 0.002 * std::sin(9.0 * t_s_) + shift_m}};
    if (is_nan) device_.reading.position.v.z = std::numeric_limits<double>::quiet_NaN();
    if (is_silent) device_.reading.status = device::Status::stale;
    const Vector<DeviceFrame> before = written_;
    tick_->step(t_s_, dt_s);
    written_ = {device_.written.back()};
    device_.written.clear();
    found.not_finite += is_finite(written_) ? 0 : 1;
    const double rise_N = options_.max_force_rate_N_per_s * 1.5 * kT_s;
    const auto risen = cap_rise(written_, before, rise_N);
    found.most_above_rise_N = std::max(found.most_above_rise_N, norm(risen.force_N - written_));
    if (std::isfinite(side_N_)) {
      found.pulls += written_.v.z < 0.0 ? 1 : 0;
      found.most_sideways_N = std::max(found.most_sideways_N, std::hypot(written_.v.x, written_.v.y));
    }
    found.pressed += norm(written_) > 0.5 ? 1 : 0;
    while (events_.take()) {
    }
  }
  double force_N() const { return norm(written_); }
  const TickOptions& options() const { return options_; }

 private:
  double side_N_;
  TickOptions options_;
  ScriptedDevice device_;
  std::vector<std::unique_ptr<HapticScene>> scenes_;
  Ring<TouchEvent> events_{256};
  std::unique_ptr<TickPipeline> tick_;
  Vector<DeviceFrame> written_;
  double t_s_ = 0.0;
};

/// Whether the force in tick `n` of a fault, counted from 0, is as expected; `before_N`: before the fault.
using Check = std::function<bool(const Press&, int n, double before_N)>;

/// `fault` starts a fault and returns its number of ticks; `check` tests each of these ticks; `over` ends the
/// fault.
Findings attack(const TouchedLaw& law, const std::function<int(Press&, std::mt19937&)>& fault,
                const Check& check, const std::function<void(Press&)>& over) {
  std::mt19937 random(21);
  std::uniform_int_distribution<int> wait(20, 900);
  Press press(law);
  for (int k = 0; k < instants(); ++k) {
    for (int n = wait(random); n > 0; --n) press.step();
    const double before_N = press.force_N();
    const int ticks = fault(press, random);
    for (int n = 0; n < ticks; ++n) {
      press.step();
      press.found.unexpected += check(press, n, before_N) ? 0 : 1;
    }
    over(press);
  }
  return press.found;
}

/// No step above the rise limit, no pull, no force to a side, and the expected forces; the hand pressed.
testing::AssertionResult is_harmless(const TouchedLaw& law, const Findings& found) {
  if (found.not_finite == 0 && found.pulls == 0 && found.unexpected == 0 && found.most_above_rise_N < 1e-9 &&
      found.most_sideways_N < law.side_N && found.pressed > 100 * instants() / 4)
    return testing::AssertionSuccess();
  return testing::AssertionFailure() << found.not_finite << " forces not finite, " << found.pulls
                                     << " pulls, " << found.unexpected << " unexpected, "
                                     << found.most_above_rise_N << " N above the rise limit, "
                                     << found.most_sideways_N << " N sideways, " << found.pressed
                                     << " ticks pressed";
}

int sign(std::mt19937& random) { return (random() & 1U) != 0 ? 1 : -1; }

class Faults : public testing::TestWithParam<TouchedLaw> {};

TEST_P(Faults, OfASensorThatGlitchesMakeNoStepAndNoPull) {
  const Findings found = attack(
      GetParam(),
      [](Press& press, std::mt19937& random) {
        press.shift_m += sign(random) * from(random, 0.003, 0.05);
        return std::uniform_int_distribution<int>(1, 2)(random);
      },
      [](const Press& press, int, double before_N) { return press.force_N() == before_N; },
      [](Press& press) { press.shift_m = 0.0; });
  EXPECT_TRUE(is_harmless(GetParam(), found));
}

TEST_P(Faults, OfASensorThatJumpsForGoodMakeNoStepAndNoPull) {
  const Findings found = attack(
      GetParam(),
      [](Press& press, std::mt19937& random) {
        press.shift_m = press.shift_m == 0.0 ? sign(random) * from(random, 0.003, 0.02) : 0.0;
        return 3;
      },
      [](const Press& press, int n, double before_N) {
        // Two wrong readings may be a glitch; the third one agrees with them.
        return n < 2 ? press.force_N() == before_N : press.force_N() < kBegins_N;
      },
      [](Press&) {});
  EXPECT_TRUE(is_harmless(GetParam(), found));
}

TEST_P(Faults, OfADeviceThatFallsSilentOrGivesNoNumberMakeNoStepAndNoPull) {
  const Findings found = attack(
      GetParam(),
      [](Press& press, std::mt19937& random) {
        (sign(random) > 0 ? press.is_silent : press.is_nan) = true;
        return std::uniform_int_distribution<int>(1, 120)(random);
      },
      [](const Press& press, int n, double) {
        const int gone = 3 + static_cast<int>(press.options().ramp_down_s / kT_s);
        return n < gone || press.force_N() == 0.0;
      },
      [](Press& press) { press.is_silent = press.is_nan = false; });
  EXPECT_TRUE(is_harmless(GetParam(), found));
}

TEST_P(Faults, OfALoopThatStallsMakeNoStepAndNoPull) {
  const Findings found = attack(
      GetParam(),
      [](Press& press, std::mt19937& random) {
        press.dt_s = from(random, 0.002, 0.2);
        return 1;
      },
      [](const Press& press, int, double) {
        return press.dt_s <= press.options().stall_s || press.force_N() < kBegins_N;
      },
      [](Press& press) { press.dt_s = kT_s; });
  EXPECT_TRUE(is_harmless(GetParam(), found));
}

TEST_P(Faults, OfChangesOfSceneRadiusAndStiffnessMakeNoStepAndNoPull) {
  const Findings found = attack(
      GetParam(),
      [](Press& press, std::mt19937& random) {
        press.change(random());
        return 1;
      },
      [](const Press&, int, double) { return true; }, [](Press&) {});
  EXPECT_TRUE(is_harmless(GetParam(), found));
}

INSTANTIATE_TEST_SUITE_P(Laws, Faults, testing::ValuesIn(kTouched),
                         [](const auto& touched) { return std::string(touched.param.name); });

}  // namespace
}  // namespace palpable::haptics
