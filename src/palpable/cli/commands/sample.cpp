// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/cli/arguments/path_file.hpp"
#include "palpable/cli/arguments/scene_argument.hpp"
#include "palpable/cli/command.hpp"
#include "palpable/core/files/atomic_file.hpp"
#include "palpable/core/text/number_table.hpp"
#include "palpable/models/relief/relief_distance.hpp"

#include <algorithm>
#include <array>
#include <vector>

#include <fmt/format.h>

namespace palpable::cli {
namespace {

struct SampleArguments {
  std::string scene, points, output;
};

/// The values of one row; empty if the point is outside the model's domain.
using Value = std::optional<models::ClosestPoint>;

/// The field's value; its gradient leads to the nearest surface point.
template <models::DistanceSurface Distance>
Value ask(const Distance& field, Point<SceneFrame> place) {
  if (!is_finite(place) || !field.contains(place)) return std::nullopt;
  const models::FieldSample s = field.sample(place);
  const Vector<SceneFrame> normal{unit(s.gradient.v)};
  return models::ClosestPoint{place - s.distance_m * normal, s.distance_m, normal};
}

/// A grid knows distances only inside, and up to half its spacing outside.
Value ask(const models::OccupancyGrid& grid, Point<SceneFrame> place) {
  if (!is_finite(place)) return std::nullopt;
  const models::GridSample s = grid.sample(place);
  if (s.normal == Vector<SceneFrame>{}) return std::nullopt;
  return models::ClosestPoint{place + s.depth_m * s.normal, -s.depth_m, s.normal};
}

Value ask(const models::Scene& scene, Point<SceneFrame> place) {
  if (const auto* field = std::get_if<std::shared_ptr<const models::Field>>(&scene.model))
    return ask((*field)->distance, place);
  if (const auto* dense = std::get_if<std::shared_ptr<const models::FieldOnLattice>>(&scene.model))
    return ask((*dense)->distance, place);
  if (const auto* grid = std::get_if<std::shared_ptr<const models::Grid>>(&scene.model))
    return ask((*grid)->occupancy, place);
  return models::closest_point(*models::relief_of(scene), place);
}

std::vector<Value> ask(const models::Scene& scene, const NumberTable& points, const Work& work) {
  std::vector<Value> values(points.rows());
  parallel_for(work, static_cast<int>(points.rows()), 256, [&](int begin, int end) {
    for (int i = begin; i < end && !work.cancelled(); ++i) {
      const auto row = points.row(static_cast<std::size_t>(i));
      values[static_cast<std::size_t>(i)] = ask(scene, {{row[0], row[1], row[2]}});
    }
  });
  return values;
}

std::string csv_of(const models::Scene& scene, const NumberTable& points, const std::vector<Value>& values) {
  std::string csv = "x_m,y_m,z_m,distance_m,nx,ny,nz,stiffness_N_per_m,static_friction,label\n";
  for (std::size_t i = 0; i < values.size(); ++i) {
    const auto row = points.row(i);
    for (const double coordinate : row) {
      append_number(csv, coordinate);
      csv += ',';
    }
    if (!values[i]) {
      csv += ",,,,,,\n";
      continue;
    }
    const Vec3 n = values[i]->normal.v;
    const std::size_t label = models::label_at(scene, values[i]->surface);
    const models::Material& material = scene.materials[label];
    for (const double value :
         {values[i]->distance_m, n.x, n.y, n.z, material.stiffness_N_per_m, material.static_friction}) {
      append_number(csv, value);
      csv += ',';
    }
    csv += fmt::format("{}\n", label);
  }
  return csv;
}

Result<Answer> sample(const SampleArguments& arguments, Console& console) {
  const auto file = read_scene_argument(arguments.scene);
  if (!file) return file.error();
  const models::Scene& scene = file->scene;
  constexpr std::array<std::string_view, 3> kColumns{"x_m", "y_m", "z_m"};
  const auto points = read_number_table(arguments.points, kColumns);
  if (!points) return points.error();
  const Work work = console.work();
  const auto values = ask(scene, *points, work);
  if (work.cancelled()) return Work::interrupted();
  const std::string csv = csv_of(scene, *points, values);
  if (const auto written = write_file_atomically(arguments.output, std::as_bytes(std::span(csv))); !written)
    return written.error();
  const auto inside =
      std::count_if(values.begin(), values.end(), [](const Value& v) { return v.has_value(); });
  Answer answer;
  answer.json = {{"points", values.size()}, {"in_domain", inside}, {"output", arguments.output}};
  answer.text = fmt::format("{} points, {} of them in the scene's domain: {}\n", values.size(), inside,
                            arguments.output);
  return answer;
}

}  // namespace

void add_sample(Program& program) {
  const auto arguments = std::make_shared<SampleArguments>();
  Options options = add_command(program, "sample", "Distance, normal and material of a model at points",
                                "  palpable sample aloe.palp --points points.csv -o values.csv",
                                [arguments](Console& console) { return sample(*arguments, console); });
  options.argument("SCENE", arguments->scene, "A .palp scene");
  options.required_text("--points", arguments->points,
                        "CSV with the columns x_m,y_m,z_m (scene frame, metres)");
  options.required_output("-o,--output", arguments->output, {}, "CSV to write");
}

}  // namespace palpable::cli
