// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/device/drivers/open.hpp"
#include "palpable/device/remote/remote_device.hpp"
#include "palpable/device/remote/remote_host.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <condition_variable>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace palpable::device {

/// A host on the loopback interface, whose servo is the test.
class RemoteHostTest : public testing::Test {
 protected:
  using milliseconds = std::chrono::milliseconds;
  static constexpr auto kSoon = milliseconds(5000);

  void SetUp() override { share(0); }

  void share(std::uint16_t port) {
    HostOptions options;
    options.port = port;
    options.traits.name = "shared test device";
    options.traits.max_force_N = 4.5;
    options.on_texture = [this](const LocalTexture& texture) {
      const std::lock_guard lock(mutex_);
      textures_.push_back(texture);
      return texture.kind < 5;
    };
    options.on_news = [this](const std::string& sentence) {
      const std::lock_guard lock(mutex_);
      news_.push_back(sentence);
      told_.notify_all();
    };
    auto host = RemoteHost::open(std::move(options), exchange_);
    ASSERT_TRUE(host) << host.error().sentence();
    host_ = *std::move(host);
  }

  std::string url() const {
    return "remote:127.0.0.1:" + std::to_string(host_->port()) + "?token=" + host_->token();
  }
  Result<std::unique_ptr<Device>> connect() const { return open_device(url(), {}); }

  TcpStream raw() const {
    auto stream = TcpStream::connect("127.0.0.1", std::to_string(host_->port()), milliseconds(1000));
    EXPECT_TRUE(stream);
    return *std::move(stream);
  }
  /// What the host answers to these bytes before it closes, or the first message of a session.
  static std::optional<Message> answer_to(TcpStream& stream, std::span<const std::byte> bytes) {
    stream.send(bytes);
    MessageReader reader;
    for (const auto until = std::chrono::steady_clock::now() + kSoon;
         std::chrono::steady_clock::now() < until;) {
      std::vector<std::byte> got;
      const bool open = stream.receive(got, 4096);
      reader.take(got);
      if (auto message = reader.next()) return message;
      if (!open) return {};
      stream.flush();
      wait_for_any(std::array{stream.descriptor()}, milliseconds(5));
    }
    return {};
  }
  bool has_news(const std::string& part) {
    std::unique_lock lock(mutex_);
    return told_.wait_for(lock, kSoon, [&] {
      return std::any_of(news_.begin(), news_.end(),
                         [&](const auto& sentence) { return sentence.find(part) != std::string::npos; });
    });
  }
  /// Ticks of both servos until the condition holds.
  template <class Condition>
  bool tick_until(Device& device, const LocalSurface& surface, Condition&& condition) {
    for (const auto until = std::chrono::steady_clock::now() + kSoon;
         std::chrono::steady_clock::now() < until; std::this_thread::sleep_for(milliseconds(1))) {
      exchange_->readings.put({shared_clock_s(), {{0.01, 0.02, 0.03}}, Status::ok, 3});
      const Reading reading = device.read();
      dynamic_cast<TakesLocalSurface&>(device).write_surface(surface);
      device.write({});
      LocalSurface came;
      if (exchange_->surfaces.take(came)) came_ = came;
      if (condition(reading)) return true;
    }
    return false;
  }
  /// Whether any surface comes from the client.
  bool surface_comes() {
    for (const auto until = std::chrono::steady_clock::now() + kSoon;
         std::chrono::steady_clock::now() < until; std::this_thread::sleep_for(milliseconds(1)))
      if (LocalSurface came; exchange_->surfaces.take(came)) return true;
    return false;
  }
  static LocalSurface a_plane() {
    LocalSurface surface;
    surface.kind = LocalSurface::Kind::plane;
    surface.normal.v = {0.0, 0.0, 1.0};
    surface.stiffness_N_per_m = 300.0;
    return surface;
  }

  std::shared_ptr<SharedExchange> exchange_ = std::make_shared<SharedExchange>();
  LocalSurface came_;
  std::mutex mutex_;
  std::condition_variable told_;
  std::vector<std::string> news_;
  std::vector<LocalTexture> textures_;
  std::unique_ptr<RemoteHost> host_;
};

}  // namespace palpable::device
