// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/cli/command.hpp"
#include "palpable/cli/stereo_options.hpp"
#include "palpable/draw/marks_view.hpp"
#include "palpable/vision/fit_to_touch.hpp"

#include <filesystem>

#include <fmt/format.h>

namespace palpable::cli {
namespace {

struct Arguments {
  std::string left, right, output;
  StereoArguments stereo;
};

draw::Figure picture_of(const vision::StereoPair& pair, const vision::FitToTouch& fit,
                        const Arguments& arguments, const std::string& sentence) {
  const std::string names = std::filesystem::path(arguments.left).filename().string() + " and " +
                            std::filesystem::path(arguments.right).filename().string();
  return draw::marks_figure(rgb8(pair.left), fit.trouble,
                            {{"seen by one camera only", {225, 120, 40}},
                             {"no texture to go by", {60, 120, 215}},
                             {"the pictures contradict each other", {200, 40, 120}}},
                            {"Is this pair fit to touch?", names}, sentence);
}

Result<Answer> fit(const Arguments& arguments, Console& console) {
  const auto ready = session::read_stereo_pair(
      stereo_input({arguments.left, arguments.right}, arguments.stereo), console.work());
  if (!ready) return ready.error();
  const auto match = vision::match(ready->pair, vision::StereoMethod::fast,
                                   {arguments.stereo.max_disparity_px}, console.work());
  if (!match)
    return Error{match.error().code, match.error().message, arguments.left + " and " + arguments.right};
  std::vector<std::string> notes = ready->notes;
  notes.insert(notes.end(), match->notes.begin(), match->notes.end());
  for (const std::string& note : notes) console.note(note);
  const vision::FitToTouch fit = vision::fit_to_touch(ready->pair, *match, console.work());
  const std::string sentence = vision::sentence_of(fit);
  if (!arguments.output.empty())
    if (const auto written =
            draw::write_figure(picture_of(ready->pair, fit, arguments, sentence), arguments.output);
        !written)
      return written.error();
  Answer answer;
  answer.json = {{"sentence", sentence},
                 {"agreement", fit.agreement},
                 {"coverage", fit.coverage},
                 {"textured", fit.textured},
                 {"overlap", fit.overlap},
                 {"depth_range_px", fit.depth_range_px},
                 {"brightness", fit.brightness},
                 {"alignment", alignment_json(*ready)},
                 {"notes", notes}};
  answer.text = sentence + "\n";
  return answer;
}

}  // namespace

void add_fit(Program& program) {
  const auto arguments = std::make_shared<Arguments>();
  Options options = add_command(program, "fit", "Is this pair fit to touch? One sentence, and a picture",
                                "  palpable fit left.jpg right.jpg\n"
                                "  palpable fit left.jpg right.jpg -o fit.png",
                                [arguments](Console& console) { return fit(*arguments, console); });
  options.argument("LEFT", arguments->left, "Left picture");
  options.argument("RIGHT", arguments->right, "Right picture");
  options.text("-o,--output", arguments->output, "Picture of where it will feel wrong (.png, .svg, .pdf)");
  add_pair_options(options, arguments->stereo);
}

}  // namespace palpable::cli
