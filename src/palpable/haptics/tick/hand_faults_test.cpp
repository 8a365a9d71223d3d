// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// Faults at random instants of touches by simulated hands of 0.05 to 0.5 kg, which move as the forces let
// them, for every law with contact, on rough reliefs and on solids. faults_test.cpp has the same faults on
// level ground and prescribed paths, where every force is known.
#include "palpable/haptics/law/field_proxy.hpp"
#include "palpable/haptics/law/law_making.hpp"
#include "palpable/haptics/law/penalty.hpp"
#include "palpable/haptics/law/random_solid.hpp"
#include "palpable/haptics/law/test_period.hpp"
#include "palpable/haptics/law/tool.hpp"
#include "palpable/haptics/tick/energy_touch.hpp"
#include "palpable/haptics/tick/fault_scenes.hpp"
#include "palpable/models/relief/relief_shaping.hpp"

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

/// It is not in an unnamed namespace, so that its read_pages() is found.
class FaultySolid : public RandomSolid {
 public:
  using RandomSolid::RandomSolid;
};
inline void read_pages(const FaultySolid&) noexcept {}

namespace {

constexpr int kInstantsOfAHand = 20;

/// The hand of a device that fails in the ways that a test sets.
class FaultyHand final : public device::Device {
 public:
  explicit FaultyHand(const device::HandOptions& options) : hand_(options) {}

  const device::Traits& traits() const noexcept override { return hand_.traits(); }
  device::Reading read() noexcept override {
    device::Reading reading = hand_.read();
    reading.position.v += shift_m;
    if (is_nan) reading.position.v.y = std::numeric_limits<double>::quiet_NaN();
    reading.status = status;
    return reading;
  }
  void write_torque(Vector<DeviceFrame> torque_Nm) noexcept override {
    written_Nm_ = torque_Nm;
    hand_.write_torque(is_lost ? Vector<DeviceFrame>{} : torque_Nm);
  }
  void write(Vector<DeviceFrame> force_N) noexcept override {
    written_N_ = force_N;
    hand_.write(is_lost ? Vector<DeviceFrame>{} : force_N);
  }
  void stop() noexcept override { hand_.stop(); }
  void stall(int ticks) { hand_.stall(ticks); }
  Vector<DeviceFrame> written_N() const { return written_N_; }
  Vector<DeviceFrame> written_Nm() const { return written_Nm_; }

  Vec3 shift_m;
  bool is_nan = false;
  /// Its motors hold no force.
  bool is_lost = false;
  device::Status status = device::Status::ok;

 private:
  CountedHand hand_;
  Vector<DeviceFrame> written_N_;
  Vector<DeviceFrame> written_Nm_;
};

/// The laws and surfaces of a touch, between which it may change.
struct TouchedScenes {
  const char* name;
  std::vector<HapticScene> (*make)(unsigned seed);
  bool has_torque = false;
};

/// White noise and hills; two stiffnesses, radii and frictions.
std::vector<HapticScene> rough_reliefs(Law law, unsigned seed) {
  std::vector<HapticScene> scenes;
  for (unsigned k = 0; k < 8; ++k) {
    Raster<float> z = random_hills(100, 80, seed);
    if ((k & 1U) != 0) {
      std::mt19937 random(seed);
      std::uniform_real_distribution<float> share(0.0F, 1.0F);
      for (float& height : z.values()) height = 0.005F + 0.001F * share(random);
      models::limit_slope(z, kPixel_m, 3.0);
    }
    LawParameters p = frictionless((k & 2U) != 0 ? 0.001 : 0.0);
    p.law = law;
    p.stiffness_N_per_m = (k & 4U) != 0 ? 300.0 : 700.0;
    p.static_friction = (k & 4U) != 0 ? 0.0 : 0.5;
    p.damping_Ns_per_m = 1.0;
    scenes.push_back({made(scene_of(std::move(z)), p), {}, k});
  }
  return scenes;
}

template <Law law>
std::vector<HapticScene> on_rough_reliefs(unsigned seed) {
  return rough_reliefs(law, seed);
}

std::vector<HapticScene> of_all_laws(unsigned seed) {
  std::vector<HapticScene> scenes;
  for (const Law law : {Law::proxy, Law::penalty, Law::averaged, Law::rolling, Law::sobel})
    for (const HapticScene& scene : rough_reliefs(law, seed)) scenes.push_back(scene);
  return scenes;
}

/// `law(solid, materials, radius)` on random solids.
template <class Make>
std::vector<HapticScene> on_solids(unsigned seed, Make law) {
  std::vector<HapticScene> scenes;
  for (unsigned k = 0; k < 8; ++k) {
    const double friction = (k & 4U) != 0 ? 0.0 : 0.5;
    auto made_on =
        law(std::make_shared<const FaultySolid>(seed + k % 2),
            MaterialMap(Contact{(k & 4U) != 0 ? 300.0 : 700.0, 1.0, friction, friction * 5.0 / 6.0}),
            (k & 2U) != 0 ? 0.001 : 0.0);
    using L = decltype(made_on);
    // The family is that of the surface.
    scenes.push_back({std::make_shared<LawTouchable<L>>(std::move(made_on), k & 3U), {}, k});
  }
  return scenes;
}

std::vector<HapticScene> proxy_on_solids(unsigned seed) {
  return on_solids(seed, [](auto solid, MaterialMap materials, double radius_m) {
    return FieldProxyLaw<FaultySolid>(std::move(solid), std::move(materials), radius_m);
  });
}

std::vector<HapticScene> penalty_on_solids(unsigned seed) {
  return on_solids(seed, [](auto solid, MaterialMap materials, double radius_m) {
    return PenaltyLaw<FaultySolid>(std::move(solid), std::move(materials), radius_m, 0.0);
  });
}

std::vector<HapticScene> tool_on_solids(unsigned seed) {
  return on_solids(seed, [](auto solid, MaterialMap materials, double) {
    return ToolLaw<FaultySolid>(std::move(solid), std::move(materials), ToolShape{0.003, 0.0, 32});
  });
}

const TouchedScenes kTouchedByHands[]{{"proxy", on_rough_reliefs<Law::proxy>},
                                      {"penalty", on_rough_reliefs<Law::penalty>},
                                      {"averaged", on_rough_reliefs<Law::averaged>},
                                      {"rolling", on_rough_reliefs<Law::rolling>},
                                      {"sobel", on_rough_reliefs<Law::sobel>},
                                      {"all_laws", of_all_laws},
                                      {"groove", [](unsigned) { return groove_scenes(); }},
                                      {"grid", [](unsigned) { return grid_scenes(); }},
                                      {"proxy_on_solids", proxy_on_solids},
                                      {"penalty_on_solids", penalty_on_solids},
                                      {"tool_on_solids", tool_on_solids, true}};

/// What was found in all ticks.
struct HandFindings {
  int not_finite = 0;
  /// Ticks whose force points against what the law wants, or is a force where it wants none; the most of it.
  int pulls = 0;
  double most_pull_N = 0.0;
  double most_above_rise_N = 0.0;
  double most_above_rise_Nm = 0.0;
  /// Ticks of faults whose force was not the expected one.
  int unexpected = 0;
  int pressed = 0;
  int in_contact = 0;
};

/// A random hand's touch.
class FaultyTouch {
 public:
  FaultyTouch(const std::vector<HapticScene>& scenes, const device::HandOptions& options)
      : hand(options), scenes_(kept(scenes)), tick_(hand, scenes_.front(), options_, events_) {}

  void change(std::size_t scene) {
    if (tick_.fading()) return;
    coming_ = scene % scenes_.size();
    tick_.change(scenes_[coming_]);
  }
  void stall(int ticks) {
    hand.stall(ticks);
    tick_.note_cut_force();
    step(ticks * kT_s);
  }
  void step(double dt_s = kT_s) {
    const Vector<DeviceFrame> before_N = hand.written_N();
    const Vector<DeviceFrame> before_Nm = hand.written_Nm();
    sample_ = tick_.step(t_s_ += dt_s, dt_s);
    while (events_.take()) {
    }
    const auto above = [](Vector<DeviceFrame> now, Vector<DeviceFrame> before, double most) {
      return norm(cap_rise(now, before, most).force_N - now);
    };
    found.not_finite += is_finite(hand.written_N()) && is_finite(hand.written_Nm()) ? 0 : 1;
    found.most_above_rise_N =
        std::max(found.most_above_rise_N,
                 above(hand.written_N(), before_N, 1.5 * kT_s * options_.max_force_rate_N_per_s));
    found.most_above_rise_Nm =
        std::max(found.most_above_rise_Nm,
                 above(hand.written_Nm(), before_Nm, 1.5 * kT_s * options_.max_torque_rate_Nm_per_s));
    found.pressed += force_N() > 0.2 ? 1 : 0;
    found.in_contact += sample_.has(flag::kContact) ? 1 : 0;
    judge_direction();
  }
  double force_N() const { return norm(hand.written_N()); }
  const TouchSample& sample() const { return sample_; }
  const TickOptions& options() const { return options_; }

  FaultyHand hand;
  HandFindings found;

 private:
  /// With touchables that keep what their laws return.
  static std::vector<HapticScene> kept(std::vector<HapticScene> scenes) {
    for (HapticScene& scene : scenes) scene.touchable = std::make_shared<KeptOutput>(scene.touchable);
    return scenes;
  }
  /// How much of the written force points against this one; all of it if this is none.
  double against_N(Vec3 law_N) const {
    const Vec3 written_N = sample_.written_force_N.v;
    const double wanted_N = norm(law_N);
    return wanted_N > 0.0 ? -dot(written_N, law_N) / wanted_N : norm(written_N);
  }
  /// Where a reading was refused, the force of before is held or ramped down, and no law was evaluated. While
  /// a scene fades in, the law's force is between those of two laws.
  void judge_direction() {
    if (sample_.has(flag::kImplausible) || sample_.status != device::Status::ok || hand.is_nan) return;
    double pull_N = against_N(sample_.raw_force_N.v);
    if (sample_.has(flag::kFading))
      pull_N = std::min(
          pull_N, against_N(static_cast<const KeptOutput&>(*scenes_[coming_].touchable).last().force_N.v));
    found.most_pull_N = std::max(found.most_pull_N, pull_N);
    found.pulls += pull_N > 1e-9 ? 1 : 0;
  }

  std::vector<HapticScene> scenes_;
  std::size_t coming_ = 0;
  TickOptions options_;
  Ring<TouchEvent> events_{256};
  TickPipeline tick_;
  TouchSample sample_;
  double t_s_ = 0.0;
};

/// What a fault does to a touch: it steps through it.
using Fault = std::function<void(FaultyTouch&, std::mt19937&)>;

HandFindings& add(HandFindings& sum, const HandFindings& more) {
  sum.not_finite += more.not_finite;
  sum.pulls += more.pulls;
  sum.most_pull_N = std::max(sum.most_pull_N, more.most_pull_N);
  sum.most_above_rise_N = std::max(sum.most_above_rise_N, more.most_above_rise_N);
  sum.most_above_rise_Nm = std::max(sum.most_above_rise_Nm, more.most_above_rise_Nm);
  sum.unexpected += more.unexpected;
  sum.pressed += more.pressed;
  sum.in_contact += more.in_contact;
  return sum;
}

/// A hand of 0.05 to 0.5 kg with a delay of 0 to 2 ticks that strokes the surface.
device::HandOptions stroking(Hands& hands, bool has_torque, unsigned seed) {
  device::HandOptions options = loose_hand(hands, seed, 0.5);
  options.script.workspace_m = {0.018, 0.014, 0.02};
  options.has_torque = has_torque;
  return options;
}

/// The fault at random instants, mostly in contact, of touches by different hands.
HandFindings attack(const TouchedScenes& touched, const Fault& fault) {
  std::mt19937 random(33);
  Hands hands(33);
  HandFindings found;
  const std::vector<HapticScene> scenes = touched.make(3);
  for (int done = 0; done < instants(kInstantsOfAHand); done += kInstantsOfAHand) {
    FaultyTouch touch(scenes, stroking(hands, touched.has_torque, static_cast<unsigned>(done) + 1));
    for (int k = 0; k < std::min(kInstantsOfAHand, instants(kInstantsOfAHand) - done); ++k) {
      for (int n = std::uniform_int_distribution<int>(20, 250)(random); n > 0; --n) touch.step();
      for (int n = 0; n < 400 && touch.force_N() < 0.1; ++n) touch.step();
      fault(touch, random);
    }
    for (int n = 0; n < 300; ++n) touch.step();
    add(found, touch.found);
  }
  return found;
}

testing::AssertionResult is_harmless(const HandFindings& found) {
  if (found.not_finite == 0 && found.pulls == 0 && found.unexpected == 0 && found.most_above_rise_N < 1e-9 &&
      found.most_above_rise_Nm < 1e-9 && found.pressed > instants(kInstantsOfAHand))
    return testing::AssertionSuccess();
  return testing::AssertionFailure() << found.not_finite << " forces not finite, " << found.pulls
                                     << " pulls of up to " << found.most_pull_N << " N, " << found.unexpected
                                     << " unexpected, " << found.most_above_rise_N << " N and "
                                     << found.most_above_rise_Nm << " N m above the rise limit, "
                                     << found.pressed << " ticks pressed, " << found.in_contact
                                     << " in contact";
}

/// A shift of this length in a random direction.
Vec3 shift(std::mt19937& random, double length_m) {
  const auto side = [&] { return std::normal_distribution<double>()(random); };
  return length_m * unit(Vec3{side(), side(), side()});
}

class HandFaults : public testing::TestWithParam<TouchedScenes> {};

TEST_P(HandFaults, FiftyMillisecondsWithoutATickEndInForceThatRisesFromZero) {
  EXPECT_TRUE(is_harmless(attack(GetParam(), [](FaultyTouch& touch, std::mt19937&) {
    touch.stall(50);
    // It comes back within 50 ms: by 3 % in the first tick, of 10 N at most.
    constexpr double kFirst_N = 0.3;
    touch.found.unexpected += touch.force_N() < kFirst_N ? 0 : 1;
  })));
}

TEST_P(HandFaults, AGlitchOfThreeMillimetresIsNotFelt) {
  EXPECT_TRUE(is_harmless(attack(GetParam(), [](FaultyTouch& touch, std::mt19937& random) {
    touch.hand.shift_m = shift(random, 0.003);
    const Vector<DeviceFrame> before = touch.hand.written_N();
    touch.step();
    // If the hand itself moves the other way, the reading is one that a fast hand could give.
    const bool refused = touch.sample().has(flag::kImplausible);
    touch.found.unexpected += refused && touch.hand.written_N() != before ? 1 : 0;
    touch.hand.shift_m = {};
  })));
}

TEST_P(HandFaults, AJumpThatLastsIsANewTouch) {
  EXPECT_TRUE(is_harmless(attack(GetParam(), [](FaultyTouch& touch, std::mt19937& random) {
    touch.hand.shift_m = touch.hand.shift_m == Vec3{} ? shift(random, 0.02) : Vec3{};
    for (int n = 0; n < 2; ++n) touch.step();
    touch.step();
    touch.found.unexpected += touch.sample().has(flag::kNewTouch) && touch.force_N() < kBegins_N ? 0 : 1;
  })));
}

TEST_P(HandFaults, SilenceRampsTheForceDown) {
  EXPECT_TRUE(is_harmless(attack(GetParam(), [](FaultyTouch& touch, std::mt19937& random) {
    (random() % 2 == 0 ? touch.hand.is_nan : touch.hand.is_lost) = true;
    touch.hand.status = touch.hand.is_lost ? device::Status::stale : device::Status::ok;
    const int gone = 3 + static_cast<int>(touch.options().ramp_down_s / kT_s);
    for (int n = 0; n < static_cast<int>(from(random, 1.0, 60.0)); ++n) {
      touch.step();
      touch.found.unexpected += n < gone || touch.force_N() == 0.0 ? 0 : 1;
    }
    touch.hand.is_nan = touch.hand.is_lost = false;
    touch.hand.status = device::Status::ok;
  })));
}

TEST_P(HandFaults, ADeviceThatIsLostAndFoundBeginsFromZero) {
  EXPECT_TRUE(is_harmless(attack(GetParam(), [](FaultyTouch& touch, std::mt19937& random) {
    touch.hand.is_lost = true;
    touch.hand.status = device::Status::fault;
    for (int n = static_cast<int>(from(random, 50.0, 500.0)); n > 0; --n) touch.step();
    touch.found.unexpected += touch.force_N() == 0.0 ? 0 : 1;
    touch.hand.is_lost = false;
    touch.hand.status = device::Status::ok;
    touch.step();
    touch.found.unexpected += touch.force_N() < kBegins_N ? 0 : 1;
  })));
}

TEST_P(HandFaults, ChangesOfSceneLawRadiusStiffnessAndFrictionMakeNoStep) {
  EXPECT_TRUE(is_harmless(attack(GetParam(), [](FaultyTouch& touch, std::mt19937& random) {
    touch.change(random());
    for (int n = static_cast<int>(from(random, 1.0, 200.0)); n > 0; --n) touch.step();
  })));
}

/// Two touches by the same hand, one of whose surfaces is replaced by an equal one 30 times a second.
TEST_P(HandFaults, UpdatesOfAnUnchangedSurfaceChangeNothing) {
  if (GetParam().make == of_all_laws) GTEST_SKIP() << "each of its laws is tested by itself";
  const std::vector<HapticScene> scenes = GetParam().make(3);
  const std::vector<HapticScene> again = GetParam().make(3);
  Hands hands(34);
  const int count = std::clamp(instants(kInstantsOfAHand) / 5, 4, 40);
  std::uint64_t in_contact = 0;
  for (int k = 0; k < count; ++k) {
    const auto scene = static_cast<std::size_t>(k) % scenes.size();
    const std::vector<HapticScene> still{scenes[scene]};
    const std::vector<HapticScene> replaced{scenes[scene], again[scene]};
    const auto options = stroking(hands, GetParam().has_torque, static_cast<unsigned>(k) + 1);
    FaultyTouch left(still, options);
    FaultyTouch updated(replaced, options);
    for (std::size_t n = 0; n < 1500; ++n) {
      if (n % 33 == 32) updated.change(n / 33);
      left.step();
      updated.step();
      ASSERT_EQ(left.hand.written_N(), updated.hand.written_N()) << "hand " << k << ", tick " << n;
      ASSERT_EQ(left.hand.written_Nm(), updated.hand.written_Nm()) << "hand " << k << ", tick " << n;
      ASSERT_EQ(left.sample().energy_J, updated.sample().energy_J) << "hand " << k << ", tick " << n;
      in_contact += left.sample().has(flag::kContact) ? 1 : 0;
    }
  }
  EXPECT_GT(in_contact, 50U * static_cast<unsigned>(count));
}

INSTANTIATE_TEST_SUITE_P(Laws, HandFaults, testing::ValuesIn(kTouchedByHands),
                         [](const auto& touched) { return std::string(touched.param.name); });

}  // namespace
}  // namespace palpable::haptics
