// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/models/relief/relief_dilation.hpp"

#include "palpable/core/numbers/vectorize.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

namespace palpable::models {
namespace {

/// best[x] = max(best[x], from[x] + rise); `which` stores the offset of the maximum.
PALPABLE_VECTORIZE void raise(float* best, std::int32_t* which, const float* from, int count, float rise,
                              std::int32_t offset) {
  for (int x = 0; x < count; ++x) {
    const float risen = from[x] + rise;
    which[x] = risen > best[x] ? offset : which[x];
    best[x] = std::max(best[x], risen);
  }
}

/// The spline's heights at its samples.
Raster<float> heights_at_samples(const Relief& relief) {
  const Raster<float>& values = relief.samples_m();
  Raster<float> heights(values.width(), values.height());
  const double left_m = -0.5 * (values.width() - 1) * relief.pixel_m();
  const double top_m = 0.5 * (values.height() - 1) * relief.pixel_m();
  for (int y = 0; y < heights.height(); ++y)
    for (int x = 0; x < heights.width(); ++x)
      heights(x, y) =
          static_cast<float>(relief.sample(left_m + x * relief.pixel_m(), top_m - y * relief.pixel_m()).z_m);
  return heights;
}

/// Control values whose spline approximates `heights`. The spline lowers curved surfaces by a sixth of the
/// second differences; these are at most `most_bent` on a surface over which a ball rolled.
Raster<float> control_values_for(const Raster<float>& heights, double most_bent) {
  const auto most = static_cast<float>(most_bent);
  Raster<float> values = heights;
  const int w = heights.width();
  const int h = heights.height();
  for (int y = 0; y < h; ++y)
    for (int x = 0; x < w; ++x) {
      const float z = heights(x, y);
      const float across = heights(std::max(x - 1, 0), y) + heights(std::min(x + 1, w - 1), y) - 2.0F * z;
      const float down = heights(x, std::max(y - 1, 0)) + heights(x, std::min(y + 1, h - 1)) - 2.0F * z;
      values(x, y) = z - (std::clamp(across, -most, most) + std::clamp(down, -most, most)) / 6.0F;
    }
  return values;
}

/// The greatest heights among the samples below the ball, and their offsets.
void find_offsets(const Raster<float>& heights, double reach, int y, float* best, std::int32_t* which,
                  std::vector<float>& padded) {
  const int r = static_cast<int>(std::floor(reach));
  const int w = heights.width();
  const int h = heights.height();
  for (int dy = -r; dy <= r; ++dy) {
    const auto row = heights.row(std::clamp(y + dy, 0, h - 1));
    std::copy(row.begin(), row.end(), padded.begin() + r);
    std::fill_n(padded.begin(), r, row.front());
    std::fill_n(padded.end() - r, r, row.back());
    const int chord = static_cast<int>(std::floor(std::sqrt(reach * reach - dy * dy)));
    for (int dx = -chord; dx <= chord; ++dx) {
      const double rise = std::sqrt(std::max(0.0, reach * reach - dx * dx - dy * dy));
      raise(best, which, padded.data() + r + dx, w, static_cast<float>(rise),
            (dy + r) * (2 * r + 1) + dx + r);
    }
  }
}

}  // namespace

Raster<BallContact> roll_ball(const Relief& relief, double radius_m, const Work& work) {
  PALPABLE_CHECK(radius_m > 0.0);
  const double pixel_m = relief.pixel_m();
  // Heights in pixels, so that the search over samples uses one unit.
  Raster<float> heights = heights_at_samples(relief);
  for (float& z : heights.values()) z = static_cast<float>(z / pixel_m);
  const double reach = radius_m / pixel_m;
  const int r = static_cast<int>(std::floor(reach));
  const int side = 2 * r + 1;
  const int w = heights.width();
  const int h = heights.height();
  Raster<BallContact> contacts(w, h);
  parallel_for(work, h, 8, [&](int begin, int end) {
    std::vector<float> padded(static_cast<std::size_t>(w + 2 * r));
    std::vector<float> best(static_cast<std::size_t>(w));
    std::vector<std::int32_t> which(static_cast<std::size_t>(w));
    for (int y = begin; y < end; ++y) {
      std::fill(best.begin(), best.end(), -1e30F);
      find_offsets(heights, reach, y, best.data(), which.data(), padded);
      for (int x = 0; x < w; ++x) {
        const int found = which[static_cast<std::size_t>(x)];
        contacts(x, y) =
            touch_by_ball(relief, radius_m, (x - 0.5 * (w - 1)) * pixel_m, (0.5 * (h - 1) - y) * pixel_m,
                          {pixel_m * (found % side - r), pixel_m * (r - found / side)});
      }
    }
  });
  return contacts;
}

Raster<float> control_values_of(const Raster<BallContact>& contacts, const Relief& relief, double radius_m) {
  Raster<float> centre(contacts.width(), contacts.height());
  for (std::size_t k = 0; k < centre.count(); ++k)
    centre.data()[k] = static_cast<float>(contacts.data()[k].height_m);
  const double steep2 = 1.0 + relief.steepest_slope() * relief.steepest_slope();
  return control_values_for(centre,
                            relief.pixel_m() * relief.pixel_m() / radius_m * steep2 * std::sqrt(steep2));
}

Raster<float> dilate_by_ball(const Relief& relief, double radius_m, const Work& work) {
  return control_values_of(roll_ball(relief, radius_m, work), relief, radius_m);
}

Raster<float> erode_by_ball(const Relief& relief, double radius_m, const Work& work) {
  Raster<float> hollow = relief.samples_m();
  for (float& z : hollow.values()) z = -z;
  auto turned = Relief::from_samples(std::move(hollow), relief.pixel_m());
  PALPABLE_CHECK(turned.has_value());
  Raster<float> deep = dilate_by_ball(*turned, radius_m, work);
  for (float& z : deep.values()) z = -z;
  return deep;
}

}  // namespace palpable::models
