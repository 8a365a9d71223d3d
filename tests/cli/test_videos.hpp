// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/picture/image.hpp"
#include "palpable/core/picture/raster.hpp"
#include "palpable/core/vec3.hpp"

#include <cstdint>
#include <string>
#include <vector>

// Videos of a textured box on a textured table.
namespace palpable::test {

/// The pictures' camera: 240 x 180 pixels, focal length 220 px.
inline constexpr int kVideoWidth = 240, kVideoHeight = 180;
inline constexpr double kVideoFocal_px = 220.0;

/// Smooth random grey levels, 0 … 1, of a place on a surface; lengths in metres.
double texture_at(double u, double v, int surface);

/// Which scene is filmed: a box of 120 x 100 x 60 mm, or a larger one with other textures.
enum class FilmedScene { box, other_box };

/// The picture of a camera at `from` that looks at `at`; metres, z up, the table at z = 0.
Raster<Rgb8> picture_from(Vec3 from, Vec3 at, FilmedScene scene = FilmedScene::box);

/// A place on an arc around the box; radians.
Vec3 on_arc(double angle);

/// What a video file says beside its pictures.
struct FilmedAs {
  /// When each picture is shown, in 1/600 s; empty: 30 a second.
  std::vector<std::int64_t> times = {};
  /// Clockwise quarter turns that make the pictures upright, as a phone states them.
  int turns = 0;
};

/// Writes a QuickTime file of lossless pictures, all of one size. Fails the test if it cannot.
void write_video(const std::string& file, const std::vector<Raster<Rgb8>>& pictures, const FilmedAs& as = {});

}  // namespace palpable::test
