// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// Correction of a field by a measured surface, step by step (docs/fields.md): a ball of 60 mm at 512 cells,
// and patches of its surface measured 2 mm farther out. The preparation of the first of many corrections is
// not timed.
#include "palpable/models/field/superquadric_mesh.hpp"
#include "palpable/sculpt/correction/field_correction.hpp"
#include "palpable/sculpt/correction/field_update.hpp"
#include "palpable/sculpt/solid/mesh_distance.hpp"
#include "palpable/sculpt/solid/smooth_surface.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <random>
#include <utility>
#include <vector>

namespace {

using namespace palpable;
using namespace palpable::sculpt;

constexpr double kRadius_m = 0.03, kSpacing_m = 0.0006;

Mesh ball(double radius_m) {
  models::Superquadric s;
  s.size_m = {radius_m, radius_m, radius_m};
  return models::mesh_of(s, kSpacing_m);
}

/// The cap around +z with this fraction of the surface of a ball.
Mesh patch(double radius_m, double share) {
  Mesh mesh = ball(radius_m);
  const double cut_m = radius_m * (1.0 - 2.0 * share);
  std::erase_if(mesh.triangles, [&](const auto& t) {
    return std::any_of(t.begin(), t.end(), [&](std::uint32_t i) { return mesh.vertices_m[i].z < cut_m; });
  });
  return mesh;
}

class Watch {
 public:
  double lap_ms() {
    const auto now = std::chrono::steady_clock::now();
    const std::chrono::duration<double, std::milli> lap = now - begin_;
    begin_ = now;
    return lap.count();
  }

 private:
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
};

/// Errors of a corrected field where its bound holds: distances and directions from 3 mm inside to 1 mm
/// outside, over a cap three times as wide as the measured one.
void print_errors(const CorrectedField& corrected, double share) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  std::vector<double> near_m, near_turn, deep_m, deep_turn;
  const double least_cosine = std::max(-1.0, 1.0 - 6.0 * share);
  for (int i = 0; i < 40000; ++i) {
    const double cosine = 1.0 - (1.0 - least_cosine) * uniform(random);
    const double sine = std::sqrt(1.0 - cosine * cosine), angle = 2.0 * std::numbers::pi * uniform(random);
    const double radius_m = kRadius_m + 0.002 - 0.012 * uniform(random);
    const Vec3 place = radius_m * Vec3{sine * std::cos(angle), sine * std::sin(angle), cosine};
    DistanceSource::Hint hint;
    const models::DistanceSample truth = corrected.solid->at(place, hint);
    const models::FieldSample is = corrected.field.sample({place});
    const bool near = truth.distance_m > -0.003 && truth.distance_m < 0.001;
    (near ? near_m : deep_m).push_back(std::abs(is.distance_m - truth.distance_m));
    (near ? near_turn : deep_turn).push_back(norm(is.gradient.v - truth.gradient));
  }
  const auto of = [](std::vector<double>& all, double quantile) {
    std::sort(all.begin(), all.end());
    return all[static_cast<std::size_t>(quantile * static_cast<double>(all.size() - 1))];
  };
  std::printf(
      "       near the surface %.1f um (99 %%), %.1f um at most, gradient %.4f (99 %%), %.4f; deeper %.1f "
      "um, gradient %.4f (99 %%)\n",
      1e6 * of(near_m, 0.99), 1e6 * of(near_m, 1.0), of(near_turn, 0.99), of(near_turn, 1.0),
      1e6 * of(deep_m, 0.99), of(deep_turn, 0.99));
}

bool measure(const CorrectedField& before, double share, double out_m) {
  const CorrectionOptions correction{0.004, 0.005};
  const Mesh measured = patch(kRadius_m + out_m, share);
  CorrectedField parts = before, whole = before;
  Watch watch;
  const auto surface = correct_surface(std::move(parts.surface), measured, correction, {});
  if (!surface) return false;
  const double surface_ms = watch.lap_ms();
  std::vector<SmoothSurface::Move> moves;
  for (const auto& m : surface->moved)
    moves.push_back({m.sample, surface->predicted.vertices_m[m.sample] + surface->translations_m[m.sample]});
  parts.solid->move(moves);
  const SolidChange change = change_of(*surface, parts.field.cell_m(), correction);
  const double distance_ms = watch.lap_ms();
  const auto field = updated_field(parts.field, *parts.solid, change, {}, {});
  if (!field || !*field) return false;
  const double field_ms = watch.lap_ms();
  const auto corrected = corrected_field(std::move(whole), measured, correction, {}, {});
  if (!corrected) return false;
  std::printf(
      "%4.1f %% measured %.1f mm out, %4.1f %% of the samples moved, %zu cells: %5.0f ms (surface "
      "%.0f, "
      "its distance %.0f, field %.0f)\n",
      100.0 * share, 1e3 * out_m,
      100.0 * static_cast<double>(moves.size()) / static_cast<double>(surface->predicted.vertices_m.size()),
      corrected->field.leaves(), watch.lap_ms(), surface_ms, distance_ms, field_ms);
  print_errors(*corrected, share);
  return true;
}

}  // namespace

int main() {
  const Mesh mesh = ball(kRadius_m);
  auto surface = predicted_surface(mesh);
  auto field = field_from_source(*mesh_distance(mesh, mesh), {}, {});
  if (!surface || !field) return 1;
  Watch watch;
  SmoothSurface solid(mesh);
  std::printf("%zu triangles, %zu cells; prepared in %.0f ms\n", mesh.triangles.size(), field->leaves(),
              watch.lap_ms());
  const CorrectedField before{*std::move(field), *std::move(surface), std::move(solid)};
  for (const double out_m : {0.0003, 0.001})
    for (const double share : {0.001, 0.01, 0.1})
      if (!measure(before, share, out_m)) return 1;
  return 0;
}
