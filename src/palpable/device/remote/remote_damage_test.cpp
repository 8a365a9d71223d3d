// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// Messages that were damaged on their way to the computer with the device.
#include "palpable/device/remote/remote_host.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdlib>
#include <iostream>
#include <memory>
#include <optional>
#include <random>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace palpable::device {
namespace {

using std::chrono::milliseconds;
using DamageClock = std::chrono::steady_clock;
constexpr auto kLongestWait = std::chrono::seconds(20);

/// A surface's message with a wrong bit, or without its end.
std::vector<std::byte> damaged_surface(std::mt19937& random) {
  LocalSurface surface;
  surface.kind = LocalSurface::Kind::plane;
  surface.normal.v = {0.0, 0.0, 1.0};
  surface.stiffness_N_per_m = 300.0;
  auto bytes = surface_message(surface);
  if (random() % 2 == 0)
    bytes.resize(1 + random() % (bytes.size() - 1));
  else
    bytes[random() % bytes.size()] ^= static_cast<std::byte>(1U << (random() % 8));
  return bytes;
}

/// Whether the host welcomes a client with this token.
bool is_welcomed(TcpStream& stream, const std::string& token) {
  stream.send(hello_message(token));
  MessageReader reader;
  for (const auto until = DamageClock::now() + kLongestWait; DamageClock::now() < until;) {
    std::vector<std::byte> got;
    stream.receive(got, 4096);
    reader.take(got);
    if (const auto message = reader.next()) return parse_welcome(*message).has_value();
    wait_for_any(std::array{stream.descriptor()}, milliseconds(1));
  }
  return false;
}

TEST(RemoteDamage, EndsTheSessionSoThatTheDeviceHasNoForce) {
  // As many as PALPABLE_FAULTS says.
  const char* wanted = std::getenv("PALPABLE_FAULTS");
  const int times = wanted != nullptr ? std::atoi(wanted) : 20;
  const auto exchange = std::make_shared<SharedExchange>();
  const auto host = RemoteHost::open({}, exchange);
  ASSERT_TRUE(host) << host.error().sentence();
  std::mt19937 random(17);
  std::vector<double> took_ms;
  std::string token;
  for (int time = 0; time < times; ++time) {
    // Each session has a token of its own.
    const auto until = DamageClock::now() + kLongestWait;
    while ((*host)->token() == token && DamageClock::now() < until)
      std::this_thread::sleep_for(milliseconds(1));
    token = (*host)->token();
    auto stream = TcpStream::connect("127.0.0.1", std::to_string((*host)->port()), milliseconds(1000));
    ASSERT_TRUE(stream && is_welcomed(*stream, token)) << time;
    ASSERT_TRUE(exchange->connected);
    const auto sent_at = DamageClock::now();
    stream->send(damaged_surface(random));
    // The client sends on, and what comes next is taken for a missing end.
    while (exchange->connected && DamageClock::now() - sent_at < kLongestWait) {
      std::this_thread::sleep_for(milliseconds(1));
      stream->send(surface_message({}));
      stream->flush();
    }
    ASSERT_FALSE(exchange->connected) << time;
    took_ms.push_back(std::chrono::duration<double, std::milli>(DamageClock::now() - sent_at).count());
  }
  std::sort(took_ms.begin(), took_ms.end());
  std::cout << times << " damaged messages: the session ended after " << took_ms[took_ms.size() / 2]
            << " ms (median), " << took_ms.back() << " ms (most)\n";
}

}  // namespace
}  // namespace palpable::device
