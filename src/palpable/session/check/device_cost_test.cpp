// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// What a driver costs in each tick: no allocation, and the processor time that is printed.
#include "palpable/core/system/allocations.hpp"
#include "palpable/device/inverse3/inverse3_messages.hpp"
#include "palpable/session/check/hosted_bench.hpp"

#include <algorithm>
#include <ctime>
#include <iostream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace palpable::session {
namespace {

/// Processor time of this thread.
double thread_us() {
  timespec now{};
  ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return 1e6 * static_cast<double>(now.tv_sec) + 1e-3 * static_cast<double>(now.tv_nsec);
}

/// The median, and the value that one of a hundred exceeds.
std::string in_words(std::vector<double> values_us) {
  std::sort(values_us.begin(), values_us.end());
  return std::to_string(values_us[values_us.size() / 2]) + " us (median), " +
         std::to_string(values_us[values_us.size() * 99 / 100]) + " us (p99)\n";
}

struct CostCase {
  const char* name;
  DriverBench (*bench)(const OnForce&);
};

class DriverCost : public testing::TestWithParam<CostCase> {};

TEST_P(DriverCost, AllocatesNothingInATick) {
  ASSERT_TRUE(allocations_are_counted());
  constexpr int kTicks = 1000;
  const DriverBench bench = GetParam().bench({});
  auto opened = bench.open();
  ASSERT_TRUE(opened) << opened.error().sentence();
  device::Device& device = **opened;
  std::vector<double> took_us;
  took_us.reserve(kTicks);
  std::uint64_t allocations = 0;
  for (int k = 0; k < kTicks; ++k) {
    const AllocationScope scope;
    const double begun_us = thread_us();
    device.read();
    device.write({{0.1, 0.1, 0.1}});
    took_us.push_back(thread_us() - begun_us);
    allocations += scope.count();
    bench.pass_tick();
  }
  EXPECT_EQ(allocations, 0U);
  std::cout << GetParam().name << ": " << in_words(std::move(took_us));
}

INSTANTIATE_TEST_SUITE_P(
    Drivers, DriverCost,
    testing::Values(CostCase{"two_diy", two_diy_bench}, CostCase{"inverse3", inverse3_bench},
                    CostCase{"force_dimension", force_dimension_bench},
                    CostCase{"open_haptics",
                             [](const OnForce& on_force) { return open_haptics_bench(on_force); }},
                    CostCase{"hosted", hosted_force_dimension_bench}, CostCase{"evdev", evdev_bench}),
    [](const testing::TestParamInfo<CostCase>& tested) { return std::string(tested.param.name); });

TEST(Inverse3Cost, OfItsThreadIsThatOfItsMessages) {
  const std::string state =
      R"({"session_id":3,"inverse3":[{"device_id":"0417","state":{"cursor_position":{"x":0.0123,"y":-0.1204,"z":0.1811},)"
      R"("cursor_velocity":{"x":0.001,"y":0.002,"z":-0.01},"current_cursor_force":{"x":0.1,"y":0.2,"z":0.3}},)"
      R"("status":{"calibrated":true,"ready":true,"in_use":true,"power_supply":true,"started":true}}]})";
  constexpr int kMessages = 2000;
  std::vector<double> took_us;
  for (int k = 0; k < kMessages; ++k) {
    const double begun_us = thread_us();
    const auto parsed = device::parse_inverse3_state(state, "0417");
    const auto command =
        device::inverse3_command("0417", {0.001 * k, 0.2, -0.3}, device::Inverse3Form::both, false);
    took_us.push_back(thread_us() - begun_us);
    ASSERT_TRUE(parsed && parsed->position_m && !command.empty());
  }
  std::cout << "inverse3's thread: " << in_words(std::move(took_us));
}

}  // namespace
}  // namespace palpable::session
