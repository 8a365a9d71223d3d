// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/cli/arguments/as_published.hpp"
#include "palpable/cli/arguments/law_options.hpp"
#include "palpable/cli/arguments/scene_argument.hpp"
#include "palpable/cli/arguments/tool_options.hpp"
#include "palpable/cli/arguments/view_options.hpp"
#include "palpable/cli/command.hpp"
#include "palpable/core/files/atomic_file.hpp"
#include "palpable/core/text/number_table.hpp"
#include "palpable/describe/numbers.hpp"

#include <algorithm>
#include <set>

#include <fmt/format.h>

namespace palpable::cli {
namespace {

struct ProbeArguments {
  std::string scene, path, output, tool, as_published;
  LawArguments law;
  ViewArguments view;
  double sensor_step_um = 0.0;
};

constexpr double kMicrometre_m = 1e-6;

bool has_extent(const ProbeArguments& arguments) {
  if (arguments.law.law == haptics::name_of(haptics::Law::tool)) return true;
  return !arguments.tool.empty() && arguments.tool != "point";
}

void append_fields(std::string& row, std::initializer_list<double> values) {
  for (const double value : values) {
    row += ',';
    append_number(row, value);
  }
}

using Walk = std::vector<session::WalkStep>;

/// Converts a pose from the explorer's frame to the scene's.
haptics::ToolPose in_scene(haptics::ToolPose pose, const Walk& walk) {
  if (walk.empty()) return pose;
  const auto& told = pose.scene_from_tool;
  const Transform<session::ExplorerFrame, haptics::ToolFrame> explorer_from_tool{told.rotation,
                                                                                 told.translation_m, 1.0};
  pose.scene_from_tool = session::scene_from_explorer(session::pose_at(walk, pose.t_s)) * explorer_from_tool;
  return pose;
}

/// The inverse: the pose, and the result there, in the explorer's frame.
haptics::ToolPose in_view(haptics::ToolPose pose, const Walk& walk) {
  if (walk.empty()) return pose;
  const auto told =
      session::scene_from_explorer(session::pose_at(walk, pose.t_s)).inverse() * pose.scene_from_tool;
  pose.scene_from_tool = {told.rotation, told.translation_m, 1.0};
  return pose;
}

haptics::ToolOutput in_view(haptics::ToolOutput output, double t_s, const Walk& walk) {
  if (walk.empty()) return output;
  const auto explorer_from_scene = session::scene_from_explorer(session::pose_at(walk, t_s)).inverse();
  output.force_N.v = rotate_force(explorer_from_scene, output.force_N).v;
  output.torque_Nm.v = rotate_force(explorer_from_scene, output.torque_Nm).v;
  output.proxy.v = (explorer_from_scene * output.proxy).v;
  return output;
}

void append_row(std::string& csv, const ToolPath& path, const ProbeArguments& arguments,
                const haptics::ToolPose& pose, const haptics::ToolOutput& output) {
  const Vec3 p = pose.scene_from_tool.translation_m, f = output.force_N.v, proxy = output.proxy.v,
             torque = output.torque_Nm.v;
  append_number(csv, pose.t_s);
  append_fields(csv, {p.x, p.y, p.z, f.x, f.y, f.z});
  csv += output.contact ? ",1" : ",0";
  if (output.has_proxy) {
    append_fields(csv, {proxy.x, proxy.y, proxy.z});
  } else {
    csv += ",,,";
  }
  csv += fmt::format(",{}", output.label);
  if (path.names_probes) csv += fmt::format(",{}", pose.probe);
  if (has_extent(arguments)) append_fields(csv, {torque.x, torque.y, torque.z});
  csv += '\n';
}

Result<haptics::LawParameters> probe_law(const ProbeArguments& arguments, const models::Scene& scene) {
  const auto published = published_as(arguments.as_published);
  if (!published) return published.error();
  if (!*published) return law_parameters(arguments.law, scene);
  if (!arguments.law.law.empty())
    return Error{ErrorCode::usage, "--as-published sets the law: leave out --law", {}};
  LawArguments law = arguments.law;
  law.law = haptics::name_of((*published)->law.law);
  auto parameters = law_parameters(law, scene);
  if (!parameters) return without_its_scene(std::move(parameters).error(), **published);
  apply_published(**published, *parameters);
  return parameters;
}

Result<Answer> probe(const ProbeArguments& arguments, Console& console) {
  const auto file = read_scene_argument(arguments.scene);
  if (!file) return file.error();
  const models::Scene& scene = file->scene;
  const auto tool = tool_from(arguments.tool);
  if (!tool) return tool.error();
  auto path = read_tool_path(arguments.path);
  if (!path) return path.error();
  const auto walk = walk_from(arguments.view);
  if (!walk) return walk.error();
  for (haptics::ToolPose& pose : path->poses) pose = in_scene(pose, *walk);
  const auto parameters = probe_law(arguments, scene);
  if (!parameters) return parameters.error();
  if (const auto unused = note_on_unused(arguments.law, parameters->law)) console.note(*unused);
  const auto touchable = haptics::make_touchable(scene, *parameters, nullptr, console.work());
  if (!touchable) return touchable.error();

  std::string csv = "t_s,x_m,y_m,z_m,fx_N,fy_N,fz_N,contact,proxy_x_m,proxy_y_m,proxy_z_m,label";
  if (path->names_probes) csv += ",probe";
  if (has_extent(arguments)) csv += ",tx_Nm,ty_Nm,tz_Nm";
  csv += '\n';
  std::size_t contacts = 0;
  double strongest_N = 0.0, strongest_Nm = 0.0;
  std::set<int> probes;
  haptics::probe_tools(
      **touchable, *tool, path->poses,
      [&](const haptics::ToolPose& pose, const haptics::ToolOutput& output) {
        append_row(csv, *path, arguments, in_view(pose, *walk), in_view(output, pose.t_s, *walk));
        contacts += output.contact ? 1 : 0;
        strongest_N = std::max(strongest_N, norm(output.force_N));
        strongest_Nm = std::max(strongest_Nm, norm(output.torque_Nm));
        probes.insert(pose.probe);
      },
      kMicrometre_m * arguments.sensor_step_um);
  if (interrupted()) return Work::interrupted();
  if (const auto written = write_file_atomically(arguments.output, std::as_bytes(std::span(csv))); !written)
    return written.error();

  const std::size_t samples = path->poses.size();
  const double contact_fraction = static_cast<double>(contacts) / static_cast<double>(samples);
  Answer answer;
  answer.json = {{"law", haptics::name_of(parameters->law)},
                 {"samples", samples},
                 {"contact_fraction", contact_fraction},
                 {"max_force_N", strongest_N},
                 {"probes", probes.size()},
                 {"places", tool->size()},
                 {"max_torque_Nm", strongest_Nm},
                 {"output", arguments.output}};
  const std::string extent =
      has_extent(arguments) ? fmt::format(" and {} mN·m", figure(1000.0 * strongest_Nm, 3)) : std::string();
  answer.text =
      fmt::format("{} with {}, {:.1f} % in contact, at most {} N{}: {}\n",
                  describe::counted(samples, "sample", "samples"), haptics::name_of(parameters->law),
                  100.0 * contact_fraction, figure(strongest_N, 3), extent, arguments.output);
  return answer;
}

}  // namespace

void add_probe(Program& program) {
  const auto arguments = std::make_shared<ProbeArguments>();
  Options options = add_command(
      program, "probe",
      "Move a probe along a path and write the force that a hand would feel at every sample",
      "  palpable probe aloe.palp --path path.csv -o forces.csv\n"
      "  palpable probe aloe.palp --path path.csv -o forces.csv --law proxy --stiffness 800 "
      "--friction 0.4 --radius 1\n"
      "  palpable probe house.palp --path hand.csv -o forces.csv --tool pad    five fingers, with "
      "torque",
      [arguments](Console& console) { return probe(*arguments, console); });
  options.argument("SCENE", arguments->scene, "A .palp scene");
  options.required_text("--path", arguments->path,
                        "CSV with the columns t_s,x_m,y_m,z_m (scene frame, metres), and optionally probe "
                        "(0 to 63) and qw,qx,qy,qz");
  options.required_output("-o,--output", arguments->output, {}, "CSV to write");
  options.number(
      "--sensor-step", arguments->sensor_step_um, {0.0, 1000.0},
      "Step of the device's sensor, µm, if the path was read by one: velocities are then those that a "
      "touch computes; default 0, the last way in its time");
  add_tool_option(options, arguments->tool);
  add_view_options(options, arguments->view);
  add_as_published(options, arguments->as_published);
  add_law_options(options, arguments->law);
}

}  // namespace palpable::cli
