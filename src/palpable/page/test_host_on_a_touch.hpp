// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

// A page's host on a touch of a cone with a pointer.

#include "palpable/core/test_comes_true.hpp"
#include "palpable/page/touch_host.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <utility>

#include <gtest/gtest.h>
#include <unistd.h>

namespace palpable::page {

// A cone of 10 mm in the middle of 40 x 30 mm.
inline std::shared_ptr<const models::Scene> cone_scene() {
  Raster<float> height_m(80, 60);
  for (int j = 0; j < 60; ++j)
    for (int i = 0; i < 80; ++i)
      height_m(i, j) = static_cast<float>(std::max(0.0, 0.010 - 0.0005 * std::hypot(i - 39.5, j - 29.5)));
  auto scene = std::make_shared<models::Scene>();
  scene->model =
      std::make_shared<const models::Relief>(models::Relief::from_samples(height_m, 0.0005).value());
  scene->texture = Raster<Rgb8>(80, 60, Rgb8{90, 120, 150});
  scene->source.inputs = {"/somewhere/cone left.png", "/somewhere/cone right.png"};
  return scene;
}

class HostOnATouch : public ::testing::Test {
 protected:
  HostOnATouch() {
    session::SessionOptions options;
    options.servo.realtime_priority = 0;
    options.further_probes = 9;
    options.recording = recorded;
    auto opened = session::TouchSession::open(cone_scene(), {}, "pointer:", options);
    EXPECT_TRUE(opened);
    session = std::move(opened).value();
    host = std::make_unique<TouchHost>(*session, options_for_host());
  }

  TouchHost::Options options_for_host() {
    TouchHost::Options options;
    options.program = "palpable test";
    options.take_better_scene = [this] { return std::exchange(better, nullptr); };
    options.save_as = file;
    options.egocentric = true;
    return options;
  }

  protocol::ProbeState first() const { return host->state().probes.front(); }

  // Updates as the server does until `condition` holds.
  bool comes_true(const std::function<bool()>& condition) const {
    return palpable::comes_true([&] {
      host->update();
      return condition();
    });
  }

  std::filesystem::path file =
      std::filesystem::path(::testing::TempDir()) / (std::to_string(getpid()) + "_host_test.palp");
  std::filesystem::path recorded = std::filesystem::path(::testing::TempDir()) /
                                   (std::string("palpable_host_test_") +
                                    ::testing::UnitTest::GetInstance()->current_test_info()->name() + ".rec");
  std::shared_ptr<const models::Scene> better;
  std::unique_ptr<session::TouchSession> session;
  std::unique_ptr<TouchHost> host;
};

inline protocol::Change change_of(int serial, double stiffness = 400.0) {
  return {serial, "proxy", {{"stiffness_N_per_m", stiffness}}, 1.0};
}
inline protocol::Edit edit(int serial, double stiffness) {
  return {serial, 0, {stiffness, 0.5, 0.4, 0.25, protocol::Texture{"ridges", 0.002, 30e-6, 90.0}}};
}
inline protocol::ParameterValue parameter(const protocol::Settings& settings, const std::string& name) {
  return *std::find_if(settings.parameters.begin(), settings.parameters.end(),
                       [&](const auto& one) { return one.name == name; });
}
inline double stiffness_in(const protocol::Settings& settings) {
  return parameter(settings, "stiffness_N_per_m").used;
}

}  // namespace palpable::page
