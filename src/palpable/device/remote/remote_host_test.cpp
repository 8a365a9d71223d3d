// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/core/system/allocations.hpp"
#include "palpable/device/drivers/open.hpp"
#include "palpable/device/remote/remote_device.hpp"
#include "palpable/device/remote/test_remote_host.hpp"

#include <array>
#include <chrono>
#include <random>
#include <thread>

#include <gtest/gtest.h>

namespace palpable::device {
namespace {

TEST_F(RemoteHostTest, PassesReadingsAndSurfaces) {
  auto device = connect();
  ASSERT_TRUE(device) << device.error().sentence();
  EXPECT_EQ((*device)->traits().name, "shared test device");
  EXPECT_EQ((*device)->traits().max_force_N, 4.5);
  EXPECT_TRUE(tick_until(**device, a_plane(), [&](const Reading& reading) {
    return reading.status == Status::ok && reading.buttons == 3 &&
           reading.position.v == Vec3{0.01, 0.02, 0.03} && came_.kind == LocalSurface::Kind::plane &&
           came_.read_at_s > 0.0;
  }));
  EXPECT_EQ(came_.stiffness_N_per_m, 300.0);
  // The surface is taken away when the touch stops.
  (*device)->stop();
  EXPECT_TRUE(
      tick_until(**device, {}, [&](const Reading&) { return came_.kind == LocalSurface::Kind::none; }));
}

TEST_F(RemoteHostTest, PassesTexturesOnBeforeTheSurfacesThatNameThem) {
  auto device = connect();
  ASSERT_TRUE(device) << device.error().sentence();
  const std::vector<LocalTexture> sent{{1, 2, 0.002, 30e-6, 0.1}, {7, 4, 0.001, 10e-6, 0.0, {0.5F, -0.5F}}};
  dynamic_cast<TakesLocalSurface&>(**device).textures()->put(sent);
  LocalSurface surface = a_plane();
  surface.texture.number = 7;
  EXPECT_TRUE(tick_until(**device, surface, [&](const Reading&) { return came_.texture.number == 7; }));
  const std::lock_guard lock(mutex_);
  EXPECT_EQ(textures_, sent);
}

TEST_F(RemoteHostTest, EndsTheSessionForATextureThatIsNone) {
  auto device = connect();
  ASSERT_TRUE(device) << device.error().sentence();
  dynamic_cast<TakesLocalSurface&>(**device).textures()->put({{1, 9, 0.002, 30e-6, 0.1}});
  EXPECT_TRUE(has_news("texture that is out of range"));
}

TEST_F(RemoteHostTest, ServesOneClientAtATime) {
  auto device = connect();
  ASSERT_TRUE(device);
  ASSERT_TRUE(
      tick_until(**device, a_plane(), [&](const Reading& reading) { return reading.status == Status::ok; }));
  auto stream = raw();
  const auto answer = answer_to(stream, hello_message(host_->token()));
  ASSERT_TRUE(answer);
  EXPECT_TRUE(parse_refused(*answer));
  // The first one goes on.
  came_ = {};
  EXPECT_TRUE(tick_until(**device, a_plane(),
                         [&](const Reading&) { return came_.kind == LocalSurface::Kind::plane; }));
}

/// What a client that has the token sends, and the sentence about it.
struct Hostile {
  const char* name;
  std::vector<std::byte> (*bytes)();
  const char* told;
};

std::vector<std::byte> of_a_surface(void (*change)(LocalSurface&)) {
  LocalSurface surface;
  surface.kind = LocalSurface::Kind::plane;
  surface.normal.v = {0.0, 0.0, 1.0};
  change(surface);
  return surface_message(surface);
}

const Hostile kHostile[]{
    {"random bytes",
     [] {
       std::mt19937 random(11);
       std::vector<std::byte> bytes(3000);
       for (auto& byte : bytes) byte = static_cast<std::byte>(random());
       return bytes;
     },
     "sent what is no message"},
    {"a huge length",
     [] {
       auto bytes = surface_message({});
       bytes[4] = bytes[5] = std::byte{0xFF};
       return bytes;
     },
     "sent what is no message"},
    {"no number", [] { return of_a_surface([](LocalSurface& s) { s.stiffness_N_per_m = std::nan(""); }); },
     "out of range"},
    {"an infinite normal", [] { return of_a_surface([](LocalSurface& s) { s.normal.v.z = HUGE_VAL; }); },
     "out of range"},
    {"a normal that is none", [] { return of_a_surface([](LocalSurface& s) { s.normal.v = {}; }); },
     "out of range"},
    {"a reading", [] { return reading_message({}); }, "has no place in a touch"},
    {"a flood",
     [] {
       std::vector<std::byte> bytes;
       const auto one = surface_message({});
       for (int k = 0; k < 20 * RemoteHost::kMostMessages; ++k)
         bytes.insert(bytes.end(), one.begin(), one.end());
       return bytes;
     },
     "too many messages"}};

TEST_F(RemoteHostTest, EndsTheSessionOfAHostileClientWithASentence) {
  for (const Hostile& hostile : kHostile) {
    {
      const std::lock_guard lock(mutex_);
      news_.clear();
    }
    auto stream = raw();
    const auto welcome = answer_to(stream, hello_message(host_->token()));
    ASSERT_TRUE(welcome && parse_welcome(*welcome)) << hostile.name;
    const auto bytes = hostile.bytes();
    constexpr std::size_t kAtOnce = 16384;
    for (std::size_t at = 0; at < bytes.size() && !stream.is_lost(); at += kAtOnce) {
      stream.send(std::span(bytes).subspan(at, std::min(kAtOnce, bytes.size() - at)));
      for (int k = 0; k < 100 && !stream.is_lost() && !stream.has_sent_all(); ++k) {
        std::this_thread::sleep_for(milliseconds(1));
        stream.flush();
      }
    }
    EXPECT_TRUE(has_news(hostile.told)) << hostile.name;
    EXPECT_FALSE(exchange_->connected) << hostile.name;
  }
  EXPECT_TRUE(connect());
}

/// Passes bytes between a client and the host, until it is cut.
class Cable {
 public:
  explicit Cable(std::uint16_t to) : to_(std::to_string(to)), listener_(*TcpListener::open("127.0.0.1", 0)) {
    thread_ = std::thread([this] { run(); });
  }
  ~Cable() {
    ends_ = true;
    thread_.join();
  }
  Cable(const Cable&) = delete;
  Cable& operator=(const Cable&) = delete;
  std::uint16_t port() const { return listener_.port(); }
  void cut(bool is_cut) { is_cut_ = is_cut; }

 private:
  void run() {
    while (!ends_) {
      auto client = is_cut_ ? std::nullopt : listener_.accept();
      if (!client) {
        std::this_thread::sleep_for(milliseconds(2));
        continue;
      }
      auto host = TcpStream::connect("127.0.0.1", to_, milliseconds(1000));
      if (!host) continue;
      const auto pass = [](TcpStream& from, TcpStream& to) {
        std::vector<std::byte> bytes;
        const bool open = from.receive(bytes, 65536);
        to.send(bytes);
        return open && !to.is_lost();
      };
      while (!ends_ && !is_cut_ && pass(*client, *host) && pass(*host, *client))
        wait_for_any(std::array{client->descriptor(), host->descriptor()}, milliseconds(1));
    }
  }
  std::string to_;
  TcpListener listener_;
  std::atomic<bool> ends_{false};
  std::atomic<bool> is_cut_{false};
  std::thread thread_;
};

TEST_F(RemoteHostTest, DriverConnectsAgainByItself) {
  Cable cable(host_->port());
  auto device =
      open_device("remote:127.0.0.1:" + std::to_string(cable.port()) + "?token=" + host_->token(), {});
  ASSERT_TRUE(device) << device.error().sentence();
  const auto is = [](Status status) {
    return [status](const Reading& reading) { return reading.status == status; };
  };
  ASSERT_TRUE(tick_until(**device, a_plane(), is(Status::ok)));
  cable.cut(true);
  EXPECT_TRUE(tick_until(**device, a_plane(), is(Status::stale)));
  EXPECT_FALSE(exchange_->connected);
  cable.cut(false);
  EXPECT_TRUE(tick_until(**device, a_plane(), is(Status::ok)));
  came_ = {};
  EXPECT_TRUE(tick_until(**device, a_plane(),
                         [&](const Reading&) { return came_.kind == LocalSurface::Kind::plane; }));
}

TEST_F(RemoteHostTest, DriverHasFailedWhenTheSharingEnds) {
  auto device = connect();
  ASSERT_TRUE(device);
  ASSERT_TRUE(
      tick_until(**device, a_plane(), [](const Reading& reading) { return reading.status == Status::ok; }));
  host_.reset();
  EXPECT_TRUE(tick_until(**device, a_plane(),
                         [](const Reading& reading) { return reading.status == Status::fault; }));
  EXPECT_NE((*device)->fault().find("ended the sharing"), std::string::npos) << (*device)->fault();
}

TEST_F(RemoteHostTest, APortInUseIsTheSystemsFault) {
  HostOptions options;
  options.port = host_->port();
  const auto second = RemoteHost::open(options, std::make_shared<SharedExchange>());
  ASSERT_FALSE(second);
  EXPECT_EQ(second.error().code, ErrorCode::failed);
}

TEST_F(RemoteHostTest, DriverNeitherAllocatesNorWaitsInATick) {
  ASSERT_TRUE(allocations_are_counted());
  auto device = connect();
  ASSERT_TRUE(device);
  auto& takes = dynamic_cast<TakesLocalSurface&>(**device);
  const AllocationScope scope;
  for (int k = 0; k < 1000; ++k) {
    (*device)->read();
    takes.write_surface(a_plane());
    (*device)->write({{0.1, 0.0, 0.0}});
  }
  (*device)->stop();
  EXPECT_EQ(scope.count(), 0U);
}

}  // namespace
}  // namespace palpable::device
