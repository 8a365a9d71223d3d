// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/core/system/allocations.hpp"
#include "palpable/device/drivers/open.hpp"
#include "palpable/device/pointer/pointer.hpp"
#include "palpable/device/remote/remote_wire.hpp"
#include "palpable/device/simulated/simulated_hand.hpp"
#include "palpable/device/url.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace palpable::device {
namespace {

Error error_of(const std::string& url) {
  auto device = open_device(url, {});
  EXPECT_FALSE(device) << url;
  return device ? Error{} : device.error();
}

TEST(OpenDevice, NamesWhatIsWrongWithAnAddress) {
  for (const auto* url :
       {"", "sim", ":x", "falcon9:", "sim:?mass", "sim:?mass=1&mass=2", "sim:?mas=1", "sim:?mass=heavy",
        "sim:?mass=-1", "sim:?mass=nan", "sim:foo", "sim:?dof=4", "pointer:", "replay:"}) {
    const Error error = error_of(url);
    EXPECT_EQ(error.code, ErrorCode::usage) << url;
    EXPECT_FALSE(error.message.empty());
  }
  EXPECT_NE(error_of("sim:?mass=99").sentence().find("0.01 to 5"), std::string::npos);
  EXPECT_NE(error_of("sim:?delay=1.5").sentence().find("whole number"), std::string::npos);
  EXPECT_NE(error_of("sim:?mas=1").message.find("known: mass, damping"), std::string::npos);
  EXPECT_NE(error_of("2diy").message.find("2diy:"), std::string::npos);
  EXPECT_EQ(error_of("sim:?motors=").message, "motors is given without a value");
  EXPECT_NE(error_of("pointer:/dev/input/mouse0").message.find("takes no name"), std::string::npos);
  EXPECT_NE(error_of("touch:?library=nowhere.so").message.find("nowhere.so is not there"), std::string::npos);
  EXPECT_EQ(error_of("replay:/nowhere/at/all").code, ErrorCode::invalid_input);
}

TEST(OpenDevice, ChecksTheAddressOfAnotherComputerBeforeItConnects) {
  const std::string whole = "remote:desk.local:4711?token=" + std::string(kSecret_bytes, 'x');
  EXPECT_TRUE(check_device_url(whole));
  for (const std::string& url :
       {std::string("remote:"), std::string("remote:desk.local"), whole + "&speed=1",
        std::string("remote:desk.local:0?token=x"), whole.substr(0, whole.size() - 1)})
    EXPECT_FALSE(check_device_url(url)) << url;
}

TEST(OpenDevice, ChecksOptionsWithoutOpeningAnything) {
  for (const auto* url : {"2diy:/nowhere?variant=v1", "FALCON:?max-force=2", "touch:?library=/nowhere.so",
                          "forcedimension:", "inverse3:?continuous-force=1", "evdev:", "sim:", "pointer:"})
    EXPECT_TRUE(check_device_url(url)) << url;
  for (const auto* url :
       {"2diy:?variant=v9", "falcon:?max-force=a", "touch:?lib=x",
        "forcedimension:?initialise=", "inverse3:?port=0", "evdev:?size-mm=1", "sim:?mass=nan"})
    EXPECT_EQ(check_device_url(url).error().code, ErrorCode::usage) << url;
}

TEST(OpenDevice, NamesADriverWithoutItsColon) {
  for (const DeviceKind& kind : list_devices()) {
    const auto opened = open_device(kind.url, {});
    if (opened) continue;
    EXPECT_EQ(opened.error().sentence().find("::"), std::string::npos) << opened.error().sentence();
  }
}

TEST(OpenDevice, ShowsNoTokenInItsErrors) {
  EXPECT_EQ(public_url("remote:a:1?token=secret&x=1"), "remote:a:1?token=…&x=1");
  EXPECT_EQ(public_url("remote:a:1?x=1&token=secret&token=again"), "remote:a:1?x=1&token=…&token=…");
  EXPECT_EQ(public_url("sim:?mass=1"), "sim:?mass=1");
  for (const auto* url :
       {"remote:a:1?token=secret", "remote:a:1?token=secret&x=1", "remote:a:1?token=secret&token=secret",
        "2diy:?token=secret", "remotes:a:1?token=secret"})
    EXPECT_EQ(error_of(url).sentence().find("secret"), std::string::npos) << error_of(url).sentence();
}

TEST(OpenDevice, GivesASimulatedHandTheOptionsOfItsAddress) {
  const auto device = open_device("sim:?mass=0.2&dof=2&resolution-um=30&delay=2&max-force=1.5", {});
  ASSERT_TRUE(device) << device.error().sentence();
  const auto& traits = (*device)->traits();
  EXPECT_EQ(traits.mass_kg, 0.2);
  EXPECT_EQ(traits.degrees_of_freedom, 2);
  EXPECT_NEAR(traits.position_resolution_m, 30e-6, 1e-12);
  EXPECT_EQ(traits.delay_samples, 2);
  EXPECT_EQ(traits.max_force_N, 1.5);
}

TEST(OpenDevice, ListsWhatItCanOpen) {
  const auto kinds = list_devices();
  ASSERT_GE(kinds.size(), 3U);
  for (const auto& kind : kinds) {
    EXPECT_NE(kind.url.find(':'), std::string::npos);
    EXPECT_EQ(kind.available, kind.note.empty()) << kind.url;
  }
}

TEST(SimulatedHand, PressesAButtonAtItsTimes) {
  const auto device =
      open_device("sim:?script=hold&button=3&button-at=0.1&button-for=0.05&button-every=0.2", {});
  ASSERT_TRUE(device);
  for (int tick = 0; tick < 700; ++tick) {
    const bool is_pressed = tick >= 100 && (tick - 100) % 200 < 50;
    // The sum of the periods may be a rounding before or after a tick.
    const bool is_edge = tick >= 100 && ((tick - 100) % 200 == 0 || (tick - 100) % 200 == 50);
    const std::uint32_t buttons = (*device)->read().buttons;
    EXPECT_TRUE(is_edge || buttons == (is_pressed ? 4U : 0U)) << tick;
    (*device)->write({});
  }
  EXPECT_EQ(error_of("sim:?button=33").code, ErrorCode::usage);
}

TEST(SimulatedHand, ReadsInStepsOfItsSensor) {
  HandOptions options;
  options.resolution_m = 50e-6;
  SimulatedHand hand(options);
  for (int i = 0; i < 500; ++i) {
    const Vec3 p = hand.read().position.v;
    EXPECT_NEAR(p.x, 50e-6 * std::round(p.x / 50e-6), 1e-12);
    EXPECT_LE(std::abs(p.z - hand.true_position_m().z), 25e-6 + 1e-12);
    hand.write({});
  }
}

TEST(SimulatedHand, FeelsAForceAfterItsDelay) {
  for (const int delay : {0, 1, 3, SimulatedHand::kMostDelay}) {
    HandOptions options;
    options.delay_samples = delay;
    options.script.kind = HandScriptOptions::Kind::hold;
    options.device_friction_N = 0.0;
    SimulatedHand hand(options);
    const double rest = hand.true_position_m().x;
    for (int i = 0; i < delay; ++i) {
      hand.write({{1.0, 0.0, 0.0}});
      EXPECT_EQ(hand.true_position_m().x, rest) << delay;
    }
    hand.write({});
    EXPECT_EQ(hand.true_position_m().x > rest, delay > 0) << delay;
  }
}

TEST(SimulatedHand, OscillatesAtTheFrequencyOfItsMassAndSpring) {
  // 0.25 kg on 100 N/m without damping: 20 rad/s, so a quarter of a swing takes 78.5 ms.
  HandOptions options;
  options.device_mass_kg = 0.25;
  options.arm_mass_kg = 0.0;
  options.device_damping_Ns_per_m = 0.0;
  options.arm_damping_Ns_per_m = 0.0;
  options.arm_stiffness_N_per_m = 100.0;
  options.device_friction_N = 0.0;
  options.script.kind = HandScriptOptions::Kind::hold;
  SimulatedHand hand(options);
  hand.place({0.01, 0.0, 0.0});
  hand.set_goal({});
  int crossing = 0;
  while (hand.true_position_m().x > 0.0 && crossing < 1000) {
    hand.write({});
    ++crossing;
  }
  EXPECT_NEAR(crossing, 79, 1);
}

TEST(SimulatedHand, StandsStillOnItsFriction) {
  HandOptions options;
  options.device_friction_N = 0.5;
  options.script.kind = HandScriptOptions::Kind::hold;
  SimulatedHand hand(options);
  const Vec3 rest = hand.true_position_m();
  for (int i = 0; i < 100; ++i) hand.write({{0.49, 0.0, 0.0}});
  EXPECT_EQ(hand.true_position_m(), rest);
  for (int i = 0; i < 100; ++i) hand.write({{0.8, 0.0, 0.0}});
  EXPECT_GT(hand.true_position_m().x, rest.x);
}

TEST(SimulatedHand, InThePlaneNeverLeavesIt) {
  HandOptions options;
  options.degrees_of_freedom = 2;
  options.script.deep = false;
  SimulatedHand hand(options);
  for (int i = 0; i < 2000; ++i) {
    EXPECT_EQ(hand.read().position.v.z, 0.0);
    hand.write({{0.1, 0.1, 5.0}});
  }
}

TEST(Pointer, IsNotReadyBeforeTheFirstPlaceAndStaleWhenThePageFallsSilent) {
  auto feed = std::make_shared<PointerFeed>();
  PointerDevice pointer(feed, 1000.0);
  EXPECT_EQ(pointer.read().status, Status::not_ready);
  feed->put({{0.01, 0.02, 0.0}});
  const auto first = pointer.read();
  EXPECT_EQ(first.status, Status::ok);
  EXPECT_NEAR(first.position.v.x, 0.01, 1e-15);
  for (int i = 0; i < 499; ++i) EXPECT_EQ(pointer.read().status, Status::ok);
  pointer.read();
  EXPECT_EQ(pointer.read().status, Status::stale);
  feed->put({{0.01, 0.02, 0.0}});
  EXPECT_EQ(pointer.read().status, Status::ok);
}

TEST(Pointer, InterpolatesBetweenTwoPositionsWithoutOvershoot) {
  auto feed = std::make_shared<PointerFeed>();
  PointerDevice pointer(feed, 1000.0);
  feed->put({{0.0, 0.0, 0.0}});
  pointer.read();
  feed->put({{0.005, 0.0, 0.0}});
  double before = 0.0;
  double fastest = 0.0;
  for (int i = 0; i < 200; ++i) {
    const double x = pointer.read().position.v.x;
    EXPECT_GE(x, before);
    EXPECT_LE(x, 0.005 + 1e-15);
    fastest = std::max(fastest, x - before);
    before = x;
  }
  EXPECT_NEAR(before, 0.005, 1e-6);
  EXPECT_LT(fastest, 0.0002);
}

TEST(Pointer, IsNotReadyOnceTakenAwayAndBeginsAtItsNextPlace) {
  auto feed = std::make_shared<PointerFeed>();
  PointerDevice pointer(feed, 1000.0);
  feed->put({{0.01, 0.0, 0.0}});
  EXPECT_EQ(pointer.read().status, Status::ok);
  feed->put({});
  EXPECT_EQ(pointer.read().status, Status::not_ready);
  EXPECT_EQ(pointer.read().status, Status::not_ready);
  feed->put({{-0.03, 0.0, 0.0}});
  const Reading again = pointer.read();
  EXPECT_EQ(again.status, Status::ok);
  EXPECT_NEAR(again.position.v.x, -0.03, 1e-15);
}

TEST(Pointer, IgnoresAPlaceThatIsNotFinite) {
  auto feed = std::make_shared<PointerFeed>();
  PointerDevice pointer(feed, 1000.0);
  feed->put({{0.01, 0.0, 0.0}});
  pointer.read();
  feed->put({{NAN, 0.0, 0.0}});
  EXPECT_NEAR(pointer.read().position.v.x, 0.01, 1e-15);
}

TEST(HoldWords, AreNotForADeviceThatIsNotThere) {
  EXPECT_EQ(hold_words("2diy:/dev/ttyTHEREISNONE"), "");
  EXPECT_NE(hold_words("2diy:/dev/null"), "");
  EXPECT_EQ(hold_words("sim:"), "");
}

TEST(Devices, NeverAllocateWhileTheyAreReadAndWritten) {
  ASSERT_TRUE(allocations_are_counted());
  auto feed = std::make_shared<PointerFeed>();
  OpenOptions options;
  options.pointer = feed;
  for (const auto* url : {"sim:", "sim:?script=random&delay=3", "pointer:"}) {
    auto device = open_device(url, options);
    ASSERT_TRUE(device);
    const AllocationScope scope;
    for (int i = 0; i < 1000; ++i) {
      feed->put({{0.0, 1e-5 * i, 0.0}});
      (*device)->read();
      (*device)->write({{0.0, 0.0, 0.1}});
    }
    (*device)->stop();
    EXPECT_EQ(scope.count(), 0U) << url;
  }
}

}  // namespace
}  // namespace palpable::device
