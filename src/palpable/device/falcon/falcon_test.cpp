// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/device/falcon/falcon.hpp"

#include "palpable/core/system/allocations.hpp"
#include "palpable/device/drivers/open.hpp"
#include "palpable/device/falcon/falcon_firmware.hpp"
#include "palpable/device/virtual/falcon_bench.hpp"

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <random>

namespace palpable::device {
namespace {

using FalconDevice = FalconBench;

TEST_F(FalconDevice, ReadsWhereItsGripIsToOneCount) {
  open();
  falcon_->pull_to(falcon::kCentre_m + Vec3{0.02, -0.01, 0.015});
  const Reading reading = ticks(1500);
  EXPECT_EQ(reading.status, Status::ok);
  EXPECT_LT(norm(reading.position.v + falcon::kCentre_m - falcon_->grip_m()),
            2.0 * device_->traits().position_resolution_m);
  falcon_->press(0b0101);
  EXPECT_EQ(ticks(5).buttons, 0b0101U);
}

TEST_F(FalconDevice, MakesTheForceThatIsWrittenToItsLastStep) {
  open();
  for (const Vec3 force : {Vec3{1.0, 0.0, 0.0}, Vec3{0.0, -2.0, 0.0}, Vec3{0.4, 0.5, 1.9}}) {
    ticks(6, force);
    // A step is 0.1 mN m, on levers of 60 to 100 mm; a count that changed meanwhile adds a little.
    EXPECT_LT(norm(falcon_->force_N() - force), 0.01);
  }
}

TEST_F(FalconDevice, KeepsTheDirectionAtTheLimitOfItsMotors) {
  open();
  ticks(6, {60.0, 80.0, 0.0});
  int most = 0;
  for (const int word : falcon_->motors()) most = std::max(most, std::abs(word));
  EXPECT_EQ(most, 4095);
  EXPECT_NEAR(falcon_->force_N().x / falcon_->force_N().y, 0.75, 0.02);
  EXPECT_GT(device_->traits().max_force_N, 3.5);
}

TEST_F(FalconDevice, GetsNoForceBeforeItsArmsAreHomedAndSaysHow) {
  VirtualFalcon::Options lost;
  lost.homed = false;
  falcon_ = std::make_unique<VirtualFalcon>(lost);
  open();
  bool was_free = true;
  falcon_->on_step = [&] { was_free = was_free && falcon_->is_free(); };
  EXPECT_EQ(ticks(100, {1.0, 1.0, 1.0}).status, Status::not_ready);
  EXPECT_TRUE(was_free);
  EXPECT_EQ(falcon_->lights(), 0x09);
  EXPECT_NE(device_->guidance().find("Pull the grip"), std::string::npos);
  falcon_->on_step = nullptr;
  falcon_->home();
  EXPECT_EQ(ticks(10, {1.0, 0.0, 0.0}).status, Status::ok);
  EXPECT_EQ(falcon_->lights(), 0x02);
  EXPECT_FALSE(falcon_->is_free());
  EXPECT_TRUE(device_->guidance().empty());
}

TEST_F(FalconDevice, FreesItsMotorsWhenItIsStoppedLeftAloneAndClosed) {
  open();
  ticks(6, {1.0, 0.0, 0.0});
  EXPECT_FALSE(falcon_->is_free());
  device_->stop();
  device_->read();
  device_->read();
  EXPECT_TRUE(falcon_->is_free());
  ticks(6, {1.0, 0.0, 0.0});
  EXPECT_FALSE(falcon_->is_free());
  // The servo hangs: only the driver's thread goes on.
  for (int k = 0; k < 8; ++k) device_->read();
  EXPECT_TRUE(falcon_->is_free());
  ticks(6, {1.0, 0.0, 0.0});
  device_.reset();
  EXPECT_TRUE(falcon_->is_free());
  EXPECT_EQ(falcon_->strange_bytes(), 0U);
}

TEST_F(FalconDevice, ExchangesPacketsInAThreadOfItsOwn) {
  auto opened = Falcon::open(falcon_->plug_in(), {});
  ASSERT_TRUE(opened);
  (*opened)->write({{1.0, 0.0, 0.0}});
  opened->reset();
  EXPECT_TRUE(falcon_->is_free());
}

TEST_F(FalconDevice, AllocatesNothingInATick) {
  open();
  // The virtual one allocates for its bytes.
  FalconLink link(*falcon_->plug_in());
  device_->read();
  const AllocationScope scope;
  for (int k = 0; k < 100; ++k) device_->write({{0.1, 0.0, 0.0}});
  EXPECT_EQ(scope.count(), 0U);
}

class FalconFirmware : public FalconBench {
 protected:
  void SetUp() override {
    std::mt19937 random(5);
    for (int k = 0; k < 1000; ++k) needs_.firmware.push_back(static_cast<std::byte>(random() & 0xFFU));
    needs_.firmware_runs = false;
    write(needs_.firmware);
  }
  void write(const std::vector<std::byte>& image) {
    std::ofstream(file_, std::ios::binary)
        .write(reinterpret_cast<const char*>(image.data()), static_cast<std::streamsize>(image.size()));
  }
  std::string error_of(const VirtualFalcon::Options& options, const std::string& file) {
    falcon_ = std::make_unique<VirtualFalcon>(options);
    const auto opened = Falcon::open(falcon_->plug_in(), stepped(file));
    return opened ? "" : opened.error().sentence();
  }
  VirtualFalcon::Options needs_;
  std::string file_ = testing::TempDir() + "falcon.bin";
};

TEST_F(FalconFirmware, IsLoadedFromTheUsersFile) {
  EXPECT_EQ(error_of(needs_, file_), "");
  EXPECT_EQ(falcon_->loaded(), needs_.firmware);
  // Once is not enough to give up.
  needs_.wrong_echoes = 1;
  EXPECT_EQ(error_of(needs_, file_), "");
}

TEST_F(FalconFirmware, ThatIsMissingOrWrongIsNamedInOneSentence) {
  const auto holds = [](const std::string& text, const char* part) {
    EXPECT_NE(text.find(part), std::string::npos) << text;
  };
  holds(error_of(needs_, ""), "falcon:?firmware=FILE");
  holds(error_of(needs_, "/nowhere/falcon.bin"), "is not there");
  auto silent = needs_;
  silent.boots = false;
  holds(error_of(silent, file_), "boot program does not answer");
  auto noisy = needs_;
  noisy.wrong_echoes = 1000;
  holds(error_of(noisy, file_), "came back changed");
  auto damaged = needs_.firmware;
  damaged[500] ^= std::byte{4};
  write(damaged);
  holds(error_of(needs_, file_), "may be damaged");
  write({});
  holds(error_of(needs_, file_), "is no firmware");
}

TEST_F(FalconFirmware, IsNeverStartedAfterAWrongEchoOfAnyBlock) {
  // As many as PALPABLE_FAULTS says.
  const char* wanted = std::getenv("PALPABLE_FAULTS");
  const int times = wanted != nullptr ? std::atoi(wanted) : 6;
  std::mt19937 random(29);
  int loaded = 0;
  for (int time = 0; time < times; ++time) {
    auto options = needs_;
    options.good_echoes = static_cast<int>(random() % 17);
    // Up to more than it is tried again.
    options.wrong_echoes = 1 + static_cast<int>(random() % 12);
    const std::string error = error_of(options, file_);
    ASSERT_TRUE(error.empty() || error.find("came back changed") != std::string::npos) << error;
    ASSERT_TRUE(!error.empty() || falcon_->loaded() == needs_.firmware) << time;
    ASSERT_TRUE(falcon_->is_free());
    loaded += error.empty() ? 1 : 0;
  }
  EXPECT_GT(loaded, 0);
  EXPECT_LT(loaded, times);
}

TEST(OpenFalcon, NamesWhatIsWrong) {
  const auto error = [](const char* url) { return open_device(url, {}).error(); };
  EXPECT_EQ(error("falcon:16").code, ErrorCode::usage);
  EXPECT_EQ(error("falcon:x").code, ErrorCode::usage);
  EXPECT_EQ(error("falcon:?firmwre=x").code, ErrorCode::usage);
  // Nor is there one here.
  EXPECT_EQ(error("falcon:9").code, ErrorCode::device);
}

TEST(FalconWire, HasTheLeastSignificantNibbleFirst) {
  FalconCommand command;
  command.motors = {0x0123, -1, -5000};
  command.lights = FalconCommand::kHoming | FalconCommand::kRed;
  const auto packet = falcon_packet(command);
  std::string text;
  for (const std::byte byte : packet) text += static_cast<char>(byte);
  // -4095 is F001.
  EXPECT_EQ(text, "<DCBAPPPPBAAPJA>");
}

TEST(FalconWire, FindsRepliesInPiecesAndAmongOtherBytes) {
  const std::string text = "<<ABDCBAPPPPBAAPxA><DCBAPPPPAAAIFA>";
  FalconReplies replies;
  std::optional<FalconReply> found;
  for (const char c : text) {
    const std::byte byte{static_cast<unsigned char>(c)};
    if (const auto reply = replies.take({&byte, 1})) found = reply;
  }
  ASSERT_TRUE(found);
  EXPECT_EQ(found->counts, (std::array{0x0123, -1, -32768}));
  EXPECT_EQ(found->buttons(), 5U);
  EXPECT_FALSE(found->is_homed());
}

}  // namespace
}  // namespace palpable::device
