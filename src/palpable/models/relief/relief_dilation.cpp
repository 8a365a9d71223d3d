// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/models/relief/relief_dilation.hpp"

#include "palpable/models/relief/ball_contacts.hpp"
#include "palpable/models/relief/rolling_contact.hpp"
#include "palpable/models/relief/rows_done.hpp"
#include "palpable/models/relief/touch_points.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>
#include <vector>

namespace palpable::models {
namespace {

/// Steps of Newton's method for one contact.
constexpr int kSteps = 5;

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

/// Second differences of a surface over which a ball rolled, at most.
double most_bent(const Relief& relief, double radius_m) {
  const double steep2 = 1.0 + relief.steepest_slope() * relief.steepest_slope();
  return relief.pixel_m() * relief.pixel_m() / radius_m * steep2 * std::sqrt(steep2);
}

}  // namespace

Raster<float> dilate_by_ball(const Relief& relief, double radius_m, const Work& work) {
  PALPABLE_CHECK(radius_m > 0.0);
  const double pixel_m = relief.pixel_m();
  // Heights in pixels, so that the search over samples uses one unit.
  Raster<float> heights = heights_at_samples(relief);
  for (float& z : heights.values()) z = static_cast<float>(z / pixel_m);
  const BallContacts contacts(heights, radius_m / pixel_m);
  const int w = heights.width();
  const int h = heights.height();
  Raster<float> centre(w, h);
  RowsDone done(work, h, {0.0, 1.0});
  parallel_for(work, h, 8, [&](int begin, int end) {
    std::vector<ContactOffset> found(static_cast<std::size_t>(w));
    for (int y = begin; y < end && !work.cancelled(); ++y) {
      contacts.find_row(y, found);
      for (int x = 0; x < w; ++x) {
        const ContactOffset contact = found[static_cast<std::size_t>(x)];
        const UnderBall from{contact.right * pixel_m, -contact.down * pixel_m};
        centre(x, y) = static_cast<float>(rest_ball(relief, radius_m, (x - 0.5 * (w - 1)) * pixel_m,
                                                    (0.5 * (h - 1) - y) * pixel_m, from, kSteps)
                                              .centre_m);
      }
      done.add();
    }
  });
  return control_values_for(centre, most_bent(relief, radius_m));
}

Result<RefinedRelief> coarse_surface_of_ball(const Relief& relief, double radius_m, const Work& work) {
  Raster<float> values = dilate_by_ball(relief, radius_m, work);
  if (work.cancelled()) return Work::interrupted();
  auto dilated = Relief::from_samples(std::move(values), relief.pixel_m());
  if (!dilated) return dilated.error();
  return RefinedRelief(std::make_shared<const Relief>(*std::move(dilated)));
}

Result<RefinedRelief> surface_of_ball(const Relief& relief, double radius_m, const FinerFit& fit,
                                      const Work& work) {
  PALPABLE_CHECK(radius_m > 0.0);
  const TouchPoints contacts(relief, radius_m, work);
  if (work.cancelled()) return Work::interrupted();
  auto coarse = Relief::from_samples(control_values_for(contacts.centre_m(), most_bent(relief, radius_m)),
                                     relief.pixel_m());
  if (!coarse) return coarse.error();
  const auto surface = std::make_shared<const Relief>(*std::move(coarse));
  const std::vector<FinerCell> cells = fit_finer_cells(*surface, contacts, fit, work);
  if (work.cancelled()) return Work::interrupted();
  work.report(1.0, "fitting the ball's surface in creases");
  if (cells.empty()) return RefinedRelief(surface);
  return RefinedRelief(surface, std::make_shared<const FinerCells>(relief.samples_m().width(),
                                                                   relief.samples_m().height(), cells));
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
