// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/device/recording/recording.hpp"
#include "palpable/session/check/check_recording.hpp"
#include "palpable/session/touch/test_session.hpp"

#include <algorithm>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <unistd.h>

// Recordings of touches with the simulated device, genuine and forged, for the tests of `check`.
namespace palpable::session {

inline std::shared_ptr<const models::Scene> waves(double height_m) {
  models::Scene scene = hilly_scene(height_m);
  models::Material material;
  material.texture.kind = models::TouchTexture::Kind::bumps;
  material.texture.pitch_m = 0.002;
  material.texture.height_m = 0.0001;
  scene.materials = {material};
  return std::make_shared<const models::Scene>(std::move(scene));
}

/// Tests run in parallel, each in its own process.
inline std::filesystem::path in_temp(std::string_view name) {
  return std::filesystem::path(testing::TempDir()) / (std::to_string(getpid()) + "-" + std::string(name));
}

inline HeadlessOptions recorded_touch_of(double seconds, std::string_view name) {
  HeadlessOptions options = unprivileged(seconds);
  options.device_url = "sim:?speed-mm=200&delay=1&seed=3";
  options.recording = in_temp(name);
  return options;
}

inline SceneMaker makes(std::vector<std::shared_ptr<const models::Scene>> scenes) {
  return [scenes](const DeliverScene& deliver, const Work&) -> Result<void> {
    for (const auto& scene : scenes) deliver(scene);
    return {};
  };
}

inline CheckReport checked(const std::filesystem::path& file,
                           std::vector<std::shared_ptr<const models::Scene>> scenes) {
  auto report = check_recording(file, {std::move(scenes), 100}, {});
  EXPECT_TRUE(report) << report.error().sentence();
  return report ? *std::move(report) : CheckReport{};
}

inline std::string said(const CheckReport& report) {
  std::string text;
  for (const Finding& finding : report.findings) text += sentence_of(finding) + "\n";
  return text;
}

/// The same recording with its ticks modified by `change` and new checksums: a deliberate forgery.
inline std::filesystem::path altered(const std::filesystem::path& file, std::string_view name,
                                     const std::function<void(device::Recording&)>& change) {
  auto recording = *device::read_recording(file);
  change(recording);
  const auto copy = in_temp(name);
  auto writer = *device::RecordingWriter::create(copy, recording.header_json);
  for (const auto& scene : recording.scenes) EXPECT_TRUE(writer->write(scene));
  EXPECT_TRUE(writer->write(recording.ticks));
  EXPECT_TRUE(writer->finish(recording.lost));
  return copy;
}

inline bool found(const CheckReport& report, FindingKind kind) {
  return std::any_of(report.findings.begin(), report.findings.end(),
                     [kind](const Finding& finding) { return finding.kind == kind; });
}

inline std::size_t first_in_contact(const device::Recording& recording) {
  std::size_t n = recording.ticks.size() / 2;
  while (n + 1 < recording.ticks.size() && !recording.ticks[n].has(haptics::flag::kContact)) ++n;
  return n;
}

/// One touch of a second; each process of tests makes it once.
inline const std::filesystem::path& one_touch() {
  static const std::filesystem::path file = [] {
    const auto options = recorded_touch_of(1.0, "one-touch.rec");
    EXPECT_TRUE(touch_headless(makes({waves(0.010)}), options, {}));
    return options.recording;
  }();
  return file;
}

}  // namespace palpable::session
