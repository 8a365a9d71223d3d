// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// The same solids as our field, as OpenVDB and NanoVDB grids: sizes, errors, times (docs/measurements.md).
// Each argument is a mesh, which is scaled to 100 mm. The voxels hold exact distances, the best possible
// values; OpenVDB's own conversion from triangles is timed separately.
#include "palpable/formats/scene/scene_file.hpp"
#include "palpable/models/field/field.hpp"
#include "palpable/sculpt/field/field_from_source.hpp"
#include "palpable/sculpt/solid/mesh_solid.hpp"
#include "palpable/sources/solid/mesh_file.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <limits>
#include <random>
#include <sstream>

#include <blosc.h>
#include <nanovdb/util/OpenToNanoVDB.h>
#include <nanovdb/util/SampleFromVoxels.h>
#include <openvdb/io/Stream.h>
#include <openvdb/openvdb.h>
#include <openvdb/tools/Interpolation.h>
#include <openvdb/tools/MeshToVolume.h>
#include <openvdb/tools/SignedFloodFill.h>

namespace {

using namespace palpable;
using openvdb::FloatGrid;

constexpr int kVoxels = 512;
constexpr double kSize_m = 0.1;

double seconds_of(const auto& work) {
  const auto begin = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

double at_share(std::vector<double> values, double share) {
  std::sort(values.begin(), values.end());
  return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
}

/// Points within 0.5 mm of the surface with their exact distances, ordered so that consecutive points are
/// neighbours.
struct Places {
  std::vector<Vec3> at;
  std::vector<double> distance_m;
};

Places places_near(const sculpt::DistanceSource& source) {
  constexpr std::size_t kCount = 40000;
  constexpr double kBand_m = 0.0005, kStep_m = 0.0002;
  Places places;
  std::mt19937 random(3);
  const auto uniform = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  const sculpt::Box box = source.bounds();
  sculpt::DistanceSource::Hint hint;
  while (places.at.size() < kCount) {
    Vec3 p{uniform(box.least_m.x, box.most_m.x), uniform(box.least_m.y, box.most_m.y),
           uniform(box.least_m.z, box.most_m.z)};
    const Vec3 way = unit({uniform(-1.0, 1.0), uniform(-1.0, 1.0), uniform(-1.0, 1.0)});
    for (int step = 0; step < 50 && places.at.size() < kCount; ++step) {
      const models::DistanceSample s = source.at(p, hint);
      p -= (s.distance_m - uniform(-kBand_m, kBand_m)) * s.gradient;
      places.at.push_back(p);
      places.distance_m.push_back(source.at(p, hint).distance_m);
      p += kStep_m * way;
    }
  }
  return places;
}

struct Row {
  double resident_bytes = 0.0, disk_bytes = 0.0, build_s = 0.0;
};

/// Prints one row. `value(p)`: the distance in metres; `slope(p)`: any sum that needs the gradient.
void print_row(const char* name, const Row& row, const Places& places, const auto& value, const auto& slope) {
  std::vector<double> errors;
  for (std::size_t i = 0; i < places.at.size(); ++i)
    if (std::abs(places.distance_m[i]) < 0.0005)
      errors.push_back(1e6 * std::abs(value(places.at[i]) - places.distance_m[i]));
  double sum = 0.0;
  std::vector<double> value_ns, slope_ns;
  for (int run = 0; run < 7; ++run) {
    const double each = 1e9 / static_cast<double>(places.at.size());
    value_ns.push_back(each * seconds_of([&] {
                         for (const Vec3 p : places.at) sum += value(p);
                       }));
    slope_ns.push_back(each * seconds_of([&] {
                         for (const Vec3 p : places.at) sum += slope(p);
                       }));
  }
  std::printf("| %s | %.2f | %.2f | %.2f / %.1f / %.0f | %.0f / %.0f | %.1f |%s\n", name,
              1e-6 * row.resident_bytes, 1e-6 * row.disk_bytes, at_share(errors, 0.5), at_share(errors, 0.99),
              at_share(errors, 1.0), at_share(value_ns, 0.5), at_share(slope_ns, 0.5), row.build_s,
              std::isnan(sum) ? " not a number" : "");
}

/// The value and its central differences, half a voxel to each side.
double with_slope(const auto& value, Vec3 p, double voxel_m) {
  const double h = 0.5 * voxel_m;
  return value(p) + value(p + Vec3{h, 0, 0}) - value(p - Vec3{h, 0, 0}) + value(p + Vec3{0, h, 0}) -
         value(p - Vec3{0, h, 0}) + value(p + Vec3{0, 0, h}) - value(p - Vec3{0, 0, h});
}

FloatGrid::Ptr exact_grid(const sculpt::DistanceSource& source, double voxel_m, double inside_m) {
  const sculpt::Box box = source.bounds();
  const double width_m = 3.0 * voxel_m;
  const auto grid = FloatGrid::create(static_cast<float>(width_m));
  grid->setTransform(openvdb::math::Transform::createLinearTransform(voxel_m));
  grid->setGridClass(openvdb::GRID_LEVEL_SET);
  grid->setSaveFloatAsHalf(true);
  auto access = grid->getAccessor();
  const auto low = [&](double v) { return static_cast<int>(std::floor(v / voxel_m)) - 4; };
  const auto high = [&](double v) { return static_cast<int>(std::ceil(v / voxel_m)) + 4; };
  sculpt::DistanceSource::Hint hint;
  for (int x = low(box.least_m.x); x <= high(box.most_m.x); ++x)
    for (int y = low(box.least_m.y); y <= high(box.most_m.y); ++y)
      for (int z = low(box.least_m.z); z <= high(box.most_m.z); ++z) {
        const double d = source.at(voxel_m * Vec3{1.0 * x, 1.0 * y, 1.0 * z}, hint).distance_m;
        if (d < width_m && d > -inside_m) access.setValue({x, y, z}, static_cast<float>(d));
        // Voxels that are certainly far from the surface need no query.
        const double sure = d >= width_m ? d - width_m : d <= -inside_m ? -d - inside_m : 0.0;
        z += static_cast<int>(sure / voxel_m);
      }
  openvdb::tools::signedFloodFill(grid->tree());
  return grid;
}

double packed_bytes(const FloatGrid::Ptr& grid) {
  std::ostringstream stream(std::ios::binary);
  openvdb::io::Stream writer(stream);
  writer.setCompression(openvdb::io::COMPRESS_BLOSC | openvdb::io::COMPRESS_ACTIVE_MASK);
  writer.write(openvdb::GridCPtrVec{grid});
  return static_cast<double>(stream.str().size());
}

/// Compressed like NanoVDB's files.
double blosc_packed_bytes(const void* data, std::size_t size) {
  std::vector<char> packed(size + BLOSC_MAX_OVERHEAD);
  constexpr int kLevel = 9, kShuffle = 1, kThreads = 1;
  const int got = blosc_compress_ctx(kLevel, kShuffle, sizeof(float), size, data, packed.data(),
                                     packed.size(), BLOSC_LZ4_COMPNAME, 0, kThreads);
  return static_cast<double>(got);
}

double own_build_s(const Mesh& mesh, double voxel_m, float inside_voxels) {
  std::vector<openvdb::Vec3s> points;
  std::vector<openvdb::Vec3I> triangles;
  for (const Vec3 v : mesh.vertices_m) points.emplace_back(v.x / voxel_m, v.y / voxel_m, v.z / voxel_m);
  for (const auto& t : mesh.triangles) triangles.emplace_back(t[0], t[1], t[2]);
  using Adapter = openvdb::tools::QuadAndTriangleDataAdapter<openvdb::Vec3s, openvdb::Vec3I>;
  const Adapter adapter(points, triangles);
  const auto transform = openvdb::math::Transform::createLinearTransform(voxel_m);
  return seconds_of(
      [&] { openvdb::tools::meshToVolume<FloatGrid>(adapter, *transform, 3.0F, inside_voxels); });
}

void print_grid(const char* name, const char* nano_name, const Mesh& mesh,
                const sculpt::DistanceSource& source, const Places& places, double voxel_m, double inside_m) {
  const auto grid = exact_grid(source, voxel_m, inside_m);
  Row row{static_cast<double>(grid->memUsage()), packed_bytes(grid),
          own_build_s(mesh, voxel_m, static_cast<float>(std::min(inside_m / voxel_m, 1e6)))};
  const auto access = grid->getConstAccessor();
  const auto value = [&](Vec3 p) {
    const openvdb::Vec3d at(p.x / voxel_m, p.y / voxel_m, p.z / voxel_m);
    return static_cast<double>(openvdb::tools::BoxSampler::sample(access, at));
  };
  print_row(name, row, places, value, [&](Vec3 p) { return with_slope(value, p, voxel_m); });

  nanovdb::GridHandle<nanovdb::HostBuffer> handle;
  row.build_s += seconds_of(
      [&] { handle = nanovdb::openToNanoVDB<nanovdb::HostBuffer, openvdb::FloatTree, nanovdb::Fp8>(*grid); });
  row.resident_bytes = static_cast<double>(handle.size());
  row.disk_bytes = blosc_packed_bytes(handle.data(), handle.size());
  const auto nano_access = handle.grid<nanovdb::Fp8>()->getAccessor();
  const auto sampler = nanovdb::createSampler<1, decltype(nano_access), false>(nano_access);
  const auto nano_value = [&](Vec3 p) {
    return static_cast<double>(sampler(nanovdb::Vec3d(p.x / voxel_m, p.y / voxel_m, p.z / voxel_m)));
  };
  print_row(nano_name, row, places, nano_value, [&](Vec3 p) { return with_slope(nano_value, p, voxel_m); });
}

int compare(const char* path) {
  auto file = sources::read_mesh(path);
  if (!file) return std::fprintf(stderr, "%s\n", file.error().sentence().c_str()), 3;
  Mesh& mesh = file->mesh;
  sculpt::Box box = sculpt::bounds_of(mesh);
  const Vec3 size = box.size_m(), middle = 0.5 * (box.least_m + box.most_m);
  const double scale = kSize_m / std::max({size.x, size.y, size.z});
  for (Vec3& v : mesh.vertices_m) v = scale * (v - middle);
  const Work work;
  Result<sculpt::MeshSolid> solid = Error{};
  Result<models::DistanceField> distance = Error{};
  Row row;
  row.build_s = seconds_of([&] {
    solid = sculpt::solid_from_mesh(mesh, kSize_m / kVoxels, work);
    if (solid) distance = sculpt::field_from_source(*solid->distance, {kVoxels}, work);
  });
  if (!solid || !distance) return std::fprintf(stderr, "%s: no field\n", path), 1;
  const sculpt::DistanceSource& source = *solid->distance;
  box = source.bounds();
  auto field = models::field_of(*distance, box.least_m, box.most_m);
  if (!field) return 1;
  models::Scene scene;
  scene.model = std::make_shared<const models::Field>(*field);
  const auto file = formats::encode_scene(scene);
  if (!file) return 1;
  row.resident_bytes = static_cast<double>(distance->memory_bytes());
  row.disk_bytes = static_cast<double>(file->size());
  const Places places = places_near(source);
  const double voxel_m = kSize_m / kVoxels;
  std::printf("\n%s, %zu triangles, %d voxels of %.3f mm\n\n", path, mesh->triangles.size(), kVoxels,
              1e3 * voxel_m);
  std::printf(
      "| | resident, MB | on disk, MB | error, um: median / 99 %% / most | value / with slope, ns "
      "| build, s |\n|---|---|---|---|---|---|\n");
  print_row(
      "ours", row, places, [&](Vec3 p) { return distance->sample({p}).distance_m; },
      [&](Vec3 p) {
        const models::FieldSample s = distance->sample({p});
        return s.distance_m + s.gradient.v.x + s.gradient.v.y + s.gradient.v.z;
      });
  print_grid("OpenVDB, narrow band", "NanoVDB 8 bit, narrow band", *mesh, source, places, voxel_m,
             3.0 * voxel_m);
  print_grid("OpenVDB, full inside", "NanoVDB 8 bit, full inside", *mesh, source, places, voxel_m,
             std::numeric_limits<float>::max());
  return 0;
}

}  // namespace

int main(int count, char** arguments) {
  openvdb::initialize();
  for (int i = 1; i < count; ++i)
    if (const int code = compare(arguments[i]); code != 0) return code;
  return 0;
}
