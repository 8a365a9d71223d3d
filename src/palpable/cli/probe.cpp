// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/cli/command.hpp"
#include "palpable/cli/law_options.hpp"
#include "palpable/cli/path_file.hpp"
#include "palpable/core/atomic_file.hpp"
#include "palpable/core/number_table.hpp"
#include "palpable/formats/scene_file.hpp"
#include "palpable/haptics/probe_path.hpp"

#include <algorithm>

#include <fmt/format.h>

namespace palpable::cli {
namespace {

struct Arguments {
  std::string scene, path, output;
  LawArguments law;
};

void append_fields(std::string& row, std::initializer_list<double> values) {
  for (const double value : values) {
    row += ',';
    append_number(row, value);
  }
}

void append_row(std::string& csv, const haptics::PathSample& sample, const haptics::Feel& feel) {
  const Vec3 p = sample.position.v, f = feel.force_N.v, proxy = feel.proxy.v;
  append_number(csv, sample.t_s);
  append_fields(csv, {p.x, p.y, p.z, f.x, f.y, f.z});
  csv += feel.contact ? ",1" : ",0";
  if (feel.has_proxy) {
    append_fields(csv, {proxy.x, proxy.y, proxy.z});
  } else {
    csv += ",,,";
  }
  csv += fmt::format(",{}\n", feel.label);
}

Result<Answer> probe(const Arguments& arguments, Console& /*console*/) {
  const auto file = formats::read_scene(arguments.scene);
  if (!file) return file.error();
  const models::Scene& scene = file->scene;
  const auto path = read_path(arguments.path);
  if (!path) return path.error();
  const auto parameters = law_parameters(arguments.law, scene);
  if (!parameters) return parameters.error();
  const auto touchable = haptics::make_touchable(scene, *parameters);
  if (!touchable) return touchable.error();

  std::string csv = "t_s,x_m,y_m,z_m,fx_N,fy_N,fz_N,contact,proxy_x_m,proxy_y_m,proxy_z_m,label\n";
  std::size_t contacts = 0;
  double strongest_N = 0.0;
  haptics::probe_path(**touchable, *path, [&](const haptics::PathSample& sample, const haptics::Feel& feel) {
    append_row(csv, sample, feel);
    contacts += feel.contact ? 1 : 0;
    strongest_N = std::max(strongest_N, norm(feel.force_N));
  });
  if (interrupted()) return Work::interrupted();
  if (const auto written = write_file_atomically(arguments.output, std::as_bytes(std::span(csv))); !written)
    return written.error();

  const double contact_fraction = static_cast<double>(contacts) / static_cast<double>(path->size());
  Answer answer;
  answer.json = {{"law", haptics::name_of(parameters->law)},
                 {"samples", path->size()},
                 {"contact_fraction", contact_fraction},
                 {"max_force_N", strongest_N},
                 {"output", arguments.output}};
  answer.text =
      fmt::format("{} samples with {}, {:.1f} % in contact, at most {:.3g} N: {}\n", path->size(),
                  haptics::name_of(parameters->law), 100.0 * contact_fraction, strongest_N, arguments.output);
  return answer;
}

}  // namespace

void add_probe(Program& program) {
  const auto arguments = std::make_shared<Arguments>();
  Options options =
      add_command(program, "probe",
                  "Move a probe along a path and write the force that a hand would feel at every sample",
                  "  palpable probe aloe.palp --path path.csv -o forces.csv\n"
                  "  palpable probe aloe.palp --path path.csv -o forces.csv --law proxy --stiffness 800 "
                  "--friction 0.4 --radius 1",
                  [arguments](Console& console) { return probe(*arguments, console); });
  options.argument("SCENE", arguments->scene, "A .palp scene");
  options.required_text("--path", arguments->path,
                        "CSV with the columns t_s,x_m,y_m,z_m (scene frame, metres)");
  options.required_text("-o,--output", arguments->output, "CSV to write");
  add_law_options(options, arguments->law);
}

}  // namespace palpable::cli
