// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/files/byte_reader.hpp"
#include "palpable/formats/scene/scene_file.hpp"

#include <cmath>
#include <string>

#include <gtest/gtest.h>

// For tests: a scene with everything that a file can hold.
namespace palpable::formats {

inline Raster<float> hills(int width, int height) {
  Raster<float> z(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      z(x, y) =
          0.005F + 0.004F * std::sin(0.1F * static_cast<float>(x)) * std::cos(0.07F * static_cast<float>(y));
  return z;
}

inline models::Scene sample(int width = 40, int height = 30) {
  models::Scene scene;
  scene.model =
      std::make_shared<const models::Relief>(*models::Relief::from_samples(hills(width, height), 0.0025));
  scene.texture = Raster<Rgb8>(8, 6, {10, 20, 30});
  scene.materials = {{"stone", 900.0, 1.0, 0.5, 0.4, {models::TouchTexture::Kind::grain, 0.0015, 2e-5, 0.25}},
                     {"glass \xC3\xA4", 1200.5, 0.1, 0.05, 0.03, {}}};
  scene.labels = Raster<std::uint8_t>(8, 6, 1);
  scene.scene_from_input.translation_m = {0.1, -1.0 / 3.0, 0.25};
  scene.scene_from_input.scale = 1e-4;
  scene.source = {{"left.png", "right.png"},
                  "scanline --detail plain",
                  "Palpable test",
                  {"make", "left.png", "--size=80x80x12"},
                  {{"left.png", 4, std::string(64, 'a')}}};
  return scene;
}

/// The sample's file after a text replacement in its scene.json.
inline Bytes with_description(const std::string& from, const std::string& to) {
  auto members = *unzip(*encode_scene(sample()));
  std::string text(as_text(members["scene.json"]));
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from << " in " << text;
  text.replace(at, from.size(), to);
  members["scene.json"] = Bytes(as_bytes(text).begin(), as_bytes(text).end());
  return *zip(members);
}

}  // namespace palpable::formats
