// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sculpt/superquadric/superquadric_cases.hpp"

#include "palpable/models/field/superquadric_mesh.hpp"
#include "palpable/sculpt/superquadric/label_outline.hpp"

#include <algorithm>
#include <cmath>
#include <random>

namespace palpable::sculpt {
namespace {

using models::Superquadric;

class Draw {
 public:
  explicit Draw(unsigned seed) : random_(seed) {}
  double in(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }
  double gauss() { return normal_(random_); }
  Vec3 gauss3() {
    const double x = gauss();
    const double y = gauss();
    return {x, y, gauss()};
  }

 private:
  std::mt19937 random_;
  std::normal_distribution<double> normal_;
};

Superquadric draw_shape(Draw& draw, FitDeformation deformation) {
  Superquadric s;
  s.size_m.x = draw.in(0.5, 1.5);
  s.size_m.y = draw.in(0.5, 1.5);
  s.size_m.z = draw.in(0.5, 1.5);
  s.e1 = draw.in(0.1, 1.0);
  s.e2 = draw.in(0.1, 1.0);
  std::array<double, 4> q{draw.gauss(), draw.gauss(), draw.gauss(), draw.gauss()};
  const double length = std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
  for (double& part : q) part /= length;
  s.scene_from_shape.rotation = models::rotation_of(q);
  s.scene_from_shape.translation_m = {draw.in(-1.0, 1.0), draw.in(-1.0, 1.0), draw.in(-1.0, 1.0)};
  if (deformation != FitDeformation::none) {
    s.taper_x = draw.in(-0.5, 0.5);
    s.taper_y = draw.in(-0.5, 0.5);
  }
  if (deformation == FitDeformation::taper_and_bend) {
    // Longest along z: a bend of a plate has no unique axis.
    s.size_m.z = 1.5 * std::max(s.size_m.x, s.size_m.y);
    const double widest = 1.5 * std::hypot(s.size_m.x, s.size_m.y);
    s.bend_per_m = draw.in(0.1, 0.5) / widest;
    s.bend_angle_rad = draw.in(-3.14159, 3.14159);
  }
  return s;
}

/// Points of a mesh, evenly by area, of the triangles that face `eye` where there is one.
std::vector<Vec3> scatter(const Mesh& mesh, int count, const std::optional<Vec3>& eye, Draw& draw) {
  std::vector<double> sums;
  sums.reserve(mesh.triangles.size());
  double sum = 0.0;
  for (const auto& t : mesh.triangles) {
    const Vec3 a = mesh.vertices_m[t[0]];
    const Vec3 twice = cross(mesh.vertices_m[t[1]] - a, mesh.vertices_m[t[2]] - a);
    if (!eye || dot(twice, *eye - a) > 0.0) sum += norm(twice);
    sums.push_back(sum);
  }
  std::vector<Vec3> points;
  while (static_cast<int>(points.size()) < count) {
    const auto at = std::lower_bound(sums.begin(), sums.end(), draw.in(0.0, sum));
    const auto& t = mesh.triangles[static_cast<std::size_t>(at - sums.begin())];
    double u = draw.in(0.0, 1.0);
    double v = draw.in(0.0, 1.0);
    if (u + v > 1.0) u = 1.0 - u, v = 1.0 - v;
    const Vec3 a = mesh.vertices_m[t[0]];
    points.push_back(a + u * (mesh.vertices_m[t[1]] - a) + v * (mesh.vertices_m[t[2]] - a));
  }
  return points;
}

FitView see(const Superquadric& truth, const Mesh& mesh, Draw& draw) {
  constexpr int kPixels = 128;
  constexpr double kAway = 6.0;
  const Vec3 centre = truth.scene_from_shape.translation_m;
  const Vec3 out = unit(draw.gauss3());
  const Vec3 eye = centre + kAway * out;
  const Vec3 helper = std::abs(out.x) < 0.6 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
  const Vec3 z = -out;
  const Vec3 x = unit(cross(z, helper));
  const Vec3 y = cross(z, x);
  const Transform<SceneFrame, CameraFrame> scene_from_camera{
      {x.x, y.x, z.x, x.y, y.y, z.y, x.z, y.z, z.z}, eye, 1.0};
  double widest = 0.0;
  const auto camera_from_scene = scene_from_camera.inverse();
  for (const Vec3 v : mesh.vertices_m) {
    const Vec3 p = (camera_from_scene * Point<SceneFrame>{v}).v;
    widest = std::max({widest, std::abs(p.x / p.z), std::abs(p.y / p.z)});
  }
  const double middle = 0.5 * (kPixels - 1);
  const double focal = 0.45 * kPixels / widest;
  const Pinhole camera{focal, focal, middle, middle, kPixels, kPixels};
  Raster<std::uint8_t> mask(kPixels, kPixels);
  std::array<double, 9> reference{};
  const Parameters parameters = parameters_of(truth, reference);
  const ResidualsAt exact(parameters, reference, kPlainParameters);
  std::vector<LineOfSight> sights;
  for (int row = 0; row < kPixels; ++row)
    for (int column = 0; column < kPixels; ++column) {
      const Vec3 along{(column - middle) / focal, (row - middle) / focal, 1.0};
      sights.push_back({eye, unit(scene_from_camera.rotate(along))});
    }
  RadialDistances distances;
  exact.radial_distances_of(exact.nearest_on(sights), distances);
  std::transform(distances.radial.begin(), distances.radial.end(), mask.values().begin(),
                 [](double r) -> std::uint8_t { return r < 0.0 ? 1 : 0; });
  return {{eye}, outline_of(mask, 1, camera, scene_from_camera)};
}

}  // namespace

FitCase make_fit_case(unsigned seed, const FitCaseOptions& options) {
  Draw draw(seed);
  FitCase made;
  made.truth = draw_shape(draw, options.deformation);
  constexpr double kFine = 0.03;
  const Mesh mesh = models::mesh_of(made.truth, kFine);
  std::optional<Vec3> eye;
  if (options.seen == FitCaseOptions::Seen::half) {
    made.view = see(made.truth, mesh, draw);
    eye = made.view->eye.v;
  }
  made.points = scatter(mesh, options.points, eye, draw);
  for (Vec3& p : made.points) p += options.noise * draw.gauss3();
  const int outliers =
      static_cast<int>(std::lround(options.points * options.outlier_share / (1.0 - options.outlier_share)));
  Vec3 low = mesh.vertices_m.front();
  Vec3 high = low;
  for (const Vec3 v : mesh.vertices_m) {
    low = {std::min(low.x, v.x), std::min(low.y, v.y), std::min(low.z, v.z)};
    high = {std::max(high.x, v.x), std::max(high.y, v.y), std::max(high.z, v.z)};
  }
  const Vec3 middle = 0.5 * (low + high);
  const Vec3 half = high - low;  // the box doubled
  for (int k = 0; k < outliers; ++k) {
    const double x = draw.in(-half.x, half.x);
    const double y = draw.in(-half.y, half.y);
    made.points.push_back(middle + Vec3{x, y, draw.in(-half.z, half.z)});
  }
  // Outliers are at random positions in the list, as in a picture.
  std::mt19937 shuffler(seed);
  std::shuffle(made.points.begin(), made.points.end(), shuffler);
  return made;
}

double mean_radial_error(const Superquadric& fitted, const Superquadric& truth) {
  const auto shape_from_scene = fitted.scene_from_shape.inverse();
  // Centres of a mesh's triangles, by their areas.
  const Mesh mesh = models::mesh_of(truth, 0.1);
  double sum = 0.0;
  double areas = 0.0;
  for (const auto& t : mesh.triangles) {
    const Vec3 a = mesh.vertices_m[t[0]], b = mesh.vertices_m[t[1]], c = mesh.vertices_m[t[2]];
    const Vec3 on = models::on_surface(
        truth,
        models::undeform(truth, (truth.scene_from_shape.inverse() * Point<SceneFrame>{(a + b + c) / 3.0}).v));
    const Point<SceneFrame> place =
        truth.scene_from_shape * Point<models::ShapeFrame>{models::deform(truth, on)};
    const Vec3 straight = models::undeform(fitted, (shape_from_scene * place).v);
    const double area = norm(cross(b - a, c - a));
    sum += area * norm(straight) * std::abs(1.0 - 1.0 / models::gauge(fitted, straight));
    areas += area;
  }
  return sum / areas;
}

}  // namespace palpable::sculpt
