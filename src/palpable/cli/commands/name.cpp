// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/cli/arguments/number_list.hpp"
#include "palpable/cli/arguments/scene_argument.hpp"
#include "palpable/cli/command.hpp"
#include "palpable/core/text/figure.hpp"
#include "palpable/describe/name_history.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <string>
#include <utility>

#include <fmt/format.h>

namespace palpable::cli {
namespace {

struct NameArguments {
  std::string scene, output;
  std::string add, at, of, sentence, remove;
};

constexpr double kMm = 1e3;

std::string_view extent_word(models::PlaceName::Extent extent) {
  constexpr std::array<std::string_view, 4> kWords{"point", "line", "area", "region"};
  return kWords.at(static_cast<std::size_t>(extent));
}

Answer list_of(const models::Scene& scene) {
  const describe::PlaceGuide guide(scene);
  Answer answer;
  answer.json = {{"names", Json::array()}};
  for (const describe::NamedPlace& place : guide.places()) {
    const Place at = place.name.at;
    answer.json["names"].push_back({{"name", place.name.name},
                                    {"words", place.words},
                                    {"sentence", place.name.sentence},
                                    {"at_m", {at.x_m, at.y_m}},
                                    {"covers", extent_word(place.name.extent)},
                                    {"written", place.written.has_value()}});
    answer.text += fmt::format("{}: {} at {},{} mm, {}{}\n", place.words, extent_word(place.name.extent),
                               figure(kMm * at.x_m), figure(kMm * at.y_m),
                               place.written ? "named by a person" : "found by the program",
                               place.name.sentence.empty() ? "" : "; " + place.name.sentence);
  }
  if (answer.text.empty()) answer.text = "Nothing has a name, and nothing was found to name.\n";
  return answer;
}

/// The place in the scene that --at states, in millimetres. Errors: usage.
Result<Place> place_of(const models::Scene& scene, const std::string& at) {
  const auto numbers = numbers_of(at, 2, "--at", "X,Y in millimetres from the origin");
  if (!numbers) return numbers.error();
  const Place place{numbers->front() / kMm, numbers->back() / kMm};
  const Vec3 size = models::size_m(scene), centre = models::centre_m(scene);
  constexpr double kRoom = 0.5 + 1e-9;
  if (std::abs(place.x_m - centre.x) > kRoom * size.x || std::abs(place.y_m - centre.y) > kRoom * size.y)
    return Error{ErrorCode::usage,
                 fmt::format("'{}' is not in the scene, which is {} x {} mm", at, figure(kMm * size.x),
                             figure(kMm * size.y)),
                 "--at"};
  return place;
}

/// The place that a person called `name`; of several, the one nearest to `at`, which must then be stated.
Result<std::size_t> named_place(const models::Scene& scene, const describe::PlaceGuide& guide,
                                const std::string& name, const std::string& at) {
  Place near;
  if (!at.empty()) {
    const auto stated = place_of(scene, at);
    if (!stated) return stated.error();
    near = *stated;
  }
  const auto place = guide.find(name, near);
  if (!place || !at.empty()) return place;
  const auto& called = guide.places()[*place].name.name;
  const auto equal = std::count_if(guide.places().begin(), guide.places().end(),
                                   [&](const auto& other) { return other.name.name == called; });
  if (equal == 1) return place;
  return Error{ErrorCode::usage,
               fmt::format("{} places are called '{}': say which one by --at X,Y", equal, called),
               {}};
}

Result<describe::NamesEdit> edit(const models::Scene& scene, const NameArguments& arguments) {
  const describe::PlaceGuide guide(scene);
  describe::NameHistory history;
  if (!arguments.remove.empty()) {
    const auto place = named_place(scene, guide, arguments.remove, arguments.at);
    if (!place) return Error{place.error().code, place.error().message, "--remove"};
    return history.remove(scene, guide, *place);
  }
  models::PlaceName given{arguments.add, arguments.sentence, {}, {}, {}};
  if (arguments.at.empty() && arguments.of.empty())
    return Error{ErrorCode::usage, "a name needs a place: --at X,Y, or --of NAME", "--add"};
  if (!arguments.at.empty() && !arguments.of.empty())
    return Error{ErrorCode::usage, "a name has one place: --at X,Y or --of NAME, not both", "--add"};
  if (!arguments.of.empty()) {
    const auto place = guide.find(arguments.of, {});
    if (!place) return Error{ErrorCode::usage, place.error().message, "--of"};
    return history.name(scene, guide, std::move(given), *place);
  }
  const auto at = place_of(scene, arguments.at);
  if (!at) return at.error();
  given.at = *at;
  return history.name(scene, guide, std::move(given));
}

Result<Answer> name(const NameArguments& arguments, Console&) {
  auto file = read_scene_argument(arguments.scene);
  if (!file) return file.error();
  const bool adds = !arguments.add.empty(), removes = !arguments.remove.empty();
  const bool has_more = !arguments.of.empty() || !arguments.sentence.empty();
  if (!adds && (has_more || (!removes && (!arguments.at.empty() || !arguments.output.empty()))))
    return Error{ErrorCode::usage, "--of and --sentence belong to --add, --at and -o to a change", "--add"};
  if (adds && removes) return Error{ErrorCode::usage, "one change at a time", "--remove"};
  if (!adds && !removes) return list_of(file->scene);
  const std::string& output = arguments.output.empty() ? arguments.scene : arguments.output;
  if (const auto named = check_scene_name(output); !named) return named.error();
  auto edited = edit(file->scene, arguments);
  if (!edited) return edited.error();
  file->scene.names = std::move(edited->names);
  if (const auto written = formats::write_scene(output, file->scene, file->others); !written)
    return written.error();
  Answer answer = list_of(file->scene);
  answer.json["output"] = output;
  answer.json["change"] = edited->words;
  answer.text = fmt::format("{} {}\n", edited->words, output);
  return answer;
}

}  // namespace

void add_name(Program& program) {
  const auto arguments = std::make_shared<NameArguments>();
  Options options =
      add_command(program, "name", "Names of points and regions of a scene: list, add, change, remove",
                  "  palpable name church.palp\n"
                  "  palpable name church.palp --add tower --at -30,12 --sentence \"It has four bells.\"\n"
                  "  palpable name church.palp --add nave --of \"body 2\"\n"
                  "  palpable name church.palp --remove tower -o plain.palp",
                  [arguments](Console& console) { return name(*arguments, console); });
  options.argument("SCENE", arguments->scene,
                   "A .palp scene; without --add and --remove its names are listed");
  options.text("--add", arguments->add, "A name, at most 400 bytes");
  options.text("--at", arguments->at,
               "With --add: the point X,Y that is called so, mm; with --remove, of equal names the nearest");
  options.text("--of", arguments->of,
               "With --add: what is called so instead: a name in the list, also one that the program found");
  options.text("--sentence", arguments->sentence, "With --add: what else is said of it");
  options.text("--remove", arguments->remove, "Remove the name that a person gave");
  options.output("-o,--output", arguments->output, {".palp"}, "Write another scene; default: the same one");
}

}  // namespace palpable::cli
