// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/cli/arguments/scene_argument.hpp"
#include "palpable/cli/command.hpp"
#include "palpable/cli/commands/make_again.hpp"
#include "palpable/cli/hints.hpp"
#include "palpable/describe/numbers.hpp"
#include "palpable/formats/scene/scene_file.hpp"
#include "palpable/recipes/solid/correct_scene.hpp"
#include "palpable/sources/solid/mesh_file.hpp"

#include <chrono>
#include <utility>

#include <fmt/format.h>

namespace palpable::cli {
namespace {

struct CorrectArguments {
  std::string scene, measured, output;
  double reach_mm = 10.0;
  double transition_mm = 5.0;
  bool everywhere = false;
  MakingWords words;
};

Result<Answer> correct(const CorrectArguments& arguments, Console& console) {
  const auto file = read_scene_argument(arguments.scene);
  if (!file) return file.error();
  auto measured = sources::read_mesh(arguments.measured);
  if (!measured) return not_a_mesh(arguments.measured, std::move(measured).error());
  const auto begin = std::chrono::steady_clock::now();
  const sculpt::CorrectionOptions correction{
      0.001 * arguments.reach_mm, 0.001 * arguments.transition_mm,
      arguments.everywhere ? sculpt::CorrectedVolume::everywhere : sculpt::CorrectedVolume::near_measured};
  auto corrected = recipes::correct_scene(file->scene, std::move(measured->mesh), correction, console.work());
  if (!corrected) {
    const bool by_scene = corrected.error().code == ErrorCode::usage;
    if (corrected.error().place.empty())
      corrected.error().place = by_scene ? arguments.scene : arguments.measured;
    return corrected.error();
  }
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - begin;
  for (const Note& note : corrected->made.notes) console.note(note);
  if (interrupted()) return Work::interrupted();
  models::Scene scene = std::move(corrected->made.scene);
  scene.source.inputs.push_back(arguments.measured);
  if (const auto noted = add_making(arguments.words, scene, console.work()); !noted) return noted.error();
  if (const auto written = formats::write_scene(arguments.output, scene); !written) return written.error();
  Answer answer;
  answer.json = {{"output", arguments.output},
                 {"measured_samples", corrected->measured_samples},
                 {"moved_samples", corrected->moved_samples},
                 {"notes", sentences_of(corrected->made.notes)},
                 {"seconds", seconds.count()}};
  answer.text =
      fmt::format("{}: {} of the surface matched the measured one, {} moved, in {:.2f} s\n", arguments.output,
                  describe::counted(corrected->measured_samples, "sample", "samples"),
                  corrected->moved_samples, seconds.count());
  return answer;
}

}  // namespace

void add_correct(Program& program) {
  const auto arguments = std::make_shared<CorrectArguments>();
  Options options =
      add_command(program, "correct", "Correct a field by a measured surface of a part of it",
                  "  palpable correct shapes.palp measured.ply -o corrected.palp\n"
                  "  palpable correct shapes.palp measured.ply -o corrected.palp --reach 4 --transition 3",
                  [arguments](Console& console) { return correct(*arguments, console); });
  arguments->words = making_words(options);
  options.argument("SCENE", arguments->scene, "A .palp scene of a field");
  options.argument("MEASURED", arguments->measured,
                   "The measured surface, open or closed, in the metres of the input that the scene was made "
                   "from (OBJ, PLY, "
                   "STL, GLB)");
  options.required_output("-o,--output", arguments->output, {".palp"}, "Scene to write (.palp)");
  options.number("--reach", arguments->reach_mm, {0.001, 1000.0},
                 "Greatest distance along the normal from the field's surface to the measured one, mm");
  options.number("--transition", arguments->transition_mm, {0.001, 1000.0},
                 "Width of the smooth transition around the measured part, mm");
  options.flag("--everywhere", arguments->everywhere,
               "Give new distances also deep inside and far outside, which takes longer");
}

}  // namespace palpable::cli
