// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/device/falcon/falcon_link.hpp"
#include "palpable/device/virtual/virtual_falcon.hpp"

#include <cstdint>
#include <cstdlib>
#include <memory>
#include <random>

#include <gtest/gtest.h>

namespace palpable::device {
namespace {

/// Strokes along a spring wall at the Falcon's rate, in simulated time.
class FalconWall : public testing::Test {
 protected:
  FalconWall() {
    usb_->control(3, 2);
    usb_->control(9, 1);
  }
  void stroke() {
    std::uniform_real_distribution<double> part(-0.5, 0.5);
    const double x = 0.06 * part(random_), y = 0.06 * part(random_), z = 0.05 * part(random_);
    falcon_.pull_to(falcon::kCentre_m + Vec3{x, y, z});
    for (int tick = 0; tick < 400; ++tick) {
      for (next_s_ += 0.001; falcon_.now_s() < next_s_;) link_.exchange();
      push();
    }
  }

  VirtualFalcon falcon_;
  std::unique_ptr<UsbTransfers> usb_ = falcon_.plug_in();
  FalconLink link_{*usb_};
  std::uint64_t pushed_ = 0;

 private:
  void push() {
    FalconLink::State state;
    link_.states.take(state);
    const Vec3 place = state.place_m - falcon::kCentre_m;
    const Vec3 force = place.z < 0.0 ? Vec3{-20.0 * place.x, -20.0 * place.y, -800.0 * place.z} : Vec3{};
    const double size = norm(force);
    link_.forces.put(size > kMost_N ? (kMost_N / size) * force : force);
    pushed_ += norm(force) > 0.0 ? 1U : 0U;
  }
  static constexpr double kMost_N = 3.9;
  std::mt19937 random_{3};
  double next_s_ = 0.0;
};

TEST_F(FalconWall, NoArmThatIsHeldToACountIsTakenForAStuckEncoder) {
  // 1500 are ten minutes, as many as PALPABLE_FALCON_STROKES says.
  const char* wanted = std::getenv("PALPABLE_FALCON_STROKES");
  const int strokes = wanted != nullptr ? std::atoi(wanted) : 50;
  for (int k = 0; k < strokes; ++k) {
    stroke();
    ASSERT_FALSE(link_.is_stuck()) << k;
  }
  EXPECT_GT(pushed_, static_cast<std::uint64_t>(100 * strokes));
}

}  // namespace
}  // namespace palpable::device
