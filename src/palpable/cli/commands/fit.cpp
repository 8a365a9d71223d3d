// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/cli/arguments/parameter_groups.hpp"
#include "palpable/cli/arguments/stereo_options.hpp"
#include "palpable/cli/command.hpp"
#include "palpable/cli/hints.hpp"
#include "palpable/cli/say_aloud.hpp"
#include "palpable/draw/view/marks_view.hpp"
#include "palpable/vision/stereo/methods/match.hpp"
#include "palpable/vision/stereo/result/fit_to_touch.hpp"

#include <filesystem>

#include <fmt/format.h>

namespace palpable::cli {
namespace {

struct FitArguments {
  std::string output;
  StereoArguments stereo;
  bool speak = false;
};

draw::Figure picture_of(const vision::StereoPair& pair, const vision::FitToTouch& fit,
                        const FitArguments& arguments, const std::string& sentence) {
  return draw::marks_figure(rgb8(pair.left), fit.trouble,
                            {{"seen by one camera only", {225, 120, 40}},
                             {"no texture", {60, 120, 215}},
                             {"guessed from the surroundings", {235, 200, 60}},
                             {"the two matching directions disagree", {200, 40, 120}}},
                            {"Is this pair fit to touch?", names_of(arguments.stereo)}, sentence);
}

Result<Answer> fit(const FitArguments& arguments, Console& console) {
  auto method = stereo_method(arguments.stereo);
  if (!method) return method.error();
  if (arguments.stereo.method.empty()) method = vision::StereoMethod::fast;
  SettableOptions settable;
  const auto options =
      stereo_options(arguments.stereo, *method, parameters_of(*find_group("verdict"), settable));
  if (!options) return options.error();
  const auto ready = read_pair(arguments.stereo, console.work());
  if (!ready) return ready.error();
  const auto match = vision::match_confirmed(ready->pair, *method, *options, console.work());
  if (!match) return Error{match.error().code, match.error().message, places_of(arguments.stereo)};
  std::vector<Note> notes = ready->notes;
  notes.insert(notes.end(), match->notes.begin(), match->notes.end());
  for (const Note& note : notes) console.note(note);
  const vision::FitToTouch fit = vision::fit_to_touch(ready->pair, *match, console.work(), settable.verdict);
  const std::string sentence = vision::sentence_of(fit, settable.verdict.words);
  if (!arguments.output.empty())
    if (const auto written =
            draw::write_figure(picture_of(ready->pair, fit, arguments, sentence), arguments.output);
        !written)
      return written.error();
  Answer answer;
  if (arguments.speak) say_aloud(sentence, console);
  answer.json = {{"fit", fit.fit},
                 {"confidence", fit.confidence},
                 {"reason", vision::words_of(fit.reason)},
                 {"sentence", sentence},
                 {"method", vision::name_of(*method)},
                 {"agreement", fit.agreement},
                 {"coverage", fit.coverage},
                 {"guessed", fit.guessed},
                 {"textured", fit.textured},
                 {"overlap", fit.overlap},
                 {"depth_range_px", fit.depth_range_px},
                 {"brightness", fit.brightness},
                 {"points",
                  {{"matched", fit.points.count},
                   {"on_rows", fit.points.on_rows},
                   {"confirmed", fit.points.confirmed},
                   {"off_plane", fit.points.off_plane},
                   {"beyond_turn", fit.points.beyond_turn},
                   {"certainty", fit.points.certainty},
                   {"depth_order", fit.points.depth_order}}},
                 {"rectification", rectification_json(*ready)},
                 {"notes", sentences_of(notes)}};
  answer.text = sentence + "\n";
  return answer;
}

}  // namespace

void add_fit(Program& program) {
  const auto arguments = std::make_shared<FitArguments>();
  Options options = add_command(program, "fit",
                                "Check whether a stereo pair gives a good scene: one sentence, and a picture",
                                "  palpable fit left.jpg right.jpg\n"
                                "  palpable fit left.jpg right.jpg -o fit.png",
                                [arguments](Console& console) { return fit(*arguments, console); });
  add_pair_arguments(options, arguments->stereo);
  options.output("-o,--output", arguments->output, {".png", ".svg", ".pdf"},
                 "Picture of the places whose depth is doubtful (.png, .svg, .pdf)");
  options.flag("--speak", arguments->speak, "Speak the sentence");
  add_stereo_options(options, arguments->stereo);
  add_parameter_options(options, arguments->stereo);
}

}  // namespace palpable::cli
