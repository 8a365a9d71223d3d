// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/cli/command.hpp"
#include "palpable/cli/make_options.hpp"
#include "palpable/formats/scene_file.hpp"

#include <chrono>

#include <fmt/format.h>

namespace palpable::cli {
namespace {

struct Arguments {
  MakeArguments make;
  std::string output;
  std::string as;
};

Result<Answer> make(const Arguments& arguments, Console& console) {
  auto options = make_options(arguments.make);
  if (!options) return options.error();
  if (arguments.as == "relief") options->as = session::MakeAs::relief;
  if (arguments.as == "contours") options->as = session::MakeAs::contours;
  if (arguments.as == "field") options->as = session::MakeAs::field;
  if (options->inputs.empty()) return Error{ErrorCode::usage, "make: INPUT is required", {}};
  const auto begin = std::chrono::steady_clock::now();
  const auto made = session::make_scene(*options, console.work());
  if (!made) return made.error();
  for (const std::string& note : made->notes) console.note(note);
  if (interrupted()) return Work::interrupted();
  const models::Scene& scene = *made->scene;
  if (const auto written = formats::write_scene(arguments.output, scene); !written) return written.error();
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - begin;

  const Vec3 size = models::size_m(scene);
  const std::string kind = models::kind_of(scene.model);
  Answer answer;
  answer.json = {
      {"output", arguments.output},    {"kind", kind},         {"size_m", {size.x, size.y, size.z}},
      {"method", scene.source.method}, {"notes", made->notes}, {"seconds", seconds.count()}};
  answer.text = fmt::format("{}: {}, {:.1f} x {:.1f} x {:.1f} mm, made in {:.2f} s\n", arguments.output, kind,
                            1000.0 * size.x, 1000.0 * size.y, 1000.0 * size.z, seconds.count());
  return answer;
}

}  // namespace

void add_make(Program& program) {
  const auto arguments = std::make_shared<Arguments>();
  Options options = add_command(
      program, "make", "Make a touchable scene and save it",
      "  palpable make left.png right.png -o room.palp\n"
      "  palpable make left.png right.png -o room.palp --calibration calib.txt --size 150x100x30\n"
      "  palpable make depth.png -o room.palp --kind depth\n"
      "  palpable make scan.png -o scan.palp --as contours\n"
      "  palpable make house.obj -o house.palp --size 100x100x50",
      [arguments](Console& console) { return make(*arguments, console); });
  options.required_text("-o,--output", arguments->output, "Scene to write (.palp)");
  options.choice("--as", arguments->as, {"relief", "contours", "field"},
                 "What it becomes; else contours of one picture, a field of a mesh, a relief of all else");
  add_make_options(options, arguments->make);
}

}  // namespace palpable::cli
