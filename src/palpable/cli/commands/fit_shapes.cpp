// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/session/make/fit_shapes.hpp"

#include "palpable/cli/arguments/make_options.hpp"
#include "palpable/cli/arguments/unused_options.hpp"
#include "palpable/cli/command.hpp"
#include "palpable/core/files/atomic_file.hpp"
#include "palpable/core/files/byte_reader.hpp"
#include "palpable/formats/scene/superquadric_json.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace palpable::cli {
namespace {

struct FitShapesArguments {
  MakeArguments make;
  std::string output, labels, fit = "robust", deformation = "taper-and-bend";
  double tolerance_mm = 0.0;
  int most_shapes = 24;
};

std::string lines_of(const sculpt::ShapeSet& set) {
  std::string lines;
  for (const auto& fitted : set.shapes) {
    const models::Superquadric& s = fitted.shape;
    const Vec3 t = s.scene_from_shape.translation_m;
    lines += fmt::format(
        "  {:.1f} x {:.1f} x {:.1f} mm, exponents {:.2f} {:.2f}, at {:.1f} {:.1f} {:.1f} mm, "
        "points {:.2f} mm off\n",
        2e3 * s.size_m.x, 2e3 * s.size_m.y, 2e3 * s.size_m.z, s.e1, s.e2, 1e3 * t.x, 1e3 * t.y, 1e3 * t.z,
        1e3 * fitted.error_m);
    if (s.taper_x != 0.0 || s.taper_y != 0.0)
      lines += fmt::format("    tapered by {:.2f} {:.2f}\n", s.taper_x, s.taper_y);
    if (s.bend_per_m > 0.0) lines += fmt::format("    bent with a radius of {:.1f} mm\n", 1e3 / s.bend_per_m);
  }
  return lines;
}

sculpt::FitDeformation deformation_from(const std::string& word) {
  if (word == "none") return sculpt::FitDeformation::none;
  return word == "taper" ? sculpt::FitDeformation::taper : sculpt::FitDeformation::taper_and_bend;
}

Result<Answer> run_fit_shapes(const FitShapesArguments& arguments, Console& console) {
  const auto options = make_options(arguments.make);
  if (!options) return options.error();
  session::FitShapesOptions where;
  where.input = options->input;
  where.labels = arguments.labels;
  where.stereo = options->recipes.stereo;
  sculpt::ShapeSetOptions shapes;
  shapes.tolerance_m = 1e-3 * arguments.tolerance_mm;
  shapes.most_shapes = arguments.most_shapes;
  if (arguments.fit == "solina") shapes.fit.method = sculpt::FitMethod::solina;
  shapes.fit.deformation = deformation_from(arguments.deformation);
  const auto set = shape_options(arguments.make, shapes);
  if (!set) return set.error();
  where.shapes = *set;
  const auto found = session::fit_shapes(where, console.work());
  if (!found) return found.error();
  for (const Note& note : found->notes) console.note(note);
  if (const auto words = unused_by_fit_shapes(arguments.make.given())) console.note(Note(*words));
  const recipes::FittedShapes* const fitted = &found->fitted;
  Json file;
  for (const auto& shape : fitted->set.shapes)
    file["primitives"].push_back(Json(formats::json_of(shape.shape)));
  if (const auto written = write_file_atomically(arguments.output, as_bytes(file.dump(2) + "\n")); !written)
    return written.error();
  Answer answer;
  answer.json = {{"output", arguments.output},     {"primitives", file["primitives"]},
                 {"points", fitted->points},       {"tolerance_m", fitted->set.tolerance_m},
                 {"error_m", fitted->set.error_m}, {"left_out", fitted->set.left_out}};
  answer.text =
      fmt::format("{}: {} shapes, their points {:.2f} mm off on average, {:.1f} % belong to none\n{}",
                  arguments.output, fitted->set.shapes.size(), 1e3 * fitted->set.error_m,
                  100.0 * fitted->set.left_out, lines_of(fitted->set));
  return answer;
}

}  // namespace

void add_fit_shapes(Program& program) {
  const auto arguments = std::make_shared<FitShapesArguments>();
  Options options =
      add_command(program, "fit-shapes", "Fit superquadrics to a scene",
                  "  palpable fit-shapes depth.png -o shapes.json --calibration camera.json\n"
                  "  palpable fit-shapes depth.png -o shapes.json --labels things.png\n"
                  "  palpable fit-shapes left.png right.png -o shapes.json --calibration calib.txt\n"
                  "  palpable fit-shapes scan.ply -o shapes.json --tolerance 2\n"
                  "  palpable fit-shapes figure.stl -o shapes.json\n"
                  "  palpable fit-shapes scan.ply -o shapes.json --fit solina --deformation none\n"
                  "  palpable make shapes.json -o shapes.palp --size 100x100x50",
                  [arguments](Console& console) { return run_fit_shapes(*arguments, console); });
  options.required_output("-o,--output", arguments->output, {".json"},
                          "Primitives to write (.json), as make reads them");
  options.text("--labels", arguments->labels,
               "8-bit grey picture of the depth map's shape: 0 is left out, every other value is one object");
  options.choice("--fit", arguments->fit, {"robust", "solina"},
                 "The fit of one shape: robust, or by Solina and Bajcsy 1990 as Moustakas et al. use it");
  options.choice("--deformation", arguments->deformation, {"none", "taper", "taper-and-bend"},
                 "What a shape may be besides a plain superquadric, where the points are worth it");
  options.number("--tolerance", arguments->tolerance_mm, {0.0, 1000.0},
                 "Tolerated mean distance of points to their shape, mm; 0 = from the scene's size and noise");
  options.integer("--max-shapes", arguments->most_shapes, {1, 256},
                  "Greatest number of shapes; the largest are kept");
  add_make_options(options, arguments->make);
}

}  // namespace palpable::cli
