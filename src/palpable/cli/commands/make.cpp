// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/cli/arguments/as_published.hpp"
#include "palpable/cli/arguments/make_options.hpp"
#include "palpable/cli/arguments/material_options.hpp"
#include "palpable/cli/arguments/sample_scene.hpp"
#include "palpable/cli/arguments/scene_argument.hpp"
#include "palpable/cli/arguments/title_options.hpp"
#include "palpable/cli/command.hpp"
#include "palpable/cli/commands/make_again.hpp"
#include "palpable/cli/hints.hpp"
#include "palpable/cli/video/video_outputs.hpp"
#include "palpable/draw/view/comparison_view.hpp"
#include "palpable/formats/scene/scene_file.hpp"
#include "palpable/session/make/compare_details.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <utility>

#include <fmt/format.h>

namespace palpable::cli {
namespace {

struct MakeCommandArguments {
  MakeArguments make;
  MaterialArguments material;
  TitleArguments title;
  std::string as_published;
  std::string output;
  /// A saved scene that is to be made again.
  std::string again;
  MakingWords words;
  VideoOutputs video;
  /// For a video, whose poses are written.
  std::function<Result<void>()> check_poses;
};

Json json_of(const session::ComparedDetail& compared) {
  const auto or_null = [](double value) { return std::isnan(value) ? Json(nullptr) : Json(value); };
  return {{"detail", sculpt::name_of(compared.detail)},
          {"reversed_slopes_percent", compared.score.reversed_slopes_percent},
          {"detail_correlation", or_null(compared.score.detail_correlation)},
          {"wrong_order_percent", or_null(compared.score.wrong_order_percent)},
          {"greatest_slope", compared.score.greatest_slope},
          {"details_kept_percent", or_null(compared.score.details_kept_percent)},
          {"sum", compared.score.sum()},
          {"seconds", compared.seconds}};
}

std::string or_dash(double value, int digits, const char* unit) {
  return std::isnan(value) ? "–" : fmt::format("{:.{}f}{}", value, digits, unit);
}

/// Writes all detail operators' reliefs in one picture, with their scores.
Result<Answer> compare(const session::MakeOptions& options, const std::string& output, Console& console) {
  auto compared = session::compare_details(options, console.work());
  if (!compared) return compared.error();
  if (interrupted()) return Work::interrupted();
  Answer answer;
  answer.json = {{"output", output}, {"operators", Json::array()}};
  answer.text = fmt::format("{:<11}{:>10}{:>13}{:>13}{:>8}{:>14}{:>8}\n", "", "reversed", "correlation",
                            "wrong order", "slope", "details kept", "sum");
  std::vector<draw::ComparedRelief> panels;
  for (session::ComparedDetail& c : *compared) {
    const measure::ReliefScore& s = c.score;
    answer.json["operators"].push_back(json_of(c));
    answer.text += fmt::format("{:<11}{:>10}{:>13}{:>13}{:>8.2f}{:>14}{:>8.2f}\n", sculpt::name_of(c.detail),
                               or_dash(s.reversed_slopes_percent, 3, " %"),
                               or_dash(s.detail_correlation, 3, ""), or_dash(s.wrong_order_percent, 2, " %"),
                               s.greatest_slope, or_dash(s.details_kept_percent, 1, " %"), s.sum());
    panels.push_back(
        {std::string(sculpt::name_of(c.detail)),
         std::move(c.relief),
         {fmt::format("reversed slopes {}, wrong order {}", or_dash(s.reversed_slopes_percent, 3, " %"),
                      or_dash(s.wrong_order_percent, 2, " %")),
          fmt::format("detail correlation {}, details kept {}", or_dash(s.detail_correlation, 3, ""),
                      or_dash(s.details_kept_percent, 1, " %")),
          fmt::format("greatest slope {:.2f}, sum {:.2f} (0 is perfect)", s.greatest_slope, s.sum())}});
  }
  const std::string from = options.input.files.front().filename().string();
  const auto written = draw::write_figure(
      draw::comparison_figure(std::move(panels),
                              {"How depth becomes a relief: " + from,
                               fmt::format("All detail operators at {:g} : 1, against the depth in its own "
                                           "proportions",
                                           options.recipes.relief.relief.compression)}),
      output);
  if (!written) return written.error();
  return answer;
}

/// Checks the outputs that only a video has. Errors: usage.
Result<void> check_outputs_of_video(const MakeCommandArguments& arguments) {
  if (auto checked = arguments.check_poses(); !checked) return checked;
  return check_video_outputs(arguments.video);
}

/// --again, which needs nothing but a file to write.
Result<Answer> again(const MakeCommandArguments& arguments, Console& console) {
  const auto given = arguments.make.given();
  const auto is_allowed = [](const std::string& name) {
    const std::vector<std::string> allowed{"--again", "--output", "--json", "--quiet", "--threads"};
    return std::find(allowed.begin(), allowed.end(), name) != allowed.end();
  };
  if (const auto other = std::find_if_not(given.begin(), given.end(), is_allowed); other != given.end())
    return Error{ErrorCode::usage,
                 fmt::format("--again repeats how a scene was made: {} cannot be given too", *other),
                 {}};
  if (const auto named = check_scene_name(arguments.output); !named) return named.error();
  return make_again(arguments.again, arguments.output, console);
}

Result<Answer> make(MakeCommandArguments arguments, Console& console) {
  if (!arguments.again.empty()) return again(arguments, console);
  const auto published = published_as(arguments.as_published);
  if (!published) return published.error();
  if (*published) {
    apply_published(**published, arguments.make);
    console.note(std::string((*published)->differs));
  }
  if (const auto resolved = resolve_sample(arguments.make, arguments.title, arguments.material); !resolved)
    return resolved.error();
  const bool video = is_video(arguments.make.inputs, arguments.make.kind);
  if (video) arguments.video.poses = std::exchange(arguments.make.poses, {});
  const auto checked = video ? check_outputs_of_video(arguments)
                             : check_no_video_outputs(arguments.video, arguments.make.inputs);
  if (!checked) return checked.error();
  auto options = make_options(arguments.make);
  if (!options) return options.error();
  if (const auto wrong = note_on_cache(arguments.make)) console.note(*wrong);
  if (*published && arguments.make.as.empty()) options->as = made_for(**published);
  if (options->input.files.empty()) return Error{ErrorCode::usage, "make: INPUT is required", {}};
  if (arguments.make.detail == kCompareDetails) return compare(*options, arguments.output, console);
  if (const auto named = check_scene_name(arguments.output); !named) return named.error();
  const auto title = read_title(arguments.title);
  if (!title) return title.error();
  if (const auto readable = read_materials(arguments.material); !readable) return readable.error();
  const auto begin = std::chrono::steady_clock::now();
  auto made = session::make_scene(*options, console.work());
  if (!made) return made.error();
  if (const auto unused = note_on_unused(arguments.make, *options, made->scene))
    made->notes.push_back(*unused);
  if (const auto lay = note_on_lay(arguments.make, *options, made->scene)) made->notes.push_back(*lay);
  for (const Note& note : made->notes) console.note(note);
  if (interrupted()) return Work::interrupted();
  models::Scene scene = std::move(made->scene);
  if (const auto applied = apply_materials(arguments.material, scene); !applied) return applied.error();
  apply_title(*title, scene);
  if (const auto noted = add_making(arguments.words, scene, console.work()); !noted) return noted.error();
  // The poses of a video are written, so they are no input.
  if (video)
    std::erase_if(scene.source.command, [](const std::string& word) { return word.starts_with("--poses="); });
  // None of them appears before all of them are on the disk.
  AtomicFiles files;
  if (made->video)
    if (const auto added = add_video_outputs(
            arguments.video, {video_name(arguments.make.inputs), *made->video, scene, made->notes}, files,
            console.work());
        !added)
      return added.error();
  const auto encoded = formats::encode_scene(scene);
  if (!encoded) return Error{encoded.error().code, encoded.error().message, arguments.output};
  if (const auto added = files.add(arguments.output, *encoded); !added) return added.error();
  if (const auto written = files.commit(); !written) return written.error();
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - begin;

  const Vec3 size = models::size_m(scene);
  const std::string kind = scene.map != nullptr ? "map" : models::kind_of(scene.model);
  Answer answer;
  answer.json = {{"output", arguments.output},         {"kind", kind},
                 {"size_m", {size.x, size.y, size.z}}, {"method", scene.source.method},
                 {"notes", sentences_of(made->notes)}, {"seconds", seconds.count()}};
  if (made->video && !made->video->steps.empty()) answer.json["steps"] = steps_of(*made->video);
  answer.text = fmt::format("{}: {}, {:.1f} x {:.1f} x {:.1f} mm, made in {:.2f} s\n", arguments.output, kind,
                            1000.0 * size.x, 1000.0 * size.y, 1000.0 * size.z, seconds.count());
  return answer;
}

}  // namespace

void add_make(Program& program) {
  const auto arguments = std::make_shared<MakeCommandArguments>();
  Options options = add_command(
      program, "make", "Make a touchable scene and save it",
      "  palpable make left.png right.png -o room.palp\n"
      "  palpable make left.png right.png -o room.palp --calibration calib.txt --size 150x100x30\n"
      "  palpable make depth.png -o room.palp --kind depth\n"
      "  palpable make depth.png -o details.png --kind depth --detail compare\n"
      "  palpable make scan.png -o scan.palp --as contours\n"
      "  palpable make depth.png -o cloth.palp --kind depth --material "
      "0:texture=ridges,pitch=2,friction=0.4\n"
      "  palpable make house.obj -o house.palp --size 100x100x50 --title 'The town hall'\n"
      "  palpable make model.mp4 -o model.palp --poses poses.csv --structure points.ply\n"
      "  palpable make --again room.palp -o copy.palp    with the same files and options",
      [arguments](Console& console) { return make(*arguments, console); });
  options.required_output("-o,--output", arguments->output, {}, "Scene to write (.palp)");
  options.text("--again", arguments->again,
               "Make a saved scene again, with the files and options that it states; nothing else is given");
  arguments->words = making_words(options);
  add_make_options(options, arguments->make);
  arguments->check_poses = options.output_check("--poses", arguments->make.poses, {".csv"});
  add_video_outputs(options, arguments->video);
  add_as_published(options, arguments->as_published);
  add_title_options(options, arguments->title);
  add_material_options(options, arguments->material);
}

}  // namespace palpable::cli
