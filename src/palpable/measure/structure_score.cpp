// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/measure/structure_score.hpp"

#include "palpable/core/numbers/quantile.hpp"
#include "palpable/sculpt/triangles/triangle_tree.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace palpable::measure {
namespace {

using sculpt::TriangleTree;

struct Region {
  Vec3 least, most;
  Region larger(double by) const { return {least - Vec3{by, by, by}, most + Vec3{by, by, by}}; }
  double diagonal() const { return norm(most - least); }
  bool contains(Vec3 p) const {
    return p.x >= least.x && p.y >= least.y && p.z >= least.z && p.x <= most.x && p.y <= most.y &&
           p.z <= most.z;
  }
  bool meets(const std::array<Vec3, 3>& triangle) const {
    const auto [a, b, c] = triangle;
    return std::max({a.x, b.x, c.x}) >= least.x && std::min({a.x, b.x, c.x}) <= most.x &&
           std::max({a.y, b.y, c.y}) >= least.y && std::min({a.y, b.y, c.y}) <= most.y &&
           std::max({a.z, b.z, c.z}) >= least.z && std::min({a.z, b.z, c.z}) <= most.z;
  }
};

Region region_of(const std::vector<Vec3>& places, double tail) {
  Region out;
  std::vector<double> values(places.size());
  for (double Vec3::*axis : {&Vec3::x, &Vec3::y, &Vec3::z}) {
    std::transform(places.begin(), places.end(), values.begin(), [axis](Vec3 p) { return p.*axis; });
    out.least.*axis = quantile_of(values, tail);
    out.most.*axis = quantile_of(values, 1 - tail);
  }
  return out;
}

// Points as triangles without area, so that one tree serves both.
TriangleTree tree_of(const std::vector<Vec3>& places) {
  Mesh mesh;
  mesh.vertices_m = places;
  mesh.triangles.resize(places.size());
  for (std::uint32_t i = 0; i < places.size(); ++i) mesh.triangles[i] = {i, i, i};
  return TriangleTree(mesh);
}

TriangleTree tree_of(const TrueSurface& truth) {
  if (const auto* mesh = std::get_if<Mesh>(&truth)) return TriangleTree(*mesh);
  return tree_of(std::get<PointCloud>(truth).places_m);
}

// A sample point of the true surface and the area that it represents.
struct SurfacePiece {
  Vec3 place;
  double area = 1.0;
};

// Bisects the longest edge of the triangle until it is short enough; pieces outside the region are omitted.
void add_pieces(const std::array<Vec3, 3>& triangle, const Region& region, double longest,
                std::vector<SurfacePiece>& to) {
  if (!region.meets(triangle)) return;
  std::size_t edge = 0;
  double length = -1.0;
  for (std::size_t i = 0; i < 3; ++i)
    if (const double l = norm(triangle[(i + 1) % 3] - triangle[i]); l > length) edge = i, length = l;
  if (length <= longest) {
    const auto [a, b, c] = triangle;
    const Vec3 middle = (a + b + c) / 3;
    if (region.contains(middle)) to.push_back({middle, norm(cross(b - a, c - a)) / 2});
    return;
  }
  const Vec3 a = triangle[edge], b = triangle[(edge + 1) % 3], c = triangle[(edge + 2) % 3];
  const Vec3 middle = (a + b) / 2;
  add_pieces({a, middle, c}, region, longest, to);
  add_pieces({middle, b, c}, region, longest, to);
}

std::vector<SurfacePiece> pieces_of(const TrueSurface& truth, const Region& region, double longest) {
  std::vector<SurfacePiece> out;
  if (const auto* mesh = std::get_if<Mesh>(&truth)) {
    for (const auto& [a, b, c] : mesh->triangles)
      add_pieces({mesh->vertices_m[a], mesh->vertices_m[b], mesh->vertices_m[c]}, region, longest, out);
  } else {
    for (const Vec3 place : std::get<PointCloud>(truth).places_m)
      if (region.contains(place)) out.push_back({place});
  }
  return out;
}

// A camera and its inverse.
struct View {
  Transform<CameraFrame, TrueWorldFrame> camera_from_world;
  Vec3 place;
  std::optional<Pinhole> pinhole;

  bool holds(Vec3 p) const {
    if (!pinhole) return true;
    const Vec3 v = (camera_from_world * Point<TrueWorldFrame>{p}).v;
    if (v.z <= 0) return false;
    const double x = pinhole->fx * v.x / v.z + pinhole->cx, y = pinhole->fy * v.y / v.z + pinhole->cy;
    return x >= -0.5 && y >= -0.5 && x < pinhole->width - 0.5 && y < pinhole->height - 0.5;
  }
};

std::vector<View> evenly_chosen(std::span<const TrueCamera> cameras, int most) {
  const std::size_t count = std::min(cameras.size(), static_cast<std::size_t>(most));
  std::vector<View> out;
  for (std::size_t i = 0; i < count; ++i) {
    const TrueCamera& camera = cameras[i * cameras.size() / count];
    out.push_back({camera.pose.inverse(), camera.pose.translation_m, camera.pinhole});
  }
  return out;
}

// Whether a camera sees the point: it is within the picture and no triangle hides it. `step`: the ray starts
// this far in front of the surface, so that it does not meet the triangle that contains the point.
bool is_visible(Vec3 place, const std::vector<View>& views, const TriangleTree* triangles, double step) {
  return std::any_of(views.begin(), views.end(), [&](const View& view) {
    if (!view.holds(place)) return false;
    if (triangles == nullptr) return true;
    const Vec3 direction = unit(view.place - place);
    return triangles->crossings(place + step * direction, direction) ==
           triangles->crossings(view.place, direction);
  });
}

Result<std::vector<double>> distances_of(const std::vector<Vec3>& places, const TriangleTree& tree,
                                         const Work& work) {
  std::vector<double> out(places.size());
  parallel_for(work, static_cast<int>(places.size()), 1024, [&](int begin, int end) {
    std::uint32_t guess = 0;
    for (int i = begin; i < end && !work.cancelled(); ++i) {
      const auto nearest = tree.nearest(places[static_cast<std::size_t>(i)], guess);
      guess = nearest.triangle;
      out[static_cast<std::size_t>(i)] = std::sqrt(nearest.squared_distance_m2);
    }
  });
  if (work.cancelled()) return Work::interrupted();
  return out;
}

double rms_of(const std::vector<double>& values, double most) {
  double sum = 0.0;
  for (const double value : values) sum += std::min(value, most) * std::min(value, most);
  return std::sqrt(sum / static_cast<double>(values.size()));
}

struct FoundShare {
  double of = 0.0, found = 0.0;
  double percent() const { return of > 0 ? 100 * found / of : 0.0; }
};

}  // namespace

std::vector<Parameter> parameters_of(StructureScoreOptions& o) {
  return {{"found_within",
           &o.found_within,
           {0.0001, 0.5},
           "",
           "Distance of a found place, share of the diagonal"},
          {"box_tail", &o.box_tail, {0, 0.2}, "", "Share of the points outside the scored region's box"},
          {"truncated_at", &o.truncated_at, {0.5, 1}, "", "Quantile at which distances are truncated"},
          {"piece", &o.piece, {0.0005, 0.1}, "", "Pieces of true triangles, share of the diagonal"},
          {"most_cameras", &o.most_cameras, {1, 1000}, "", "Cameras that decide what was visible"}};
}

Result<StructureScore> score_structure(const PointCloud& found,
                                       const Transform<TrueWorldFrame, WorldFrame>& true_from_found,
                                       const TrueSurface& truth, std::span<const TrueCamera> cameras,
                                       const StructureScoreOptions& options, const Work& work) {
  if (auto checked = check_ranges(options); !checked) return checked.error();
  constexpr std::size_t kLeastPoints = 10;
  if (found.places_m.size() < kLeastPoints) return invalid_input("fewer than ten points were found");
  const auto* mesh = std::get_if<Mesh>(&truth);
  if (mesh != nullptr ? mesh->triangles.empty() : std::get<PointCloud>(truth).places_m.empty())
    return invalid_input("the true surface is empty");
  std::vector<Vec3> places;
  places.reserve(found.places_m.size());
  for (const Vec3 place : found.places_m) places.push_back((true_from_found * Point<WorldFrame>{place}).v);
  const Region region = region_of(places, options.box_tail);
  StructureScore out;
  out.points = places.size();
  out.diagonal = region.diagonal();
  if (!(out.diagonal > 0)) return invalid_input("all points that were found lie in one place");

  const TriangleTree surface = tree_of(truth);
  auto distances = distances_of(places, surface, work);
  if (!distances) return distances.error();
  const double percent = 100 / out.diagonal;
  out.accuracy_median_percent = percent * quantile_of(*distances, 0.5);
  const double largest = quantile_of(*distances, options.truncated_at);
  out.accuracy_truncated_rms_percent = percent * rms_of(*distances, largest);
  out.accuracy_rms_percent = percent * rms_of(*distances, quantile_of(*distances, 1.0));
  work.report(0.5, "comparing surfaces");

  const double found_within = options.found_within * out.diagonal;
  const auto pieces = pieces_of(truth, region.larger(found_within), options.piece * out.diagonal);
  std::vector<Vec3> true_places;
  for (const SurfacePiece& piece : pieces) true_places.push_back(piece.place);
  const auto missing = distances_of(true_places, tree_of(places), work);
  if (!missing) return missing.error();
  const std::vector<View> views = evenly_chosen(cameras, options.most_cameras);
  const double step = 1e-6 * out.diagonal;
  FoundShare all, visible;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    if (work.cancelled()) return Work::interrupted();
    const double area = pieces[i].area;
    const double found_area = (*missing)[i] <= found_within ? area : 0.0;
    all.of += area, all.found += found_area;
    if (!is_visible(pieces[i].place, views, mesh != nullptr ? &surface : nullptr, step)) continue;
    visible.of += area, visible.found += found_area;
  }
  out.completeness_percent = all.percent();
  if (!views.empty()) out.visible_completeness_percent = visible.percent();
  return out;
}

}  // namespace palpable::measure
