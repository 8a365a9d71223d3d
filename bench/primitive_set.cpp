// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// Superquadrics of whole objects (docs/superquadrics.md): how much of the primitives' surface lies outside of
// the object's silhouette or in front of what is seen, how well they fit, and how many they are. Without
// arguments: generated figures, unions of superquadrics, from seeds 1 to 12. With OBJ files: these. Options
// before them: --seeds FIRST LAST, --pictures FOLDER (object and primitives side by side), --set NAME VALUE.
#include "palpable/core/files/read_file.hpp"
#include "palpable/formats/picture/picture.hpp"
#include "palpable/models/field/superquadric_mesh.hpp"
#include "palpable/recipes/solid/shapes_recipe.hpp"
#include "palpable/sculpt/triangles/box.hpp"
#include "palpable/sculpt/triangles/triangle_tree.hpp"
#include "palpable/sources/solid/mesh_file.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <random>
#include <string>
#include <vector>

namespace {

using namespace palpable;
using models::Superquadric;

constexpr int kPixels = 400;
constexpr double kDistance_m = 0.6;
constexpr double kLongest_m = 0.2;
const Pinhole kCamera{800.0, 800.0, 0.5 * (kPixels - 1), 0.5 * (kPixels - 1), kPixels, kPixels};

/// What a camera at the origin that looks along -z sees of some meshes.
struct View {
  Raster<float> depth_m{kPixels, kPixels, kUnknownDepth};
  Raster<Rgb8> picture{kPixels, kPixels, Rgb8{255, 255, 255}};
};

Vec3 pixel_of(Vec3 p) {
  return {kCamera.cx + kCamera.fx * p.x / -p.z, kCamera.cy - kCamera.fy * p.y / -p.z, -p.z};
}

void draw(View& view, const Mesh& mesh, Rgb8 colour) {
  for (const auto& t : mesh.triangles) {
    const Vec3 a = mesh.vertices_m[t[0]], b = mesh.vertices_m[t[1]], c = mesh.vertices_m[t[2]];
    const Vec3 n = unit(cross(b - a, c - a));
    const double light = 0.25 + 0.75 * std::abs(dot(n, unit(Vec3{0.4, 0.6, 1.0})));
    const auto shade = [&](std::uint8_t v) { return static_cast<std::uint8_t>(std::lround(light * v)); };
    const Vec3 pa = pixel_of(a), pb = pixel_of(b), pc = pixel_of(c);
    const double area = (pb.x - pa.x) * (pc.y - pa.y) - (pb.y - pa.y) * (pc.x - pa.x);
    if (std::abs(area) < 1e-12) continue;
    const auto first = [](double x, double y, double z) {
      return std::max(0, static_cast<int>(std::ceil(std::min({x, y, z}))));
    };
    const auto last = [](double x, double y, double z) {
      return std::min(kPixels - 1, static_cast<int>(std::floor(std::max({x, y, z}))));
    };
    for (int y = first(pa.y, pb.y, pc.y); y <= last(pa.y, pb.y, pc.y); ++y)
      for (int x = first(pa.x, pb.x, pc.x); x <= last(pa.x, pb.x, pc.x); ++x) {
        const double wb = ((x - pa.x) * (pc.y - pa.y) - (y - pa.y) * (pc.x - pa.x)) / area;
        const double wc = ((pb.x - pa.x) * (y - pa.y) - (pb.y - pa.y) * (x - pa.x)) / area;
        if (wb < 0.0 || wc < 0.0 || wb + wc > 1.0) continue;
        const double inverse = (1.0 - wb - wc) / pa.z + wb / pb.z + wc / pc.z;
        const auto z = static_cast<float>(1.0 / inverse);
        if (view.depth_m(x, y) <= z) continue;
        view.depth_m(x, y) = z;
        view.picture(x, y) = {shade(colour.r), shade(colour.g), shade(colour.b)};
      }
  }
}

/// Pixels to the nearest known pixel, at most `most`.
int pixels_outside(const Raster<float>& depth_m, double u, double v, int most) {
  const int x = static_cast<int>(std::lround(u)), y = static_cast<int>(std::lround(v));
  int nearest = most * most;
  for (int b = std::max(0, y - most); b <= std::min(kPixels - 1, y + most); ++b)
    for (int a = std::max(0, x - most); a <= std::min(kPixels - 1, x + most); ++a)
      if (std::isfinite(depth_m(a, b))) nearest = std::min(nearest, (a - x) * (a - x) + (b - y) * (b - y));
  return static_cast<int>(std::sqrt(nearest));
}

/// Farthest depth seen within two pixels; NaN if nothing is.
double nearest_seen_m(const Raster<float>& depth_m, double u, double v) {
  const int x = static_cast<int>(std::lround(u)), y = static_cast<int>(std::lround(v));
  double least = std::nan("");
  for (int b = std::max(0, y - 2); b <= std::min(kPixels - 1, y + 2); ++b)
    for (int a = std::max(0, x - 2); a <= std::min(kPixels - 1, x + 2); ++a) {
      const auto z = static_cast<double>(depth_m(a, b));
      if (!(z >= least)) least = std::isfinite(z) ? z : least;
    }
  return least;
}

struct Shares {
  double outside = 0.0, in_front = 0.0;
};

/// Of the primitives' surface: more than 5 px outside of the silhouette; in front of what is seen by more
/// than 2 % of the object's longest side.
Shares beyond(const std::vector<Superquadric>& shapes, const Raster<float>& depth_m) {
  constexpr int kMost_px = 5;
  Shares shares;
  double all = 0.0;
  for (const Superquadric& s : shapes) {
    const Mesh mesh = models::mesh_of(s, 0.01 * kLongest_m);
    for (const auto& t : mesh.triangles) {
      const Vec3 a = mesh.vertices_m[t[0]], b = mesh.vertices_m[t[1]], c = mesh.vertices_m[t[2]];
      const double area = norm(cross(b - a, c - a));
      all += area;
      const Vec3 p = pixel_of((a + b + c) / 3.0);
      if (pixels_outside(depth_m, p.x, p.y, kMost_px + 1) > kMost_px)
        shares.outside += area;
      else if (nearest_seen_m(depth_m, p.x, p.y) - p.z > 0.02 * kLongest_m)
        shares.in_front += area;
    }
  }
  return {shares.outside / all, shares.in_front / all};
}

/// Mean distance of the object's surface from the primitives' surface, share of the longest side.
double error_of(const std::vector<Superquadric>& shapes, const std::vector<Vec3>& points) {
  Mesh all;
  for (const Superquadric& s : shapes) {
    const Mesh mesh = models::mesh_of(s, 0.01 * kLongest_m);
    const auto first = static_cast<std::uint32_t>(all.vertices_m.size());
    all.vertices_m.insert(all.vertices_m.end(), mesh.vertices_m.begin(), mesh.vertices_m.end());
    for (auto t : mesh.triangles) all.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
  }
  const sculpt::TriangleTree tree(all);
  double sum = 0.0;
  std::size_t count = 0;
  for (std::size_t i = 0; i < points.size(); i += 7, ++count)
    sum += std::sqrt(tree.nearest(points[i], 0).squared_distance_m2);
  return sum / static_cast<double>(count) / kLongest_m;
}

std::vector<Vec3> scattered(const Mesh& mesh, int count, std::mt19937& random) {
  std::vector<double> sums;
  double sum = 0.0;
  for (const auto& t : mesh.triangles) {
    const Vec3 a = mesh.vertices_m[t[0]];
    sum += norm(cross(mesh.vertices_m[t[1]] - a, mesh.vertices_m[t[2]] - a));
    sums.push_back(sum);
  }
  std::uniform_real_distribution<double> any(0.0, 1.0);
  std::vector<Vec3> points;
  for (int k = 0; k < count; ++k) {
    const auto at = std::lower_bound(sums.begin(), sums.end(), sum * any(random));
    const auto& t = mesh.triangles[static_cast<std::size_t>(std::min(at, sums.end() - 1) - sums.begin())];
    double u = any(random), v = any(random);
    if (u + v > 1.0) u = 1.0 - u, v = 1.0 - v;
    const Vec3 a = mesh.vertices_m[t[0]];
    points.push_back(a + u * (mesh.vertices_m[t[1]] - a) + v * (mesh.vertices_m[t[2]] - a));
  }
  return points;
}

/// A body, a head and limbs: superquadrics of random form that overlap where they meet.
std::vector<Superquadric> figure(unsigned seed) {
  std::mt19937 random(seed);
  const auto in = [&](double least, double most) {
    return std::uniform_real_distribution<double>(least, most)(random);
  };
  const auto part = [&](Vec3 at, Vec3 half, double turn) {
    Superquadric s;
    s.size_m = half;
    s.e1 = in(0.3, 1.0), s.e2 = in(0.3, 1.0);
    s.taper_x = s.taper_y = in(0.0, 1.0) < 0.5 ? in(-0.5, 0.5) : 0.0;
    // z of the shape is up; it leans in the picture's plane.
    const double c = std::cos(turn), n = std::sin(turn);
    s.scene_from_shape = {{c, 0, n, -n, 0, c, 0, -1, 0}, at, 1.0};
    return s;
  };
  const Vec3 body{in(0.25, 0.45), in(0.2, 0.35), in(0.4, 0.7)};
  std::vector<Superquadric> parts{part({}, body, 0.0)};
  const double head = in(0.2, 0.35);
  parts.push_back(part({0, body.z + 0.7 * head, 0}, {head, head * in(0.8, 1.0), head * in(0.8, 1.2)}, 0.0));
  if (in(0.0, 1.0) < 0.7)
    for (const double side : {-1.0, 1.0}) {
      const double length = in(0.3, 0.5), turn = side * in(0.6, 1.4);
      parts.push_back(part({side * (body.x + 0.7 * length * std::abs(std::sin(turn))), 0.4 * body.z, 0},
                           {in(0.08, 0.13), in(0.08, 0.13), length}, turn));
    }
  if (in(0.0, 1.0) < 0.7)
    for (const double side : {-1.0, 1.0})
      parts.push_back(
          part({side * 0.6 * body.x, -body.z - 0.3, 0}, {in(0.1, 0.15), in(0.1, 0.15), in(0.35, 0.45)}, 0.0));
  return parts;
}

Mesh mesh_of(const std::vector<Superquadric>& parts) {
  Mesh all;
  for (const Superquadric& s : parts) {
    const Mesh mesh = models::mesh_of(s, 0.02);
    const auto first = static_cast<std::uint32_t>(all.vertices_m.size());
    all.vertices_m.insert(all.vertices_m.end(), mesh.vertices_m.begin(), mesh.vertices_m.end());
    for (auto t : mesh.triangles) all.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
  }
  return all;
}

/// Before the camera, turned about y.
void place(Mesh& mesh, double turn) {
  const double c = std::cos(turn), s = std::sin(turn);
  for (Vec3& v : mesh.vertices_m) v = {c * v.x + s * v.z, v.y, c * v.z - s * v.x};
  const sculpt::Box box = sculpt::bounds_of(mesh);
  const Vec3 size = box.size_m(), middle = 0.5 * (box.least_m + box.most_m);
  for (Vec3& v : mesh.vertices_m)
    v = kLongest_m / std::max({size.x, size.y, size.z}) * (v - middle) + Vec3{0, 0, -kDistance_m};
}

Rgb8 colour_of(std::size_t k) {
  constexpr std::array<Rgb8, 10> kColours{Rgb8{230, 80, 70}, {80, 160, 230}, {250, 200, 60}, {110, 190, 90},
                                          {190, 110, 210},   {250, 150, 60}, {90, 200, 200}, {240, 130, 180},
                                          {150, 130, 100},   {130, 140, 230}};
  return kColours[k % kColours.size()];
}

void write_beside(const std::string& path, const View& left, const View& right) {
  Raster<Rgb8> both(2 * kPixels, kPixels);
  for (int y = 0; y < kPixels; ++y)
    for (int x = 0; x < kPixels; ++x)
      both(x, y) = left.picture(x, y), both(kPixels + x, y) = right.picture(x, y);
  if (const auto written = formats::write_png(path, both); !written)
    std::printf("%s\n", written.error().sentence().c_str());
}

struct Sums {
  Shares beyond;
  double error = 0.0, shapes = 0.0, worst = 0.0, seconds = 0.0;
  int count = 0;
};

void measure(const std::string& name, const Mesh& mesh, bool from_view,
             const sculpt::ShapeSetOptions& options, const std::string& pictures, Sums& sums) {
  View seen;
  draw(seen, mesh, {200, 200, 200});
  std::mt19937 random(7);
  recipes::SeenPoints points;
  if (from_view) {
    points = *recipes::points_of_depth({seen.depth_m, kCamera}, {});
  } else {
    points.points_m = scattered(mesh, 20000, random);
  }
  const std::clock_t begin = std::clock();
  const auto fitted = recipes::shapes_from_points(points, options, Work{});
  const double seconds = static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
  if (!fitted) {
    std::printf("%s: %s\n", name.c_str(), fitted.error().sentence().c_str());
    return;
  }
  std::vector<Superquadric> shapes;
  int tapered = 0, bent = 0;
  for (const auto& s : fitted->set.shapes) {
    shapes.push_back(s.shape);
    if (s.shape.bend_per_m > 0.0)
      ++bent;
    else if (s.shape.deformed())
      ++tapered;
  }
  const Shares share = beyond(shapes, seen.depth_m);
  const double error = error_of(shapes, points.points_m);
  std::printf(
      "%-26s %3zu shapes (%d tapered, %d bent), outside %5.2f %%, in front %5.2f %%, error %.2f %%, "
      "left out %4.1f %%, %5.1f s\n",
      name.c_str(), shapes.size(), tapered, bent, 100.0 * share.outside, 100.0 * share.in_front,
      100.0 * error, 100.0 * fitted->set.left_out, seconds);
  std::fflush(stdout);
  sums.beyond.outside += share.outside, sums.beyond.in_front += share.in_front;
  sums.worst = std::max(sums.worst, share.outside);
  sums.error += error, sums.shapes += static_cast<double>(shapes.size()), sums.seconds += seconds,
      ++sums.count;
  if (pictures.empty()) return;
  View made;
  for (std::size_t k = 0; k < shapes.size(); ++k) draw(made, models::mesh_of(shapes[k], 0.002), colour_of(k));
  write_beside(pictures + "/" + name + ".png", seen, made);
}

void print(const char* what, const Sums& s) {
  if (s.count == 0) return;
  std::printf(
      "%s, mean of %d: %.1f shapes, outside %.2f %% (worst %.2f), in front %.2f %%, error %.2f %%, %.1f s\n",
      what, s.count, s.shapes / s.count, 100.0 * s.beyond.outside / s.count, 100.0 * s.worst,
      100.0 * s.beyond.in_front / s.count, 100.0 * s.error / s.count, s.seconds / s.count);
}

}  // namespace

int main(int argc, char** argv) {
  unsigned first = 1, last = 12;
  std::string pictures;
  sculpt::ShapeSetOptions options;
  std::vector<std::string> files;
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    if (word == "--seeds" && i + 2 < argc) {
      first = static_cast<unsigned>(std::atoi(argv[++i])), last = static_cast<unsigned>(std::atoi(argv[++i]));
    } else if (word == "--pictures" && i + 1 < argc) {
      pictures = argv[++i];
    } else if (word == "--set" && i + 2 < argc) {
      const std::string name = argv[++i];
      for (const Parameter& p : parameters_of(options))
        if (p.name == name) (void)set_parameter(p, std::atof(argv[i + 1]));
      ++i;
    } else {
      files.push_back(word);
    }
  }
  Sums views, clouds;
  const auto both = [&](const std::string& name, Mesh mesh, double turn) {
    place(mesh, turn);
    measure(name + "-view", mesh, true, options, pictures, views);
    measure(name + "-cloud", mesh, false, options, pictures, clouds);
  };
  for (const std::string& file : files) {
    const auto bytes = read_file(file);
    if (!bytes) return 1;
    auto mesh = sources::decode_mesh(*bytes, "obj");
    if (!mesh) return 1;
    const auto begin = file.find_last_of('/') + 1;
    both(file.substr(begin, file.find_last_of('.') - begin), std::move(*mesh), 0.5);
  }
  if (files.empty())
    for (unsigned seed = first; seed <= last; ++seed) {
      const auto parts = figure(seed);
      both("figure" + std::to_string(seed) + "(" + std::to_string(parts.size()) + ")", mesh_of(parts),
           0.3 * (seed % 5));
    }
  print("views", views);
  print("clouds", clouds);
  return 0;
}
