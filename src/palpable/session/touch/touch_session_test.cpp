// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/session/touch/touch_session.hpp"

#include "palpable/session/touch/scene_hash.hpp"
#include "palpable/session/touch/test_session.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <thread>

#include <gtest/gtest.h>

namespace palpable::session {
namespace {

/// A relief of 4000 x 3000 samples with a label for each.
std::shared_ptr<const models::Scene> large_scene() {
  Raster<float> height_m(4000, 3000);
  for (int y = 0; y < height_m.height(); ++y)
    for (int x = 0; x < height_m.width(); ++x)
      height_m(x, y) = 1e-6F * static_cast<float>((x / 16 + y / 16) % 2000);
  models::Scene scene;
  scene.labels = Raster<std::uint8_t>(height_m.width(), height_m.height());
  scene.model = std::make_shared<const models::Relief>(
      *models::Relief::from_samples(std::move(height_m), 0.1 / 4000.0));
  return std::make_shared<const models::Scene>(std::move(scene));
}

SessionOptions without_privileges() {
  SessionOptions options;
  options.servo.realtime_priority = 0;
  options.servo.memory = haptics::Memory::leave;
  return options;
}

TEST(TouchSession, KeepsThePointerAliveWhileSettingsOfALargeReliefAreDragged) {
  TouchSettings settings;
  settings.law.radius_m = 0.0;
  auto opened = TouchSession::open(large_scene(), settings, "pointer:", without_privileges());
  ASSERT_TRUE(opened) << opened.error().sentence();
  TouchSession& session = **opened;
  session.move_pointer({{0.0, 0.0, 0.01}});
  while (session.latest().status != device::Status::ok) session.move_pointer({{0.0, 0.0, 0.01}});
  static_cast<void>(session.take_events());

  std::atomic<bool> dragging = true;
  Result<void> dragged;
  std::thread slider([&] {
    for (int step = 0; step < 12 && dragged; ++step) {
      settings.law.stiffness_N_per_m = 200.0 + 10.0 * step;
      if (step % 4 == 3) settings.height_factor = 1.0 + 0.1 * step;
      dragged = session.change_settings(settings);
    }
    dragging = false;
  });
  std::size_t moves = 0, stale = 0;
  while (dragging) {
    session.move_pointer({{1e-5 * static_cast<double>(moves % 1000), 0.0, 0.01}});
    if (session.latest().status != device::Status::ok) ++stale;
    ++moves;
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  slider.join();
  EXPECT_TRUE(dragged) << dragged.error().sentence();
  EXPECT_GT(moves, 12U);
  EXPECT_EQ(stale, 0U);
  const auto events = session.take_events();
  EXPECT_EQ(std::count_if(events.begin(), events.end(),
                          [](const auto& e) { return e.kind == haptics::TouchEvent::Kind::fault; }),
            0);
}

/// How much higher than the device the hand is in the scene.
double raised_m(const TouchSession& session) {
  const auto sample = session.latest();
  return sample.position.v.z - sample.device_position.v.z;
}

TEST(TouchSession, KeepsTheScenesPlaceForTheNextSurfaceOfACamera) {
  const auto low = std::make_shared<const models::Scene>(hilly_scene(0.002));
  const auto high = std::make_shared<const models::Scene>(hilly_scene(0.03));
  auto opened = TouchSession::open(low, {}, "sim:?script=hold", without_privileges());
  ASSERT_TRUE(opened) << opened.error().sentence();
  TouchSession& session = **opened;
  const auto felt = [&] {
    while (session.latest().scene_id < session.newest_scene_id())
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
    return raised_m(session);
  };
  const double before_m = felt();
  ASSERT_TRUE(session.change_surface(high));
  EXPECT_NEAR(felt(), before_m, 1e-9);
  ASSERT_TRUE(session.change_scene(high));
  EXPECT_GT(std::abs(felt() - before_m), 0.005) << "another scene is placed anew";
}

TEST(SceneHashes, ReadASceneOnceAndAnotherAnew) {
  models::Scene first;
  first.model = std::make_shared<const models::Relief>(
      *models::Relief::from_samples(Raster<float>(4, 4, 0.01F), 0.001));
  models::Scene second = first;
  second.materials.front().stiffness_N_per_m += 1.0;
  const auto a = std::make_shared<const models::Scene>(first);
  const auto b = std::make_shared<const models::Scene>(second);
  SceneHashes hashes;
  EXPECT_EQ(hashes.of(a).scene, scene_hash(first));
  EXPECT_EQ(hashes.of(a).scene, scene_hash(first));
  EXPECT_EQ(hashes.of(a).shape, shape_hash(first));
  EXPECT_EQ(hashes.of(b).scene, scene_hash(second));
  EXPECT_NE(hashes.of(b).scene, hashes.of(a).scene);
}

}  // namespace
}  // namespace palpable::session
