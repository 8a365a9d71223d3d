// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sources/depth/colour_registration.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace palpable::sources {
namespace {

struct Seen {
  double x = 0.0;
  double y = 0.0;
  /// Depth in the colour camera; not positive: not visible.
  double z = 0.0;
};

class Projector {
 public:
  Projector(const DepthMap& depth, const ColourCamera& colour)
      : depth_(depth), from_(*depth.camera), colour_(colour) {}

  Seen operator()(int x, int y) const {
    const double z = static_cast<double>(depth_.depth_m(x, y));
    if (!(z > 0.0)) return {};
    const Vec3 p{(x - from_.cx) / from_.fx * z, (y - from_.cy) / from_.fy * z, z};
    const auto& r = colour_.rotation;
    const Vec3 q = Vec3{r[0] * p.x + r[1] * p.y + r[2] * p.z, r[3] * p.x + r[4] * p.y + r[5] * p.z,
                        r[6] * p.x + r[7] * p.y + r[8] * p.z} +
                   colour_.translation_m;
    if (!(q.z > 0.0)) return {};
    return {colour_.camera.fx * q.x / q.z + colour_.camera.cx,
            colour_.camera.fy * q.y / q.z + colour_.camera.cy, q.z};
  }

 private:
  const DepthMap& depth_;
  Pinhole from_;
  ColourCamera colour_;
};

bool within(const Seen& s, int width, int height) {
  return s.z > 0.0 && s.x >= -0.5 && s.y >= -0.5 && s.x < width - 0.5 && s.y < height - 0.5;
}

/// A depth buffer of the colour camera. A depth pixel covers as many colour pixels as the ratio of the focal
/// lengths.
Raster<float> nearest_in_colour(const DepthMap& depth, const Projector& project, const ColourCamera& colour) {
  const Pinhole& c = colour.camera;
  Raster<float> nearest(c.width, c.height, std::numeric_limits<float>::infinity());
  const int reach = std::clamp(static_cast<int>(std::ceil(0.5 * c.fx / depth.camera->fx)), 1, 8);
  for (int y = 0; y < depth.depth_m.height(); ++y)
    for (int x = 0; x < depth.depth_m.width(); ++x) {
      const Seen s = project(x, y);
      if (!within(s, c.width, c.height)) continue;
      const int u = static_cast<int>(std::lround(s.x));
      const int v = static_cast<int>(std::lround(s.y));
      for (int j = std::max(v - reach, 0); j <= std::min(v + reach, c.height - 1); ++j)
        for (int i = std::max(u - reach, 0); i <= std::min(u + reach, c.width - 1); ++i)
          nearest(i, j) = std::min(nearest(i, j), static_cast<float>(s.z));
    }
  return nearest;
}

/// Bilinear sample of each channel; the picture's own alpha is ignored.
void sample_colour(const Image& colour, const Seen& s, float* out) {
  const double x = std::clamp(s.x, 0.0, colour.width - 1.0);
  const double y = std::clamp(s.y, 0.0, colour.height - 1.0);
  const int x0 = std::min(static_cast<int>(x), colour.width - 1);
  const int y0 = std::min(static_cast<int>(y), colour.height - 1);
  const int x1 = std::min(x0 + 1, colour.width - 1);
  const int y1 = std::min(y0 + 1, colour.height - 1);
  const auto fx = static_cast<float>(x - x0);
  const auto fy = static_cast<float>(y - y0);
  for (int c = 0; c < 3; ++c) {
    const int k = colour.channels >= 3 ? c : 0;
    const float top = (1.0F - fx) * colour.pixel(x0, y0)[k] + fx * colour.pixel(x1, y0)[k];
    const float bottom = (1.0F - fx) * colour.pixel(x0, y1)[k] + fx * colour.pixel(x1, y1)[k];
    out[c] = (1.0F - fy) * top + fy * bottom;
  }
  out[3] = 1.0F;
}

}  // namespace

Result<Image> colour_at_depth(const DepthMap& depth, const Image& colour, const ColourCamera& from) {
  if (!depth.camera)
    return invalid_input("the depth camera's focal length is not known, so colours cannot be placed");
  if (depth.camera->width != depth.depth_m.width() || depth.camera->height != depth.depth_m.height() ||
      from.camera.width != colour.width || from.camera.height != colour.height)
    return invalid_input("a camera is stated for another size than its picture's");
  const Projector project(depth, from);
  const Raster<float> nearest = nearest_in_colour(depth, project, from);
  Image out{depth.depth_m.width(), depth.depth_m.height(), 4, colour.bits, {}};
  out.samples.resize(4 * depth.depth_m.count());
  float* pixel = out.samples.data();
  for (int y = 0; y < out.height; ++y)
    for (int x = 0; x < out.width; ++x, pixel += 4) {
      std::fill_n(pixel, 3, 0.5F);
      const Seen s = project(x, y);
      if (!within(s, colour.width, colour.height)) continue;
      // Ratio of depths below which a surface occludes another one; smaller differences are slopes and sensor
      // noise.
      constexpr double kHides = 0.97;
      const auto front = static_cast<double>(
          nearest(static_cast<int>(std::lround(s.x)), static_cast<int>(std::lround(s.y))));
      if (front >= kHides * s.z) sample_colour(colour, s, pixel);
    }
  return out;
}

}  // namespace palpable::sources
