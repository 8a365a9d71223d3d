// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/session/robot/view_shift.hpp"

#include "palpable/models/relief/relief_dilation.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace palpable::session {
namespace {

/// The pixel at a place of a relief, which has one sample for each pixel.
std::pair<double, double> pixel_at(const models::Relief& relief, double x_m, double y_m) {
  const auto& samples = relief.samples_m();
  return {x_m / relief.pixel_m() + 0.5 * (samples.width() - 1),
          -y_m / relief.pixel_m() + 0.5 * (samples.height() - 1)};
}

/// The whole samples of a shift, to the right and down.
std::pair<int, int> samples_of(const ViewShift& shift, double pixel_m) {
  return {static_cast<int>(std::lround(shift.by_m.x / pixel_m)),
          static_cast<int>(std::lround(-shift.by_m.y / pixel_m))};
}

/// The known depth that is nearest to a pixel.
std::optional<double> depth_near(const Raster<float>& depth_m, int u, int v) {
  constexpr int kReach = 3;
  std::optional<double> found;
  int least = kReach * kReach + 1;
  for (int dv = -kReach; dv <= kReach; ++dv)
    for (int du = -kReach; du <= kReach; ++du) {
      const int away = du * du + dv * dv;
      if (away >= least || !depth_m.contains(u + du, v + dv)) continue;
      const float z = depth_m(u + du, v + dv);
      if (!std::isfinite(z)) continue;
      least = away;
      found = static_cast<double>(z);
    }
  return found;
}

/// The height of a ball's lowest point that rests on a relief at a place.
double ball_height_m(const models::Relief& relief, double x_m, double y_m, double radius_m) {
  if (!(radius_m > 0.0)) return relief.sample(x_m, y_m).z_m;
  const auto centres =
      models::Relief::from_samples(models::dilate_by_ball(relief, radius_m, {}), relief.pixel_m());
  return centres ? centres->sample(x_m, y_m).z_m - radius_m : relief.sample(x_m, y_m).z_m;
}

double towards_zero(double from, double most) {
  return from > 0.0 ? std::max(0.0, from - most) : std::min(0.0, from + most);
}

}  // namespace

std::optional<Point<WorldFrame>> point_under(const TouchedView& view, const ViewShift& shift, Vec3 hand_m) {
  if (!view.camera) return std::nullopt;
  const auto [right, down] = samples_of(shift, view.relief.pixel_m());
  const auto [u, v] = pixel_at(view.relief, hand_m.x, hand_m.y);
  const double x = u - right, y = v - down;
  const auto z = depth_near(view.depth_m, static_cast<int>(std::lround(x)), static_cast<int>(std::lround(y)));
  if (!z) return std::nullopt;
  const Pinhole& camera = *view.camera;
  return view.base_from_camera *
         Point<CameraFrame>{{(x - camera.cx) / camera.fx * *z, (y - camera.cy) / camera.fy * *z, *z}};
}

std::optional<Vec3> place_of(const TouchedView& view, Point<WorldFrame> point) {
  const Vec3 p = (view.base_from_camera.inverse() * point).v;
  if (!view.camera || !(p.z > 0.0)) return std::nullopt;
  const Pinhole& camera = *view.camera;
  const double u = camera.fx * p.x / p.z + camera.cx, v = camera.fy * p.y / p.z + camera.cy;
  if (!view.depth_m.contains(static_cast<int>(std::lround(u)), static_cast<int>(std::lround(v))))
    return std::nullopt;
  const double pixel_m = view.relief.pixel_m();
  return Vec3{pixel_m * (u - 0.5 * (camera.width - 1)), pixel_m * (0.5 * (camera.height - 1) - v), 0.0};
}

ZoomedShift zoomed_shift(const TouchedView& from, const ViewShift& before, const TouchedView& to, Vec3 hand_m,
                         double radius_m) {
  ZoomedShift zoomed;
  zoomed.point = point_under(from, before, hand_m);
  const auto place = zoomed.point ? place_of(to, *zoomed.point) : std::nullopt;
  if (!place) zoomed.point.reset();
  if (place) zoomed.shift.by_m = {hand_m.x - place->x, hand_m.y - place->y, 0.0};
  const auto shown = shifted(from.relief, before);
  const auto coming = shifted(to.relief, zoomed.shift);
  if (shown && coming)
    zoomed.shift.by_m.z = ball_height_m(**shown, hand_m.x, hand_m.y, radius_m) -
                          ball_height_m(**coming, hand_m.x, hand_m.y, radius_m);
  return zoomed;
}

Result<std::shared_ptr<const models::Relief>> shifted(const models::Relief& relief, const ViewShift& shift) {
  const auto& samples = relief.samples_m();
  const auto [right, down] = samples_of(shift, relief.pixel_m());
  const auto up = static_cast<float>(shift.by_m.z);
  Raster<float> moved(samples.width(), samples.height());
  for (int y = 0; y < moved.height(); ++y)
    for (int x = 0; x < moved.width(); ++x)
      moved(x, y) = std::max(0.0F, up + samples(std::clamp(x - right, 0, samples.width() - 1),
                                                std::clamp(y - down, 0, samples.height() - 1)));
  auto made = models::Relief::from_samples(std::move(moved), relief.pixel_m());
  if (!made) return std::move(made).error();
  return std::make_shared<const models::Relief>(*std::move(made));
}

ViewShift relaxed(const ViewShift& shift, double dt_s) {
  constexpr double kAside_m_per_s = 0.01, kUp_m_per_s = 0.003;
  const double aside_m = std::hypot(shift.by_m.x, shift.by_m.y);
  const double left = aside_m > 0.0 ? towards_zero(aside_m, kAside_m_per_s * dt_s) / aside_m : 0.0;
  return {{left * shift.by_m.x, left * shift.by_m.y, towards_zero(shift.by_m.z, kUp_m_per_s * dt_s)}};
}

}  // namespace palpable::session
