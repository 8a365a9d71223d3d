// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/device/inverse3/inverse3.hpp"

#include "palpable/core/system/allocations.hpp"
#include "palpable/device/drivers/open.hpp"
#include "palpable/device/virtual/virtual_inverse3.hpp"

#include <chrono>
#include <functional>
#include <thread>

#include <gtest/gtest.h>

namespace palpable::device {
namespace {

using InverseFault = VirtualInverse3::Fault;

Result<std::unique_ptr<Device>> opened(const VirtualInverse3& service, const std::string& options = {}) {
  return open_device("inverse3:?port=" + std::to_string(service.port()) + options, {});
}

/// Ticks of 1 ms with this force until the condition holds; false if it does not within ten seconds.
bool tick_until(Device& device, Vec3 force_N, const std::function<bool(const Reading&)>& holds) {
  for (int k = 0; k < 10'000; ++k) {
    const Reading reading = device.read();
    device.write({force_N});
    if (holds(reading)) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return false;
}

TEST(Inverse3Device, ReadsFromWhereTheHandleWasInOurAxes) {
  VirtualInverse3 service;
  const auto device = opened(service);
  ASSERT_TRUE(device) << device.error().sentence();
  EXPECT_EQ((*device)->traits().name, "Haply Inverse3 (its service's filters: gravity_compensation)");
  // To the right, away from the user, up.
  service.pull_to({0.03, 0.02, 0.01});
  EXPECT_TRUE(tick_until(**device, {}, [](const Reading& reading) {
    return reading.status == Status::ok && norm(reading.position.v - Vec3{0.03, 0.01, -0.02}) < 5e-5;
  }));
}

TEST(Inverse3Device, MakesTheForceThatIsWrittenWithBothFormsOfTheMessage) {
  for (const bool values : {false, true}) {
    VirtualInverse3::Options options;
    options.takes_values = values;
    VirtualInverse3 service(options);
    const auto device = opened(service);
    ASSERT_TRUE(device) << device.error().sentence();
    EXPECT_TRUE(tick_until(**device, {0.1, 0.2, 0.3}, [&](const Reading&) {
      return service.force_N() == Vec3{0.1, -0.3, 0.2};
    })) << values;
  }
}

TEST(Inverse3Device, NamesItselfInItsFirstMessageOnly) {
  VirtualInverse3 service;
  const auto device = opened(service, "&form=vector");
  ASSERT_TRUE(device);
  EXPECT_TRUE(tick_until(**device, {}, [&](const Reading&) { return service.messages() > 3; }));
  EXPECT_NE(service.first_message().find("Palpable"), std::string::npos);
  EXPECT_EQ(service.first_message().find("values"), std::string::npos);
  EXPECT_EQ(inverse3_command("0417", {}, Inverse3Form::both, false).find("session"), std::string::npos);
}

TEST(Inverse3Device, IsFreeWithoutTheServoAndAfterACutAndWhenItIsClosed) {
  VirtualInverse3 service;
  auto device = opened(service);
  ASSERT_TRUE(device);
  const auto pushes = [&](const Reading&) { return service.force_N() != Vec3{}; };
  const auto is_free = [&] {
    for (int k = 0; k < 10'000 && service.force_N() != Vec3{}; ++k)
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    return service.force_N() == Vec3{};
  };
  EXPECT_TRUE(tick_until(**device, {0.5, 0.0, 0.0}, pushes));
  EXPECT_TRUE(is_free());
  EXPECT_TRUE(tick_until(**device, {0.5, 0.0, 0.0}, pushes));
  (*device)->cut_force();
  EXPECT_TRUE(is_free());
  EXPECT_TRUE(tick_until(**device, {0.5, 0.0, 0.0}, pushes));
  device->reset();
  EXPECT_TRUE(is_free());
}

TEST(Inverse3Device, GetsNoForceBeforeItIsCalibrated) {
  VirtualInverse3::Options options;
  options.calibrated = false;
  VirtualInverse3 service(options);
  const auto device = opened(service);
  ASSERT_TRUE(device);
  EXPECT_TRUE(tick_until(**device, {0.5, 0.0, 0.0}, [&](const Reading& reading) {
    EXPECT_EQ(reading.status, Status::not_ready);
    return service.messages() > 50;
  }));
  EXPECT_EQ(service.force_N(), Vec3{});
  service.calibrate();
  EXPECT_TRUE(tick_until(**device, {0.5, 0.0, 0.0}, [&](const Reading& reading) {
    return reading.status == Status::ok && service.force_N() == Vec3{0.5, 0.0, 0.0};
  }));
}

class Inverse3WithAFault : public testing::TestWithParam<InverseFault> {};

TEST_P(Inverse3WithAFault, IsFreeAndHasFailedInTheEnd) {
  VirtualInverse3 service;
  const auto device = opened(service);
  ASSERT_TRUE(device);
  const Vec3 force{0.5, 0.0, 0.0};
  ASSERT_TRUE(tick_until(**device, force, [&](const Reading&) { return service.force_N() == force; }));
  service.inject(GetParam());
  EXPECT_TRUE(tick_until(**device, force, [&](const Reading& reading) {
    EXPECT_TRUE(is_finite(reading.position));
    return reading.status != Status::ok && service.force_N() == Vec3{};
  }));
  // A busy machine makes a healthy reading stale, too: free is what it must be once it has failed, and stay.
  EXPECT_TRUE(tick_until(**device, force, [&](const Reading& reading) {
    return reading.status == Status::fault && service.force_N() == Vec3{};
  }));
  int ticks_after = 0;
  EXPECT_TRUE(tick_until(**device, force, [&](const Reading&) {
    EXPECT_EQ(service.force_N(), Vec3{});
    return ++ticks_after == 50;
  }));
  EXPECT_FALSE((*device)->fault().empty());
}

INSTANTIATE_TEST_SUITE_P(Faults, Inverse3WithAFault,
                         testing::Values(InverseFault::silent, InverseFault::garbage,
                                         InverseFault::not_finite, InverseFault::nested, InverseFault::huge,
                                         InverseFault::far_away, InverseFault::no_device,
                                         InverseFault::closed));

TEST(Inverse3Device, IsNotThereWithoutAServiceOrADevice) {
  const auto nobody = open_device("inverse3:?port=1", {});
  EXPECT_EQ(nobody.error().code, ErrorCode::device);
  EXPECT_NE(nobody.error().message.find("does not run on port 1"), std::string::npos);
  VirtualInverse3::Options options;
  options.lists_a_device = false;
  VirtualInverse3 empty(options);
  EXPECT_EQ(opened(empty).error().message, "the service answers, but lists no Inverse3");
  VirtualInverse3 service;
  const auto other = open_device("inverse3:9999?port=" + std::to_string(service.port()), {});
  EXPECT_NE(other.error().message.find("9999"), std::string::npos);
  for (const auto* url : {"inverse3:?port=0", "inverse3:?form=json", "inverse3:?max-force=99"})
    EXPECT_EQ(open_device(url, {}).error().code, ErrorCode::usage) << url;
}

TEST(Inverse3Messages, AreRefusedIfTheyAreNoState) {
  for (const auto* text : {"", "null", "[]", "{\"inverse3\":{}}", "{\"inverse3\":[1,{\"device_id\":4}]}"})
    EXPECT_FALSE(parse_inverse3_state(text, "")) << text;
  const auto odd = parse_inverse3_state(
      R"({"inverse3":[{"device_id":"a","state":{"cursor_position":{"x":"1","y":0,"z":0}},"status":[],"config":7}]})",
      "a");
  ASSERT_TRUE(odd);
  EXPECT_FALSE(odd->position_m);
  EXPECT_FALSE(odd->calibrated);
}

TEST(Inverse3Device, NeitherAllocatesNorWaitsInATick) {
  ASSERT_TRUE(allocations_are_counted());
  VirtualInverse3 service;
  const auto device = opened(service);
  ASSERT_TRUE(device);
  // Allocations are counted for each thread; the driver's own may allocate.
  const AllocationScope scope;
  for (int k = 0; k < 1000; ++k) {
    (*device)->read();
    (*device)->write({{0.1, 0.0, 0.0}});
  }
  (*device)->stop();
  EXPECT_EQ(scope.count(), 0U);
}

}  // namespace
}  // namespace palpable::device
