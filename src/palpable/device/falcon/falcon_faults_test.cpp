// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/device/virtual/falcon_bench.hpp"

#include <cmath>
#include <random>

namespace palpable::device {
namespace {

/// Ticks after a fault until the touch goes on: the driver rests for 25 of them.
constexpr int kRests = 50;

using Fault = VirtualFalcon::Fault;

/// A Falcon that gets a fault at random instants while it pushes, and recovers each time.
class FalconWithAFault : public FalconBench, public testing::WithParamInterface<Fault> {
 protected:
  static constexpr Vec3 kPush_N{1.0, -0.5, 1.5};

  /// Time until the motors are free for good, from now and over `ticks`.
  double free_after_s(int count) {
    const double begin_s = falcon_->now_s();
    double free_s = begin_s;
    falcon_->on_step = [&] {
      if (!falcon_->is_free()) free_s = falcon_->now_s();
    };
    ticks(count, kPush_N);
    falcon_->on_step = nullptr;
    return free_s - begin_s;
  }
};

TEST_P(FalconWithAFault, IsFreeWithinTenMillisecondsAndPushesAgainAfterwards) {
  // Other instants in each repetition with --gtest_shuffle.
  const int seed = testing::UnitTest::GetInstance()->random_seed();
  std::mt19937 random(static_cast<unsigned>(100 * seed) + static_cast<unsigned>(GetParam()));
  constexpr int kTimes = 200;
  open();
  for (int time = 0; time < kTimes; ++time) {
    ticks(10, kPush_N);
    ticks(static_cast<int>(random() % 10), kPush_N);
    ASSERT_FALSE(falcon_->is_free()) << time;
    // Between two ticks.
    UsbTransfers::Packet lost{};
    falcon_->plug_in()->receive(lost, 1e-4 * static_cast<double>(random() % 10));
    falcon_->inject(GetParam());
    ASSERT_LE(free_after_s(20), 0.010) << time;
    EXPECT_NE(device_->read().status, Status::ok);
    falcon_->inject(Fault::none);
    EXPECT_EQ(ticks(kRests).status, Status::ok);
  }
}

INSTANTIATE_TEST_SUITE_P(Faults, FalconWithAFault,
                         testing::Values(Fault::silent, Fault::garbage, Fault::short_packets,
                                         Fault::wrong_calibration));

using FalconFaults = FalconBench;

TEST_F(FalconFaults, UnpluggedItHasFailedWithASentence) {
  open();
  ticks(20, {1.0, 0.0, 0.0});
  falcon_->inject(Fault::unplugged);
  EXPECT_EQ(ticks(2).status, Status::fault);
  EXPECT_EQ(device_->fault(), "the Falcon was unplugged");
}

TEST_F(FalconFaults, AfterAStallOfTheLineTheFirstCommandIsZero) {
  open();
  for (int length = 10; length < 600; length += 100) {
    ticks(20, {1.0, 0.0, 0.0});
    falcon_->inject(Fault::stalled);
    EXPECT_EQ(ticks(length, {1.0, 0.0, 0.0}).status, length > 500 ? Status::fault : Status::stale);
    falcon_->inject(Fault::none);
    const auto before = falcon_->commands();
    int first = 1;
    falcon_->on_step = [&] {
      if (falcon_->commands() == before + 1) first = std::abs(falcon_->motors()[0]);
    };
    EXPECT_EQ(ticks(kRests, {1.0, 0.0, 0.0}).status, Status::ok);
    falcon_->on_step = nullptr;
    EXPECT_EQ(first, 0) << length;
  }
}

TEST_F(FalconFaults, WithDroppedAndReorderedRepliesItStaysWithinItsForce) {
  open();
  for (const Fault fault : {Fault::dropped, Fault::reordered}) {
    falcon_->inject(fault);
    double most_N = 0.0;
    falcon_->on_step = [&] { most_N = std::fmax(most_N, norm(falcon_->force_N())); };
    EXPECT_EQ(ticks(200, {0.0, 0.0, 1.0}).status, Status::ok);
    falcon_->on_step = nullptr;
    EXPECT_GT(most_N, 0.5);
    EXPECT_LT(most_N, 1.1);
  }
}

TEST_F(FalconFaults, AStuckEncoderIsNoticedBeforeTheHandHasGoneFiveCentimetres) {
  open();
  const Vec3 corner{0.02, 0.02, 0.02};
  falcon_->pull_to(falcon::kCentre_m - corner);
  ticks(1000, {0.2, 0.0, 0.0});
  const Vec3 begin = falcon_->grip_m();
  falcon_->inject(Fault::stuck_encoder);
  falcon_->pull_to(falcon::kCentre_m + corner);
  Reading reading;
  int count = 0;
  do {
    reading = ticks(1, {0.2, 0.0, 0.0});
  } while (reading.status == Status::ok && ++count < 2000);
  EXPECT_EQ(reading.status, Status::fault);
  EXPECT_LT(norm(falcon_->grip_m() - begin), 0.05);
  EXPECT_NE(device_->fault().find("encoder is stuck"), std::string::npos);
  ticks(10, {0.2, 0.0, 0.0});
  EXPECT_TRUE(falcon_->is_free());
}

TEST_F(FalconFaults, AHandThatExploresIsNeverTakenForAStuckEncoder) {
  open();
  std::mt19937 random(3);
  std::uniform_real_distribution<double> part(-0.5, 0.5);
  for (int k = 0; k < 60; ++k) {
    const Vec3 size = falcon::kWorkspace_m;
    const double x = size.x * part(random), y = size.y * part(random), z = size.z * part(random);
    falcon_->pull_to(falcon::kCentre_m + Vec3{x, y, z});
    ASSERT_EQ(ticks(150, {0.1, 0.0, 0.0}).status, Status::ok) << k;
  }
}

}  // namespace
}  // namespace palpable::device
