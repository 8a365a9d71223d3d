// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// Errors of a mesh's field against its exact distance (docs/fields.md): a model of 100 mm at 512 cells, from
// 3 mm inside to 1 mm outside. Objects of an OBJ file whose name ends with "_table" are left out. Queries are
// timed with warm caches along a path, and with cold caches (x86 only). With --dense as the first argument,
// also for both kinds of dense field: size, build time and query time.
#include "palpable/core/files/read_file.hpp"
#include "palpable/formats/scene/scene_file.hpp"
#include "palpable/models/scene/scene.hpp"
#include "palpable/sculpt/field/dense_field_from_source.hpp"
#include "palpable/sculpt/field/field_from_source.hpp"
#include "palpable/sculpt/solid/mesh_solid.hpp"
#include "palpable/sources/solid/mesh_file.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include "path_under_surface.hpp"

namespace {

using namespace palpable;

std::string without_table(const std::string& obj) {
  std::istringstream lines(obj);
  std::string line, kept;
  bool table = false;
  while (std::getline(lines, line)) {
    if (line.starts_with("o ")) table = line.ends_with("_table");
    if (table && line.starts_with("f ")) continue;
    kept += line + "\n";
  }
  return kept;
}

/// Scales the mesh so that its longest side is 100 mm.
void scale_to_hand(Mesh& mesh) {
  const sculpt::Box box = sculpt::bounds_of(mesh);
  const Vec3 size = box.size_m(), middle = 0.5 * (box.least_m + box.most_m);
  const double scale = 0.1 / std::max({size.x, size.y, size.z});
  for (Vec3& v : mesh.vertices_m) v = scale * (v - middle);
}

/// Whether the true distance is smooth around a point: its gradient changes by at most 0.1 within two cells.
bool is_smooth(const sculpt::DistanceSource& source, Vec3 p, Vec3 gradient, double cell_m,
               sculpt::DistanceSource::Hint& hint) {
  for (unsigned k = 0; k < 14; ++k) {
    Vec3 way = k < 8 ? Vec3{k & 1U ? 1.0 : -1.0, k & 2U ? 1.0 : -1.0, k & 4U ? 1.0 : -1.0} : Vec3{};
    if (k == 8 || k == 9) way.x = k == 8 ? 1.0 : -1.0;
    if (k == 10 || k == 11) way.y = k == 10 ? 1.0 : -1.0;
    if (k == 12 || k == 13) way.z = k == 12 ? 1.0 : -1.0;
    constexpr double kTurn = 0.1;
    if (norm(source.at(p + 2.0 * cell_m * unit(way), hint).gradient - gradient) > kTurn) return false;
  }
  return true;
}

struct Errors {
  std::vector<double> values;
  void print(const char* name, const char* unit, double scale) {
    if (values.empty()) return;
    std::sort(values.begin(), values.end());
    const auto at = [&](double share) {
      return scale * values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
    };
    std::printf("  %-34s %7zu places: 99 %% %8.3f, 99.9 %% %8.3f, greatest %8.3f %s\n", name, values.size(),
                at(0.99), at(0.999), at(1.0), unit);
  }
};

struct Worst {
  double error_m = 0.0;
  Vec3 place_m;
  double felt_m = 0.0, truth_m = 0.0;
};

template <models::DistanceSurface Distance>
void measure(const Distance& field, const sculpt::DistanceSource& source) {
  std::mt19937_64 random(17);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  const Vec3 size = field.size_m();
  sculpt::DistanceSource::Hint hint;
  Errors smooth, edges, deep, length, turned;
  std::vector<Worst> worst;
  for (int i = 0; i < 4'000'000; ++i) {
    const double x = uniform(random), y = uniform(random), z = uniform(random);
    const Vec3 p = field.origin_m() + Vec3{x * size.x, y * size.y, z * size.z};
    const models::FieldSample felt = field.sample({p});
    if (!(felt.distance_m < 0.001)) continue;
    const bool is_deep = felt.distance_m <= -0.003;
    constexpr int kDeepOneOf = 8;
    if (is_deep && i % kDeepOneOf != 0) continue;
    const models::DistanceSample truth = source.at(p, hint);
    const double error_m = std::abs(felt.distance_m - truth.distance_m);
    if (is_deep) {
      deep.values.push_back(error_m);
      continue;
    }
    if (is_smooth(source, p, truth.gradient, field.cell_m(), hint)) {
      smooth.values.push_back(error_m);
      length.values.push_back(std::abs(norm(felt.gradient.v) - 1.0));
      turned.values.push_back(std::acos(std::clamp(dot(unit(felt.gradient.v), truth.gradient), -1.0, 1.0)));
    } else {
      edges.values.push_back(error_m);
    }
    worst.push_back({error_m, p, felt.distance_m, truth.distance_m});
    std::push_heap(worst.begin(), worst.end(),
                   [](const Worst& a, const Worst& b) { return a.error_m > b.error_m; });
    if (worst.size() > 8) {
      std::pop_heap(worst.begin(), worst.end(),
                    [](const Worst& a, const Worst& b) { return a.error_m > b.error_m; });
      worst.pop_back();
    }
  }
  smooth.print("where smooth, distance", "um", 1e6);
  length.print("where smooth, |grad D| - 1", "%", 100.0);
  turned.print("where smooth, direction", "degrees", 180.0 / std::numbers::pi);
  edges.print("edges and medial sheets, distance", "um", 1e6);
  deep.print("deeper inside, distance", "um", 1e6);
  std::sort(worst.begin(), worst.end(), [](const Worst& a, const Worst& b) { return a.error_m > b.error_m; });
  for (const Worst& w : worst)
    std::printf("  %6.1f um at %.4f %.4f %.4f mm: felt %.4f, true %.4f mm\n", 1e6 * w.error_m,
                1e3 * w.place_m.x, 1e3 * w.place_m.y, 1e3 * w.place_m.z, 1e3 * w.felt_m, 1e3 * w.truth_m);
}

using Clock = std::chrono::steady_clock;
double seconds_since(Clock::time_point begin) {
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

/// Nanoseconds for distance and gradient: the median of nine runs along a path near the surface.
template <models::DistanceSurface Distance>
double query_ns(const Distance& field) {
  constexpr int kPlaces = 200000;
  const std::vector<Vec3> path = bench::path_under_surface(field, kPlaces);
  std::array<double, 9> runs{};
  double sum = 0.0;
  for (double& run : runs) {
    const auto begin = Clock::now();
    for (const Vec3 p : path) {
      const models::FieldSample s = field.sample({p});
      sum += s.distance_m + s.gradient.v.x;
    }
    run = 1e9 * seconds_since(begin) / kPlaces;
  }
  std::sort(runs.begin(), runs.end());
  if (!std::isfinite(sum)) std::printf("a query is no number\n");
  return runs[runs.size() / 2];
}

#if defined(__x86_64__)
/// Single queries at random points near the surface, with the whole field flushed from the processor's caches
/// before each; the cost of reading the clock is subtracted.
void print_cold(const models::DistanceField& field) {
  constexpr int kQueries = 1500;
  constexpr std::size_t kLine = 64;
  const auto forget = [](const std::vector<std::uint32_t>& words) {
    const auto* bytes = reinterpret_cast<const char*>(words.data());
    for (std::size_t i = 0; i < sizeof(std::uint32_t) * words.size(); i += kLine)
      __builtin_ia32_clflush(bytes + i);
  };
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  std::vector<double> times_ns, nothing_ns;
  double sum = 0.0;
  while (times_ns.size() < kQueries) {
    const double x = uniform(random), y = uniform(random), z = uniform(random);
    const Vec3 size = field.size_m();
    const Vec3 p = field.origin_m() + Vec3{x * size.x, y * size.y, z * size.z};
    if (std::abs(field.sample({p}).distance_m) > 0.001) continue;
    forget(field.tree().roots);
    forget(field.tree().nodes);
    forget(field.tree().words);
    __builtin_ia32_mfence();
    const auto before = Clock::now();
    const auto begin = Clock::now();
    const models::FieldSample s = field.sample({p});
    sum += s.distance_m + s.gradient.v.x;
    const auto end = Clock::now();
    nothing_ns.push_back(1e9 * std::chrono::duration<double>(begin - before).count());
    times_ns.push_back(1e9 * std::chrono::duration<double>(end - begin).count());
  }
  std::sort(times_ns.begin(), times_ns.end());
  std::sort(nothing_ns.begin(), nothing_ns.end());
  if (!std::isfinite(sum)) std::printf("a query is no number\n");
  const auto at = [&](double share) {
    return times_ns[static_cast<std::size_t>(share * (kQueries - 1))] - nothing_ns[nothing_ns.size() / 2];
  };
  std::printf("  cold, near the surface: median %.0f ns, 90 %% %.0f, 99 %% %.0f, most %.0f\n", at(0.5),
              at(0.9), at(0.99), at(1.0));
}
#endif

/// One representation of the field: its size in memory and in a scene file, its build time and its query
/// time.
template <models::DistanceSurface Distance>
void print_field(const char* name, Distance distance, double build_s, const sculpt::DistanceSource& source) {
  const double memory_MB = 1e-6 * static_cast<double>(distance.memory_bytes()), ns = query_ns(distance);
  measure(distance, source);
  const sculpt::Box box = source.bounds();
  auto field = models::field_of(std::move(distance), box.least_m, box.most_m);
  if (!field) return;
  models::Scene scene;
  scene.model = std::make_shared<const models::SolidField<Distance>>(*std::move(field));
  const auto file = formats::encode_scene(scene);
  std::printf("  %s: %.2f MB in memory, %.2f MB in a scene, built in %.2f s, %.0f ns a query\n", name,
              memory_MB, file ? 1e-6 * static_cast<double>(file->size()) : 0.0, build_s, ns);
}

}  // namespace

int main(int argc, char** argv) {
  const bool dense_too = argc > 1 && std::string(argv[1]) == "--dense";
  for (int i = dense_too ? 2 : 1; i < argc; ++i) {
    const auto file = read_file(argv[i]);
    if (!file) return 1;
    const std::string text = without_table({reinterpret_cast<const char*>(file->data()), file->size()});
    auto mesh = sources::decode_mesh(std::as_bytes(std::span(text)), "obj");
    if (!mesh) return 1;
    scale_to_hand(*mesh);
    const auto begin = Clock::now();
    sculpt::FacetOptions facets;
    facets.rounding_m = sculpt::facet_rounding_m(sculpt::bounds_of(*mesh), {});
    const auto solid = sculpt::solid_from_mesh(*mesh, 0.1 / 512, {}, facets);
    if (!solid) return 1;
    const double solid_s = seconds_since(begin);
    auto field = sculpt::field_from_source(*solid->distance, {}, {});
    if (!field) return 1;
    std::printf("%s: %zu triangles, %zu cells, %.2f s for the solid and %.2f s for the field\n", argv[i],
                mesh->triangles.size(), field->leaves(), solid_s, seconds_since(begin) - solid_s);
#if defined(__x86_64__)
    print_cold(*field);
#endif
    print_field("adaptive", *std::move(field), seconds_since(begin), *solid->distance);
    if (!dense_too) continue;
    for (const auto content : {models::DenseContent::distance, models::DenseContent::distance_and_force}) {
      const auto start = Clock::now();
      auto dense = sculpt::dense_field_from_source(*solid->distance, {.content = content}, {});
      if (!dense) {
        std::printf("  %s\n", dense.error().message.c_str());
        continue;
      }
      print_field(content == models::DenseContent::distance ? "dense" : "paper", *std::move(dense),
                  solid_s + seconds_since(start), *solid->distance);
    }
  }
  return 0;
}
