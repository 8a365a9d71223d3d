// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/picture/camera.hpp"
#include "palpable/core/picture/image.hpp"
#include "palpable/core/vec3.hpp"

#include <cstdint>
#include <vector>

namespace palpable::samples {

/// The sample that `./run` opens: things on a wooden table, seen from above by a calibrated stereo camera.
/// World: metres, x right, y up the table, z out of the table's plane z = 0, towards the camera.
///
/// Only sums, products, quotients and square roots are used, which every processor rounds alike: the same
/// pictures come out everywhere, bit by bit.

/// Where the left camera stands and looks: p_world = position + x·right + y·down + z·forward for a point
/// (x, y, z) of the camera's frame. The right camera stands baseline_m further along `right`.
struct View {
  StereoRig rig;
  Vec3 position;
  Vec3 right;
  Vec3 down;
  Vec3 forward;
};

View sculpture_view();

enum class Eye { left, right };

/// One row of an eye's picture, as sRGB, four rays a pixel.
std::vector<Rgb8> render_row(const View& view, Eye eye, int y);

/// The left picture's exact disparity in pixels, through the pixels' centres; the surface is met within 1e-8
/// m.
std::vector<float> disparity_row(const View& view, int y);

/// One row of the left picture's labels, through the pixels' centres: the index of the object in the list
/// "objects" of sculpture.json, 0 for the table.
std::vector<std::uint8_t> label_row(const View& view, int y);

/// Disparity of the table alone at a pixel of the left picture: the truth for finding the ground.
double table_disparity_px(const View& view, int x, int y);

}  // namespace palpable::samples
