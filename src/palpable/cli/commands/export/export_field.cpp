// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/cli/commands/export/export_field.hpp"

#include "palpable/core/files/atomic_file.hpp"
#include "palpable/formats/mesh/glb.hpp"
#include "palpable/formats/mesh/ply.hpp"
#include "palpable/formats/mesh/stl.hpp"
#include "palpable/formats/packing/npz.hpp"
#include "palpable/formats/vdb/vdb.hpp"
#include "palpable/sculpt/field/field_surface.hpp"

#include <algorithm>
#include <array>
#include <filesystem>
#include <span>
#include <vector>

#include <fmt/format.h>

namespace palpable::cli {
namespace {

/// The spacing for `grid` samples along the field's longest side.
template <models::DistanceSurface Distance>
double spacing_of(const Distance& field, int grid) {
  const Vec3 size = field.size_m();
  return std::max({size.x, size.y, size.z}) / (grid - 1);
}

/// The surface of a field by dual contouring, with one cube per two finest cells.
template <models::DistanceSurface Distance>
Result<Answer> export_surface(const Distance& field, const models::Scene& scene,
                              const ExportArguments& arguments, const Work& work) {
  const std::filesystem::path output(arguments.output);
  constexpr double kCells = 2.0;
  const auto mesh = sculpt::surface_of_field(field, kCells * field.cell_m(), work);
  if (!mesh) return mesh.error();
  const auto bytes = output.extension() == ".stl"   ? formats::encode_stl(*mesh)
                     : output.extension() == ".ply" ? formats::encode_ply(*mesh)
                                                    : formats::encode_glb(*mesh, scene.texture);
  if (!bytes) return bytes.error();
  if (const auto written = write_file_atomically(output, *bytes); !written) return written.error();
  Answer answer;
  answer.json = {{"output", arguments.output}, {"triangles", mesh->triangles.size()}};
  answer.text = fmt::format("{}: {} triangles\n", arguments.output, mesh->triangles.size());
  return answer;
}

/// A level set for Blender and others, `grid` voxels along the longest side.
template <models::DistanceSurface Distance>
Result<Answer> export_vdb(const Distance& field, const ExportArguments& arguments, const Work& work) {
  formats::VdbOptions options;
  options.voxel_m = spacing_of(field, arguments.grid);
  if (arguments.band == "full") options.band = formats::VdbBand::full;
  const auto bytes = formats::encode_vdb(field, options, work);
  if (!bytes) return Error{bytes.error().code, bytes.error().message, arguments.output};
  if (const auto written = write_file_atomically(arguments.output, *bytes); !written) return written.error();
  Answer answer;
  answer.json = {{"output", arguments.output}, {"voxel_m", options.voxel_m}, {"bytes", bytes->size()}};
  answer.text =
      fmt::format("{}: a level set, voxels of {:.4g} mm\n", arguments.output, 1000.0 * options.voxel_m);
  return answer;
}

/// Distances on a lattice, `grid` samples along the longest side: distance_m[i, j, k] is at origin_m +
/// spacing_m (i, j, k), x right, y up, z towards the user.
template <models::DistanceSurface Distance>
Result<Answer> export_distances(const Distance& field, const ExportArguments& arguments, const Work& work) {
  const Vec3 origin = field.origin_m(), size = field.size_m();
  const double spacing_m = spacing_of(field, arguments.grid);
  const auto count = [&](double extent) { return static_cast<int>(extent / spacing_m + 1.0 + 1e-9); };
  const int nx = count(size.x), ny = count(size.y), nz = count(size.z);
  std::vector<float> values;
  for (int i = 0; i < nx; ++i) {
    if (work.cancelled()) return Work::interrupted();
    work.report(static_cast<double>(i) / nx, "sampling distances");
    for (int j = 0; j < ny; ++j)
      for (int k = 0; k < nz; ++k)
        values.push_back(static_cast<float>(
            field.sample({origin + spacing_m * Vec3{1.0 * i, 1.0 * j, 1.0 * k}}).distance_m));
  }
  formats::NpyArray distances = formats::npy_array(std::span<const float>(values));
  distances.shape = {static_cast<std::size_t>(nx), static_cast<std::size_t>(ny),
                     static_cast<std::size_t>(nz)};
  const std::array<double, 3> origin_m{origin.x, origin.y, origin.z};
  const formats::Npz arrays{{"distance_m", std::move(distances)},
                            {"origin_m", formats::npy_array(std::span<const double>(origin_m))},
                            {"spacing_m", formats::npy_array(spacing_m)}};
  if (const auto written = formats::write_npz(arguments.output, arrays); !written) return written.error();
  Answer answer;
  answer.json = {{"output", arguments.output}, {"spacing_m", spacing_m}, {"grid", {nx, ny, nz}}};
  answer.text = fmt::format("{}\n", arguments.output);
  return answer;
}

template <models::DistanceSurface Distance>
Result<Answer> export_distance_field(const Distance& field, const models::Scene& scene,
                                     const ExportArguments& arguments, const Work& work) {
  const std::string ending = std::filesystem::path(arguments.output).extension().string();
  if (ending == ".vdb") return export_vdb(field, arguments, work);
  if (ending == ".npz") return export_distances(field, arguments, work);
  return export_surface(field, scene, arguments, work);
}

}  // namespace

Result<Answer> export_field(const models::Field& field, const models::Scene& scene,
                            const ExportArguments& arguments, const Work& work) {
  return export_distance_field(field.distance, scene, arguments, work);
}

Result<Answer> export_field(const models::FieldOnLattice& field, const models::Scene& scene,
                            const ExportArguments& arguments, const Work& work) {
  return export_distance_field(field.distance, scene, arguments, work);
}

}  // namespace palpable::cli
