// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// Fields of scanned meshes (docs/fields.md): size in memory and on disk, processor time, errors against the
// mesh's own facets, the time of single queries of a moving hand, and where the gradient is too long. Without
// arguments: the generated meshes on which the parameters were chosen, at a reduced size (50 mm, 256 cells,
// 20 000 triangles). With OBJ files: these, of 100 mm at 512 cells. --noise TURN RISE comes first and sets
// how closely a field follows a scan's noise.
#include "palpable/core/files/read_file.hpp"
#include "palpable/formats/scene/scene_file.hpp"
#include "palpable/models/scene/scene.hpp"
#include "palpable/sculpt/field/field_from_source.hpp"
#include "palpable/sculpt/solid/mesh_solid.hpp"
#include "palpable/sources/solid/mesh_file.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "path_under_surface.hpp"
#include "scanned_meshes.hpp"

namespace {

using namespace palpable;

double processor_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

/// RMS errors of distance (um) and direction (degrees) against the facets, from 3 mm inside to 1 mm outside.
void print_errors(const models::DistanceField& field, const sculpt::DistanceSource& facets) {
  std::mt19937_64 random(17);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  sculpt::DistanceSource::Hint hint;
  constexpr int kEnough = 20000;
  double squares = 0.0, turned = 0.0;
  std::vector<double> errors;
  while (errors.size() < kEnough) {
    const double x = uniform(random), y = uniform(random), z = uniform(random);
    const Vec3 size = field.size_m();
    const Vec3 p = field.origin_m() + Vec3{x * size.x, y * size.y, z * size.z};
    const models::FieldSample s = field.sample({p});
    if (!(s.distance_m < 0.001 && s.distance_m > -0.003)) continue;
    const models::DistanceSample truth = facets.at(p, hint);
    const double error = s.distance_m - truth.distance_m;
    squares += error * error;
    turned += squared_norm(unit(s.gradient.v) - truth.gradient);
    errors.push_back(std::abs(error));
  }
  std::sort(errors.begin(), errors.end());
  std::printf("  beside the facets: %.1f um rms, 99 %% %.1f um, most %.1f um; %.1f degrees rms\n",
              1e6 * std::sqrt(squares / kEnough), 1e6 * errors[kEnough * 99 / 100], 1e6 * errors.back(),
              57.29578 * std::sqrt(turned / kEnough));
}

/// Whether the window of a query lies within one leaf.
bool is_within_one_leaf(const models::DistanceField& field, Vec3 p) {
  const Vec3 c = (1.0 / field.cell_m()) * (p - field.origin_m());
  const auto leaf = field.leaf_of(static_cast<int>(c.x), static_cast<int>(c.y), static_cast<int>(c.z));
  const auto within = [&](double v, std::size_t axis) {
    return v - 0.5 >= leaf.corner[axis] && v + 0.5 <= leaf.corner[axis] + leaf.side;
  };
  return within(c.x, 0) && within(c.y, 1) && within(c.z, 2);
}

/// Times single queries of a hand half a millimetre under the surface, at 1000 Hz.
void print_times(const models::DistanceField& field, double speed_m_per_s) {
  using Clock = std::chrono::steady_clock;
  constexpr int kTicks = 60000;
  const std::vector<Vec3> path = bench::walk_under_surface(field, kTicks, speed_m_per_s);
  std::vector<double> times_ns, empty_ns;
  times_ns.reserve(kTicks);
  empty_ns.reserve(kTicks);
  double sum = 0.0;
  for (const Vec3 p : path) {
    const auto before = Clock::now();
    const auto begin = Clock::now();
    const models::FieldSample s = field.sample({p});
    sum += s.distance_m + s.gradient.v.x;
    const auto end = Clock::now();
    empty_ns.push_back(1e9 * std::chrono::duration<double>(begin - before).count());
    times_ns.push_back(1e9 * std::chrono::duration<double>(end - begin).count());
  }
  const auto single =
      std::count_if(path.begin(), path.end(), [&](Vec3 p) { return is_within_one_leaf(field, p); });
  std::sort(times_ns.begin(), times_ns.end());
  std::sort(empty_ns.begin(), empty_ns.end());
  const auto at = [&](double share) {
    return times_ns[static_cast<std::size_t>(share * (kTicks - 1))] - empty_ns[empty_ns.size() / 2];
  };
  if (!std::isfinite(sum)) std::printf("a query is no number\n");
  std::printf(
      "  %.2f m/s: median %.0f ns, 99 %% %.0f ns, 99.9 %% %.0f ns; window within one leaf in %.0f %%\n",
      speed_m_per_s, at(0.5), at(0.99), at(0.999), 100.0 * static_cast<double>(single) / kTicks);
}

/// How often the gradient is longer than 1.05 from 3 mm inside to 1 mm outside, by how much the true gradient
/// turns between the six places one finest cell away.
void print_lengths(const models::DistanceField& field, const sculpt::DistanceSource& truth) {
  constexpr std::array kTurns{0.02, 0.1, 0.5, 3.0};
  std::array<int, kTurns.size()> places{}, longer{};
  std::mt19937_64 random(17);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  sculpt::DistanceSource::Hint hint;
  for (int count = 0; count < 20000;) {
    const double x = uniform(random), y = uniform(random), z = uniform(random);
    const Vec3 size = field.size_m(), p = field.origin_m() + Vec3{x * size.x, y * size.y, z * size.z};
    const models::FieldSample s = field.sample({p});
    if (!(s.distance_m < 0.001 && s.distance_m > -0.003)) continue;
    ++count;
    std::array<Vec3, 6> around;
    for (std::size_t k = 0; k < around.size(); ++k) {
      const double step_m = k % 2 == 0 ? field.cell_m() : -field.cell_m();
      const Vec3 step{k / 2 == 0 ? step_m : 0.0, k / 2 == 1 ? step_m : 0.0, k / 2 == 2 ? step_m : 0.0};
      around[k] = truth.at(p + step, hint).gradient;
    }
    double turn = 0.0;
    for (const Vec3 a : around)
      for (const Vec3 b : around) turn = std::max(turn, norm(a - b));
    std::size_t k = 0;
    while (turn > kTurns[k]) ++k;
    ++places[k];
    longer[k] += norm(s.gradient.v) > 1.05 ? 1 : 0;
  }
  for (std::size_t k = 0; k < kTurns.size(); ++k)
    if (places[k] > 0)
      std::printf(
          "  true gradient turns by at most %.2f: %.1f %% of the places, longer than 1.05 in %.2f %% of "
          "these\n",
          kTurns[k], places[k] / 200.0, 100.0 * longer[k] / places[k]);
}

void measure(const std::string& name, const Mesh& mesh, int resolution, sculpt::FacetOptions facets) {
  const sculpt::FieldOptions options{.resolution = resolution, .max_error_m = 1e-5};
  const sculpt::Box box = sculpt::bounds_of(mesh);
  const auto cell_m = sculpt::finest_cell_m(box, options);
  if (!cell_m) return;
  Work work;
  work.threads = 1;
  const double begin = processor_seconds();
  facets.rounding_m = sculpt::facet_rounding_m(box, options);
  const auto solid = sculpt::solid_from_mesh(mesh, *cell_m, work, facets);
  if (!solid) return;
  const double solid_s = processor_seconds() - begin;
  auto field = sculpt::field_from_source(*solid->distance, options, work);
  if (!field) return;
  const double field_s = processor_seconds() - begin - solid_s;
  const auto exact = sculpt::solid_from_mesh(mesh, *cell_m, work);
  std::printf("%s: %zu triangles, %zu rounded, %zu cells\n", name.c_str(), mesh.triangles.size(),
              solid->repair.rounded, field->leaves());
  for (const double speed : {0.02, 0.1, 0.3, 1.0}) print_times(*field, speed);
  print_lengths(*field, *solid->distance);
  if (exact) print_errors(*field, *exact->distance);
  const double memory_MB = 1e-6 * static_cast<double>(field->memory_bytes());
  auto whole = models::field_of(*std::move(field), box.least_m, box.most_m);
  if (!whole) return;
  models::Scene scene;
  scene.model = std::make_shared<const models::Field>(*std::move(whole));
  const auto file = formats::encode_scene(scene);
  std::printf(
      "  %.2f MB in memory, %.2f MB on disk, processor time %.2f s for the solid, %.2f s for the field\n",
      memory_MB, file ? 1e-6 * static_cast<double>(file->size()) : 0.0, solid_s, field_s);
  std::fflush(stdout);
}

void scale_to(Mesh& mesh, double longest_m) {
  const sculpt::Box box = sculpt::bounds_of(mesh);
  const Vec3 size = box.size_m(), middle = 0.5 * (box.least_m + box.most_m);
  for (Vec3& v : mesh.vertices_m) v = longest_m / std::max({size.x, size.y, size.z}) * (v - middle);
}

}  // namespace

int main(int argc, char** argv) {
  using bench::ScannedKind;
  sculpt::FacetOptions facets;
  int first = 1;
  if (argc > 3 && std::string(argv[1]) == "--noise") {
    facets.noise_turn_share = std::atof(argv[2]);
    facets.noise_rise_share = std::atof(argv[3]);
    first = 4;
  }
  if (argc == first)
    for (const auto kind : {ScannedKind::noisy_ball, ScannedKind::bumpy_superquadric, ScannedKind::terrain,
                            ScannedKind::overlapping_bodies})
      for (const std::uint32_t seed : {1U, 2U, 3U})
        measure(std::string(bench::name_of(kind)) + " " + std::to_string(seed),
                bench::scanned_mesh(kind, seed, 20000, 0.05), 256, facets);
  for (int i = first; i < argc; ++i) {
    const auto file = read_file(argv[i]);
    if (!file) return 1;
    auto mesh = sources::decode_mesh(*file, "obj");
    if (!mesh) return 1;
    scale_to(*mesh, 0.1);
    measure(argv[i], *mesh, 512, facets);
  }
  return 0;
}
