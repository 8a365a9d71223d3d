// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/device/two_diy/two_diy.hpp"

#include "palpable/core/system/allocations.hpp"
#include "palpable/device/drivers/open.hpp"
#include "palpable/device/virtual/virtual_two_diy.hpp"

#include <array>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <functional>
#include <random>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <fcntl.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <termios.h>
#include <unistd.h>

namespace palpable::device {
namespace {

using Fault = VirtualTwoDiy::Fault;

std::unique_ptr<TwoDiy> opened(const VirtualTwoDiy& board, const TwoDiyVariant& variant) {
  auto device = TwoDiy::open(board.path(), variant, 1000.0);
  EXPECT_TRUE(device) << (device ? "" : device.error().sentence());
  return device ? *std::move(device) : nullptr;
}

/// One tick, paced by the board's answers instead of the clock.
Reading tick(TwoDiy& device, const VirtualTwoDiy& board, Vec3 force_N) {
  const Reading reading = device.read();
  const auto before = board.messages();
  device.write({force_N});
  board.wait_for(before + 1);
  return reading;
}

bool motors_are_free(const VirtualTwoDiy& board) { return board.torques() == std::array{0.0F, 0.0F}; }

class EachTwoDiy : public testing::TestWithParam<TwoDiyVariant> {
 protected:
  /// Goes from home to the middle of the workspace.
  void go_to_the_middle() {
    for (int k = 0; k < 1500; ++k) tick(*device_, board_, {});
  }
  VirtualTwoDiy board_{GetParam()};
  std::unique_ptr<TwoDiy> device_ = opened(board_, GetParam());
};

TEST_P(EachTwoDiy, ReadsWhereTheHandleIs) {
  go_to_the_middle();
  // Away from the middle to the right and away from the user: both axes of the pantograph point the other
  // way.
  board_.pull_to({GetParam().centre.x - 0.02, GetParam().centre.y - 0.01});
  Reading reading;
  for (int k = 0; k < 3000; ++k) reading = tick(*device_, board_, {});
  EXPECT_EQ(reading.status, Status::ok);
  EXPECT_NEAR(reading.position.v.x, 0.02, 1e-6);
  EXPECT_NEAR(reading.position.v.y, 0.01, 1e-6);
  EXPECT_EQ(reading.position.v.z, 0.0);
}

TEST_P(EachTwoDiy, MakesTheForceThatIsWritten) {
  go_to_the_middle();
  for (const Vec3 force : {Vec3{1.0, 0.0, 0.0}, Vec3{0.0, -0.7, 0.0}, Vec3{-0.4, 0.5, 0.9}}) {
    tick(*device_, board_, force);
    // The next torques are those of the angles that answered the last ones.
    tick(*device_, board_, force);
    const InPlane made = board_.force_N();
    EXPECT_NEAR(made.x, -GetParam().torque_gain * force.x, 0.002);
    EXPECT_NEAR(made.y, -GetParam().torque_gain * force.y, 0.002);
  }
}

TEST_P(EachTwoDiy, NeverExceedsTheTorqueOfItsMotorsAndKeepsTheDirection) {
  go_to_the_middle();
  tick(*device_, board_, {});
  tick(*device_, board_, {30.0, 40.0, 0.0});
  const auto torques = board_.torques();
  const double most = std::max(std::abs(torques[0]), std::abs(torques[1]));
  EXPECT_NEAR(most, GetParam().torque_gain * kTwoDiyMaxTorque_Nm, 1e-6);
  const InPlane made = board_.force_N();
  EXPECT_NEAR(made.x / made.y, 0.75, 0.01);
  // What its traits promise is held everywhere in the workspace.
  EXPECT_GT(device_->traits().max_force_N, 1.0);
}

INSTANTIATE_TEST_SUITE_P(Variants, EachTwoDiy, testing::ValuesIn(kTwoDiyVariants),
                         [](const auto& tested) { return std::string(tested.param.name); });

class TwoDiyOnALine : public testing::Test {
 protected:
  VirtualTwoDiy board_{kTwoDiyVariants[0]};
};

TEST_F(TwoDiyOnALine, IsSetUpByTheBytesOfItsVariant) {
  const auto device = opened(board_, kTwoDiyVariants[0]);
  const auto sent = setup_message(kTwoDiyVariants[0]);
  const auto received = board_.setup();
  ASSERT_EQ(received.size(), sent.size());
  for (std::size_t k = 0; k < sent.size(); ++k)
    EXPECT_EQ(received[k], std::to_integer<std::uint8_t>(sent[k]));
}

TEST_F(TwoDiyOnALine, IsReadByTheNumbersOfItsMotorsWhereTheBoardAnswersByThese) {
  VirtualTwoDiy other(kTwoDiyVariants[1], true);
  const auto device = opened(other, kTwoDiyVariants[1]);
  for (int k = 0; k < 1500; ++k) tick(*device, other, {});
  EXPECT_NEAR(device->read().position.v.x, 0.0, 1e-4);
  tick(*device, other, {0.5, 0.0, 0.0});
  tick(*device, other, {0.5, 0.0, 0.0});
  EXPECT_NEAR(other.force_N().x, -0.5, 0.002);
}

TEST_F(TwoDiyOnALine, FreesItsMotorsWhenItIsClosedAndWhenItIsStopped) {
  auto device = opened(board_, kTwoDiyVariants[0]);
  for (int k = 0; k < 1500; ++k) tick(*device, board_, {0.2, 0.2, 0.0});
  EXPECT_FALSE(motors_are_free(board_));
  auto messages = board_.messages();
  device->stop();
  board_.wait_for(messages + 1);
  EXPECT_TRUE(motors_are_free(board_));
  tick(*device, board_, {0.2, 0.2, 0.0});
  tick(*device, board_, {0.2, 0.2, 0.0});
  EXPECT_FALSE(motors_are_free(board_));
  messages = board_.messages();
  device.reset();
  board_.wait_for(messages + 1);
  EXPECT_TRUE(motors_are_free(board_));
}

/// A serial port with something behind it that is no board. `answer` gets what arrives (also nothing, every
/// other millisecond) and returns what is sent.
class OtherPort {
 public:
  using Bytes = std::vector<std::uint8_t>;
  using Answer = std::function<Bytes(const Bytes&)>;

  explicit OtherPort(Answer answer)
      : terminal_(::posix_openpt(O_RDWR | O_NOCTTY | O_CLOEXEC | O_NONBLOCK)), answer_(std::move(answer)) {
    ::grantpt(terminal_.number());
    ::unlockpt(terminal_.number());
    std::array<char, 64> name{};
    ::ptsname_r(terminal_.number(), name.data(), name.size());
    path_ = name.data();
    thread_ = std::thread([this] {
      while (!ends_) {
        pollfd waits{terminal_.number(), POLLIN, 0};
        ::poll(&waits, 1, 2);
        Bytes bytes(256);
        const auto count = ::read(terminal_.number(), bytes.data(), bytes.size());
        bytes.resize(count > 0 ? static_cast<std::size_t>(count) : 0);
        const Bytes sent = answer_(bytes);
        // What does not fit is lost, as on a real line.
        if (!sent.empty() && ::write(terminal_.number(), sent.data(), sent.size()) < 0) continue;
      }
    });
  }
  ~OtherPort() {
    ends_ = true;
    thread_.join();
  }
  OtherPort(const OtherPort&) = delete;
  OtherPort& operator=(const OtherPort&) = delete;
  const std::string& path() const { return path_; }

 private:
  Descriptor terminal_;
  Answer answer_;
  std::string path_;
  std::atomic<bool> ends_{false};
  std::thread thread_;
};

void expect_refused(const OtherPort::Answer& answer) {
  for (const TwoDiyVariant& variant : kTwoDiyVariants) {
    const OtherPort port(answer);
    const auto device = TwoDiy::open(port.path(), variant, 1000.0);
    ASSERT_FALSE(device) << variant.name;
    EXPECT_NE(device.error().message.find("does not answer as a 2DIY"), std::string::npos);
  }
}

/// An answer with the angles at home, in the order of the ports; or with both links opened farther.
OtherPort::Bytes home_answer(const TwoDiyVariant& variant, float opened_deg = 0.0F) {
  std::array<float, 2> angles{variant.joints[0].home_deg, variant.joints[1].home_deg};
  const std::size_t wider = angles[0] > angles[1] ? 0 : 1;
  angles[wider] += opened_deg;
  angles[1 - wider] -= opened_deg;
  if (variant.joints[0].port != 1) std::swap(angles[0], angles[1]);
  OtherPort::Bytes bytes(TwoDiyAnswers::kLength, kTwoDiyId);
  std::memcpy(bytes.data() + 1, angles.data(), sizeof angles);
  return bytes;
}

bool asks_for_angles(const OtherPort::Bytes& received) {
  return received.size() == torque_message({}).size();
}

TEST(TwoDiyPort, IsRefusedIfItOnlyEchoes) {
  expect_refused([](const OtherPort::Bytes& received) { return received; });
}

TEST(TwoDiyPort, HasItsSettingsBackWhenItIsClosed) {
  OtherPort port([](const OtherPort::Bytes&) { return OtherPort::Bytes{}; });
  // Held open, since a terminal that nobody has open forgets its settings.
  const Descriptor held(::open(port.path().c_str(), O_RDWR | O_NOCTTY | O_CLOEXEC));
  const auto echoes = [&held] {
    termios settings{};
    EXPECT_EQ(::tcgetattr(held.number(), &settings), 0);
    return (settings.c_lflag & ECHO) != 0;
  };
  ASSERT_TRUE(echoes());
  {
    const auto line = SerialPort::open(port.path());
    ASSERT_TRUE(line);
    EXPECT_FALSE(echoes());
  }
  EXPECT_TRUE(echoes());
}

TEST(TwoDiyPort, IsRefusedIfItSendsRandomBytesAllTheTime) {
  for (const unsigned seed : {1U, 2U, 3U})
    expect_refused([random = std::mt19937(seed)](const OtherPort::Bytes&) mutable {
      OtherPort::Bytes bytes(1000);
      for (auto& byte : bytes) byte = static_cast<std::uint8_t>(random() & 0xFFU);
      return bytes;
    });
}

TEST(TwoDiyPort, IsRefusedIfItSendsZerosOrAnswersAllTheTime) {
  expect_refused([](const OtherPort::Bytes&) { return OtherPort::Bytes(500); });
  for (const TwoDiyVariant& variant : kTwoDiyVariants)
    expect_refused([&variant](const OtherPort::Bytes&) { return home_answer(variant); });
}

TEST(TwoDiyPort, IsRefusedIfItAnswersOnceOrTwiceAtATimeOrByRandomAngles) {
  const TwoDiyVariant& variant = kTwoDiyVariants[0];
  int asked = 0;
  expect_refused([&](const OtherPort::Bytes& received) {
    return asks_for_angles(received) && asked++ == 0 ? home_answer(variant) : OtherPort::Bytes();
  });
  expect_refused([&](const OtherPort::Bytes& received) {
    auto bytes = home_answer(variant);
    bytes.insert(bytes.end(), bytes.begin(), bytes.end());
    return asks_for_angles(received) ? bytes : OtherPort::Bytes();
  });
  expect_refused([&, random = std::mt19937(5)](const OtherPort::Bytes& received) mutable {
    auto bytes = home_answer(variant);
    for (std::size_t k = 1; k < bytes.size(); ++k) bytes[k] = static_cast<std::uint8_t>(random() & 0xFFU);
    return asks_for_angles(received) ? bytes : OtherPort::Bytes();
  });
}

TEST(TwoDiyPort, IsABoardIfItAnswersByTheAnglesAtHome) {
  const TwoDiyVariant& variant = kTwoDiyVariants[0];
  // Also one that says something when it is plugged in.
  const OtherPort port([&, greeted = false](const OtherPort::Bytes& received) mutable {
    if (!std::exchange(greeted, true)) return OtherPort::Bytes{'h', 'e', 'l', 'l', 'o'};
    return asks_for_angles(received) ? home_answer(variant) : OtherPort::Bytes();
  });
  EXPECT_TRUE(TwoDiy::open(port.path(), variant, 1000.0));
}

TEST(TwoDiyPort, IsABoardIfItsHandleWasMovedFromHome) {
  const TwoDiyVariant& variant = kTwoDiyVariants[0];
  const OtherPort port([&](const OtherPort::Bytes& received) {
    return asks_for_angles(received) ? home_answer(variant, 30.0F) : OtherPort::Bytes();
  });
  EXPECT_TRUE(TwoDiy::open(port.path(), variant, 1000.0));
}

/// A board that gets this fault at a random instant while it pushes.
class TwoDiyWithAFault : public testing::TestWithParam<Fault> {};

TEST_P(TwoDiyWithAFault, IsFreeWithinTenTicksAndHasFailedAfterHalfASecond) {
  std::mt19937 random(static_cast<unsigned>(GetParam()));
  constexpr int kTimes = 3;
  for (int time = 0; time < kTimes; ++time) {
    VirtualTwoDiy board(kTwoDiyVariants[0]);
    const auto device = opened(board, kTwoDiyVariants[0]);
    ASSERT_NE(device, nullptr);
    const int until = 1000 + static_cast<int>(random() % 500);
    for (int k = 0; k < until; ++k) tick(*device, board, {0.3, 0.3, 0.0});
    ASSERT_FALSE(motors_are_free(board));
    board.inject(GetParam());
    Reading reading;
    const auto push = [&](int ticks) {
      for (int k = 0; k < ticks; ++k) {
        reading = device->read();
        device->write({{0.3, 0.3, 0.0}});
      }
    };
    push(10);
    EXPECT_NE(reading.status, Status::ok);
    // It takes commands although its answers are bad.
    EXPECT_TRUE(board.wait_until_free());
    push(600);
    EXPECT_TRUE(motors_are_free(board));
    EXPECT_EQ(reading.status, Status::fault);
    EXPECT_FALSE(device->fault().empty());
  }
}

INSTANTIATE_TEST_SUITE_P(Faults, TwoDiyWithAFault,
                         testing::Values(Fault::silent, Fault::garbage, Fault::cut_answers,
                                         Fault::not_finite));

/// Strokes between places all over the workspace; how many ticks until the device fails.
int ticks_to_a_fault(TwoDiy& device, VirtualTwoDiy& board, int strokes) {
  constexpr int kStroke = 400;
  std::mt19937 random(5);
  std::uniform_real_distribution<double> part(-0.45, 0.45);
  const TwoDiyVariant& variant = kTwoDiyVariants[0];
  for (int k = 0; k < strokes * kStroke; ++k) {
    if (k % kStroke == 0)
      board.pull_to({variant.centre.x + variant.size.x * part(random),
                     variant.centre.y + variant.size.y * part(random)});
    if (tick(device, board, {0.2, 0.1, 0.0}).status == Status::fault) return k;
  }
  return strokes * kStroke;
}

TEST_F(TwoDiyOnALine, DoesNotTakeAnArcAboutAnElbowForAStuckEncoder) {
  // Both give the same angles: one that stays, and another that turns.
  const auto device = opened(board_, kTwoDiyVariants[0]);
  constexpr int kStrokes = 10;
  board_.inject(Fault::stuck_encoder);
  EXPECT_EQ(ticks_to_a_fault(*device, board_, kStrokes), kStrokes * 400);
}

TEST_F(TwoDiyOnALine, FreesItsMotorsByTheClockWhereTheServoIsLate) {
  const auto device = opened(board_, kTwoDiyVariants[0]);
  for (int k = 0; k < 1500; ++k) tick(*device, board_, {0.3, 0.3, 0.0});
  board_.inject(Fault::silent);
  // Every tick takes three periods or more, so the third is more than 7 ms after the last answer.
  int late = 0;
  for (; late < 10 && device->read().status == Status::ok; ++late) {
    device->write({{0.3, 0.3, 0.0}});
    std::this_thread::sleep_for(std::chrono::milliseconds(3));
  }
  EXPECT_LE(late, 4);
}

TEST_F(TwoDiyOnALine, ThatIsUnpluggedHasFailed) {
  const auto device = opened(board_, kTwoDiyVariants[0]);
  for (int k = 0; k < 100; ++k) tick(*device, board_, {0.3, 0.3, 0.0});
  board_.inject(Fault::unplugged);
  Reading reading;
  for (int k = 0; k < 600; ++k) {
    reading = device->read();
    device->write({});
  }
  EXPECT_EQ(reading.status, Status::fault);
}

TEST_F(TwoDiyOnALine, AllocatesNothingInATick) {
  const auto device = opened(board_, kTwoDiyVariants[0]);
  tick(*device, board_, {});
  const AllocationScope scope;
  for (int k = 0; k < 50; ++k) {
    device->read();
    device->write({{0.1, 0.1, 0.0}});
  }
  EXPECT_EQ(scope.count(), 0U);
}

TEST(OpenTwoDiy, NamesWhatIsWrong) {
  const auto error = [](const std::string& url) {
    const auto device = open_device(url, {});
    EXPECT_FALSE(device) << url;
    return device ? Error{} : device.error();
  };
  EXPECT_EQ(error("2diy:/nowhere/ttyACM9").code, ErrorCode::device);
  EXPECT_NE(error("2diy:/nowhere/ttyACM9").message.find("plug"), std::string::npos);
  EXPECT_NE(error("2diy:/dev/null").message.find("not a serial port"), std::string::npos);
  EXPECT_EQ(error("2diy:/dev/null?variant=v9").code, ErrorCode::usage);
  const VirtualTwoDiy board(kTwoDiyVariants[0]);
  const auto first = opened(board, kTwoDiyVariants[0]);
  EXPECT_NE(error("2diy:" + board.path()).message.find("is used by "), std::string::npos);
  VirtualTwoDiy dumb(kTwoDiyVariants[0]);
  dumb.inject(Fault::silent);
  EXPECT_NE(error("2diy:" + dumb.path()).message.find("does not answer"), std::string::npos);
}

}  // namespace
}  // namespace palpable::device
